//! Extremes over a base, and the least contact, found among few spheres, are those of all.

use cannonpile::lattice::{Region, Selection, Site};
use cannonpile::{BaseExtremes, ContactForce, Pile};
use num_rational::BigRational;
use num_traits::Zero;

fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

/// Piles with long runs, most of them large enough to be looked at in few places.
fn piles() -> Vec<Pile> {
    let tops = [
        Region::SITE,
        Region::triangle(7).unwrap(),
        Region::hexagon(4, 9).unwrap(),
        Region::new(-3..=12, 0..=5, -2..=14).unwrap(),
    ];
    let stackings = [
        "(70)",
        "-(90)",
        "(3,80)",
        "(2,1,75)",
        "-(40,50)",
        "(1,1,1,60)",
        "(30,1,60)",
    ];
    let mut piles = Vec::new();
    for top in tops {
        for stacking in stackings {
            let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
            let [[i, j], ..] = top.corners();
            let on_top = Site { i, j, k: 0 };
            let below = pile
                .rows(Selection::Layer(45))
                .unwrap()
                .flatten()
                .nth(77)
                .unwrap();
            let loaded = pile.clone().with_load(on_top, ratio(25, 3)).unwrap();
            let loaded = loaded.with_load(below, ratio(50, 7)).unwrap();
            piles.extend([
                loaded.clone().with_weight(below, ratio(1, 9)).unwrap(),
                loaded.weightless(),
                pile,
            ]);
        }
    }
    for (base, stacking) in [
        (Region::triangle(80), "(30,4)"),
        (Region::hexagon(50, 40), "(1,25)"),
    ] {
        piles.push(Pile::on(base.unwrap(), stacking.parse().unwrap()).unwrap());
    }
    piles
}

/// The extremes over every bottom sphere.
fn over_all(pile: &Pile) -> [BigRational; 3] {
    let statics = pile.statics::<BigRational>();
    let rows = pile.rows(Selection::Base).unwrap();
    let forces: Vec<_> = statics.base(rows).map(Result::unwrap).collect();
    let normals = || forces.iter().map(|force| force.normal.clone());
    let loaded = forces.iter().filter(|force| !force.normal.is_zero());
    let ratios = loaded.map(|force| {
        let shear2 =
            &force.shear_x * &force.shear_x + ratio(3, 1) * &force.shear_y * &force.shear_y;
        shear2 / (&force.normal * &force.normal)
    });
    [normals().min(), normals().max(), ratios.max()].map(Option::unwrap_or_default)
}

#[test]
fn of_the_base() {
    for pile in piles() {
        let BaseExtremes {
            normal_min,
            normal_max,
            max_shear_ratio,
            ..
        } = pile.base_extremes().unwrap();
        let found = [normal_min, normal_max, max_shear_ratio.square()];
        assert_eq!(found, over_all(&pile), "{}", pile.shape().stacking());
    }
}

#[test]
fn of_contacts() {
    for pile in piles().into_iter().filter(|pile| pile.layers() < 90) {
        let standing = pile.standing().unwrap();
        let statics = pile.statics::<BigRational>();
        let contacts = statics.contacts(pile.rows(Selection::All).unwrap());
        let mut least: Option<ContactForce<BigRational>> = None;
        let mut first_failure = None;
        for contact in contacts.map(Result::unwrap) {
            if contact.force < BigRational::zero() && first_failure.is_none() {
                first_failure = Some(contact.site.k);
            }
            if least
                .as_ref()
                .is_none_or(|least| contact.force < least.force)
            {
                least = Some(contact);
            }
        }
        let stacking = pile.shape().stacking();
        assert_eq!(standing.first_failure, first_failure, "{stacking}");
        let (found, least) = (standing.least.unwrap(), least.unwrap());
        assert_eq!(found.force, least.force, "{stacking}");
        // Where several are least, the first is told.
        assert_eq!(
            (found.site, found.direction),
            (least.site, least.direction),
            "{stacking}"
        );
    }
}
