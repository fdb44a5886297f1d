//! Every contact, every bottom sphere and every verdict of small piles equals the oracle's, exactly.
//!
//! Under one sphere: all stackings up to 9 layers. On triangles and hexagons with sides up to 6: all stackings of every
//! height that they support.

use std::ops::RangeInclusive;

use cannonpile::lattice::Region;
use cannonpile::shape::Selection;

use cannonpile_testkit::cases::{Bounds, Case, Random, all_on, all_signs};
use cannonpile_testkit::compare::{agrees, contacts_in_rows};

#[test]
fn every_stacking_under_one_sphere_up_to_9_layers() {
    for steps in 0..9 {
        for signs in all_signs(steps) {
            agrees(&Case::under(&Bounds::SITE, &signs)).unwrap();
        }
    }
}

/// Compares every `step`-th stacking of every height on the bases with these sides.
fn agree_on(sides: RangeInclusive<i128>, step: usize) {
    for (_, _, base) in bases().filter(|(p, q, _)| sides.contains(p.max(q))) {
        for signs in all_on(&base).into_iter().step_by(step) {
            let case = Case::on(&base, &signs).expect("found by the oracle");
            agrees(&case).unwrap();
        }
    }
}

#[test]
fn every_stacking_on_bases_with_sides_up_to_5() {
    agree_on(1..=5, 1);
}

#[test]
fn every_stacking_on_bases_with_a_side_of_6() {
    // Release builds compare all stackings. Debug builds compare one in 29, because checked arithmetic is slow.
    agree_on(6..=6, if cfg!(debug_assertions) { 29 } else { 1 });
}

#[test]
fn a_single_layer_has_the_forces_of_the_whole_pile() {
    let mut random = Random(8);
    for _ in 0..30 {
        let signs = random.signs(8);
        let case = Case::under(&random.bounds(3), &signs);
        let forces = case.balance.forces();
        for k in 0..9 {
            contacts_in_rows(&case.pile, Selection::Layer(k), &forces).unwrap();
        }
    }
}

#[test]
fn named_regions_have_the_expected_bounds() {
    for (p, q, bounds) in bases() {
        assert_eq!(Region::hexagon(p, q), Ok(bounds.region()));
    }
    for n in 1..=6 {
        assert_eq!(Region::triangle(n), Ok(Bounds::triangle(n).region()));
    }
    assert_eq!(Region::SITE, Bounds::SITE.region());
}

/// Hexagons of both orientations. Those with a side of 1 are triangles.
fn bases() -> impl Iterator<Item = (i128, i128, Bounds)> {
    (1..=6).flat_map(|p| (1..=6).map(move |q| (p, q, Bounds::hexagon(p, q))))
}
