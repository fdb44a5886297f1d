//! Parts of a pile in rows: begun in the middle, of one sphere, of another pile; and piles of discs and on isosceles
//! bases with loads.

use cannonpile::lattice::{Region, Site};
use cannonpile::shape::{Rows, Selection};
use cannonpile::{ContactForce, Error, Forces, Pile};
use num_rational::BigRational;
use num_traits::Zero;

use crate::support::cases::{Random, stacking};
use crate::support::oracles::naive::ratio;

fn contacts<'p>(
    statics: &Forces<'p, BigRational>,
    rows: Rows<'p>,
) -> Vec<Result<ContactForce<BigRational>, Error>> {
    statics.contacts(rows).collect()
}

#[test]
fn rows_may_have_been_walked_before_they_are_asked_for() {
    for signs in ["+-+--+", "++++++", "-+-+-+"] {
        let pile = Pile::under(Region::triangle(2).unwrap(), stacking(signs)).unwrap();
        let statics = pile.forces();
        let all = contacts(&statics, pile.rows(Selection::All).unwrap());
        let rows = pile.rows(Selection::All).unwrap().count();
        for walked in 0..=rows {
            let mut left = pile.rows(Selection::All).unwrap();
            let before: usize = left
                .by_ref()
                .take(walked)
                .map(|row| row.into_iter().count())
                .sum();
            let rest = contacts(&statics, left);
            assert_eq!(rest.as_slice(), &all[(3 * before).min(all.len())..]);
        }
        let mut base = pile.rows(Selection::Base).unwrap();
        let row = base.next().unwrap().into_iter().count();
        let rest: Vec<_> = statics.base(base).map(Result::unwrap).collect();
        let whole = statics.base(Selection::Base).unwrap().map(Result::unwrap);
        assert_eq!(rest, whole.skip(row).collect::<Vec<_>>());
    }
}

#[test]
fn one_sphere_has_its_three_contacts_or_its_force_on_the_floor() {
    let pile = Pile::under(Region::SITE, stacking("+-+-+-")).unwrap();
    let statics: Forces<BigRational> = pile.forces();
    for site in pile.shape().sites() {
        let rows = || pile.rows(Selection::One(site)).unwrap();
        let own = contacts(&statics, rows());
        if site.k == 6 {
            assert!(own.is_empty());
            let floor: Vec<_> = statics.base(rows()).collect();
            assert_eq!(floor, [statics.on_floor(site)]);
        } else {
            let forces = own.into_iter().map(|contact| contact.unwrap());
            let expected = cannonpile::lattice::Direction::ALL.map(|d| statics.contact(site, d));
            assert!(forces.map(|c| Ok(c.force)).eq(expected));
        }
    }
}

#[test]
fn the_rows_of_another_pile_are_looked_up_in_this_one() {
    let pile = Pile::under(Region::SITE, stacking("+-+-+")).unwrap();
    let loaded = pile.clone().with_load(Site::APEX, ratio(3, 1)).unwrap();
    let statics: Forces<BigRational> = pile.forces();
    let own = contacts(&statics, pile.rows(Selection::All).unwrap());
    assert_eq!(
        contacts(&statics, loaded.rows(Selection::All).unwrap()),
        own
    );
    let base: Vec<_> = statics.base(Selection::Base).unwrap().collect();
    let looked_up: Vec<_> = statics.base(Selection::Base).unwrap().collect();
    assert_eq!(looked_up, base);
    // A straight pile whose base is not this one's.
    let straight = Pile::triangular(4).unwrap();
    let statics = straight.forces::<BigRational>();
    let bottom = pile.rows(Selection::Base).unwrap();
    assert!(statics.base(bottom).all(|force| force.is_err()));
}

/// Straight piles with another increment in each direction: what a sphere adds goes down its three lines, and nowhere else.
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
            let statics = loaded.forces::<BigRational>();
            let pairs = contacts(&bare, pile.rows(Selection::All).unwrap()).into_iter();
            let pairs = pairs.zip(contacts(&statics, loaded.rows(Selection::All).unwrap()));
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
            let base = statics.base(Selection::Base).unwrap();
            let normal: BigRational = base.map(|force| force.unwrap().normal).sum();
            assert_eq!(normal, loaded.weight());
            is_least(&loaded);
            is_least(&loaded.weightless());
        }
    }
}

/// The least force is the least of all contacts, the first of them.
fn is_least(pile: &Pile) {
    let all = contacts(&pile.forces(), pile.rows(Selection::All).unwrap());
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
