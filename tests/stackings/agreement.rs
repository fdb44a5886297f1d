//! Every contact, every bottom sphere and every verdict of small piles, exactly as the oracle has them.
//!
//! Under one sphere: all stackings up to 9 layers. On a base: triangles and hexagons with sides up to 5 with all
//! stackings of every height that they carry, with a side of 6 a fixed sample of the highest ones.

use cannonpile::lattice::{Region, Selection};

use crate::cases::{Bounds, Case, Random, all_on, all_signs};
use crate::compare::{agrees, contacts_in_rows};
use crate::oracle::Naive;

#[test]
fn every_stacking_under_one_sphere_up_to_9_layers() {
    for steps in 0..9 {
        for signs in all_signs(steps) {
            agrees(&Case::under(&Bounds::SITE, &signs)).unwrap();
        }
    }
}

#[test]
fn every_stacking_on_triangles_and_hexagons_with_sides_up_to_5() {
    for base in bases()
        .filter(|(p, q, _)| *p.max(q) <= 5)
        .map(|base| base.2)
    {
        for signs in all_on(&base) {
            let case = Case::on(&base, &signs).expect("found by the oracle");
            agrees(&case).unwrap();
        }
    }
}

#[test]
fn some_of_the_highest_stackings_on_triangles_and_hexagons_with_a_side_of_6() {
    let mut random = Random(5);
    for base in bases().filter(|(p, q, _)| *p.max(q) > 5).map(|base| base.2) {
        for _ in 0..20 {
            let case = Case::on(&base, &highest(&base, &mut random)).expect("it fits");
            agrees(&case).unwrap();
        }
    }
}

#[test]
fn a_layer_alone_has_the_forces_that_it_has_among_all() {
    let mut random = Random(8);
    for _ in 0..30 {
        let signs = random.signs(8);
        let case = Case::under(&random.bounds(3), &signs);
        let forces = case.naive.forces();
        for k in 0..9 {
            contacts_in_rows(&case.pile, Selection::Layer(k), &forces).unwrap();
        }
    }
}

#[test]
fn the_named_regions_are_those_of_the_bounds() {
    for (p, q, bounds) in bases() {
        assert_eq!(Region::hexagon(p, q), Ok(bounds.region()));
    }
    for n in 1..=6 {
        assert_eq!(Region::triangle(n), Ok(Bounds::triangle(n).region()));
    }
    assert_eq!(Region::SITE, Bounds::SITE.region());
}

/// Hexagons, which with a side of 1 are triangles, of either orientation.
fn bases() -> impl Iterator<Item = (i128, i128, Bounds)> {
    (1..=6).flat_map(|p| (1..=6).map(move |q| (p, q, Bounds::hexagon(p, q))))
}

/// A random stacking that the base carries and that nothing can be put on.
fn highest(base: &Bounds, random: &mut Random) -> String {
    let sites = base.sites();
    let mut signs = String::new();
    loop {
        let choices = if random.below(2) == 0 {
            ['+', '-']
        } else {
            ['-', '+']
        };
        let higher = choices.map(|sign| format!("{sign}{signs}"));
        let mut higher = higher.into_iter();
        match higher.find(|signs| Naive::on(&sites, signs).is_some()) {
            Some(higher) => signs = higher,
            None => return signs,
        }
    }
}
