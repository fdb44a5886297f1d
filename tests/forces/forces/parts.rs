//! Parts of a pile, equal piles, and loads on piles of discs and on isosceles bases.

use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile::{ContactForce, Error, Forces, Pile};
use num_rational::BigRational;
use num_traits::Zero;

use cannonpile_testkit::cases::{Random, stacking};
use cannonpile_testkit::oracles::balance::ratio;

fn contacts(
    forces: &Forces<'_, BigRational>,
    part: Selection,
) -> Vec<Result<ContactForce<BigRational>, Error>> {
    match forces.contacts(part) {
        Ok(contacts) => contacts.collect(),
        Err(error) => vec![Err(error)],
    }
}

#[test]
fn one_sphere_has_three_contacts_or_a_force_on_the_floor() {
    let pile = Pile::under(Region::SITE, stacking("+-+-+-")).unwrap();
    let forces: Forces<BigRational> = pile.forces();
    for site in pile.shape().sites() {
        let own = contacts(&forces, Selection::One(site));
        if site.k == 6 {
            assert!(own.is_empty());
            let floor: Vec<_> = forces.base(Selection::One(site)).unwrap().collect();
            assert_eq!(floor, [forces.on_floor(site)]);
        } else {
            let own = own.into_iter().map(|contact| contact.unwrap());
            let expected = cannonpile::lattice::Direction::ALL.map(|d| forces.contact(site, d));
            assert!(own.map(|c| Ok(c.force)).eq(expected));
        }
    }
}

#[test]
fn equal_piles_are_interchangeable() {
    let pile = Pile::under(Region::SITE, stacking("+-+-+-+-+-")).unwrap();
    let twin = pile.clone();
    for part in [Selection::All, Selection::Layer(7)] {
        let [own, other] = [&pile, &twin].map(|pile| pile.forces::<BigRational>());
        let [own, other] = [own, other].map(|forces| forces.contacts(part).unwrap());
        // The planned method is the same too.
        assert_eq!(own.plan(), other.plan());
        assert!(own.eq(other));
    }
    let low = Pile::triangular(4).unwrap();
    let refused = low.forces::<BigRational>().base(Selection::Layer(2)).err();
    assert!(matches!(refused, Some(Error::NotOnFloor { .. })));
}

/// Straight piles with a different increment in each direction. A sphere adds forces to its three lines only.
#[test]
fn loads_on_isosceles_piles_and_on_discs() {
    let mut random = Random(111);
    for (pile, increments) in [
        (
            Pile::isosceles(6, ratio(2, 5)).unwrap(),
            [ratio(1, 1), ratio(1, 1), ratio(4, 5)],
        ),
        (
            Pile::isosceles(6, ratio(5, 6)).unwrap(),
            [ratio(1, 1), ratio(1, 1), ratio(5, 3)],
        ),
        (
            Pile::discs(6).unwrap(),
            [ratio(1, 1), ratio(1, 1), ratio(0, 1)],
        ),
    ] {
        let bare = pile.forces::<BigRational>();
        let sites: Vec<Site> = pile.shape().sites().collect();
        for _ in 0..40 {
            let (at, load) = (sites[random.below(sites.len())], random.rational());
            let loaded = pile.clone().with_load(at, load.clone()).unwrap();
            let forces = loaded.forces::<BigRational>();
            let pairs = contacts(&bare, Selection::All).into_iter();
            let pairs = pairs.zip(contacts(&forces, Selection::All));
            for (without, with) in pairs {
                let (without, with) = (without.unwrap(), with.unwrap());
                let (site, n) = (with.site, with.site.k - at.k);
                let [di, dj, _] = with.direction.descent();
                let on_line = n >= 0 && (site.i, site.j) == (at.i + n * di, at.j + n * dj);
                let more = if on_line {
                    &load * &increments[with.direction.index()]
                } else {
                    BigRational::zero()
                };
                assert_eq!(with.force - without.force, more, "{site}");
            }
            let base = forces.base(Selection::Base).unwrap();
            let normal: BigRational = base.map(|force| force.unwrap().normal).sum();
            assert_eq!(normal, loaded.weight());
            is_least(&loaded);
            is_least(&loaded.weightless());
        }
    }
}

/// The least force is the first minimum over all contacts.
fn is_least(pile: &Pile) {
    let all = contacts(&pile.forces(), Selection::All);
    let mut least: Option<ContactForce<BigRational>> = None;
    for contact in all.into_iter().map(Result::unwrap) {
        if least
            .as_ref()
            .is_none_or(|least| contact.force < least.force)
        {
            least = Some(contact);
        }
    }
    assert_eq!(pile.standing().unwrap().least, least);
}
