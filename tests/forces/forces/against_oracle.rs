//! Every contact and every base sphere of every straight pile up to 12 layers, compared with elimination. The oracle of any
//! stacking is compared with elimination where both apply, and with the equations that it solves.

use cannonpile::geometry::Vector;
use num_bigint::BigInt;
use num_rational::BigRational;

use cannonpile_testkit::answers::{Answers, Shape};
use cannonpile_testkit::cases::{Bounds, Random};
use cannonpile_testkit::oracles::balance::{Balance, Forces, direction, ratio, site};
use cannonpile_testkit::oracles::elimination;

use crate::theorems;

fn agrees(shape: &Shape) {
    for layers in 1..=12 {
        let library = Answers::of(shape, layers);
        let verdict = theorems::agree(&library, &elimination::solve(shape, layers));
        assert_eq!(verdict, Ok(()), "{shape:?}, {layers} layers");
    }
}

#[test]
fn equilateral() {
    agrees(&Shape::equilateral());
}

#[test]
fn isosceles() {
    for shape in Shape::isosceles() {
        agrees(&shape);
    }
}

#[test]
fn discs() {
    agrees(&Shape::Discs);
}

/// Compares both oracles on straight piles.
#[test]
fn both_oracles_agree() {
    for layers in 1..=8 {
        let eliminated = elimination::solve(&Shape::equilateral(), layers);
        let steps = "+".repeat(usize::try_from(layers - 1).unwrap());
        let forces = Balance::under(&Bounds::SITE.sites(), &steps).forces();
        let contacts = forces.below.iter().flat_map(|(place, forces)| {
            let forces = (0..).zip(forces);
            forces.map(|(m, force)| ((site(*place), direction(m)), force))
        });
        let eliminated_contacts = eliminated.contacts.iter();
        assert!(contacts.eq(eliminated_contacts.map(|(at, contact)| (*at, &contact.force))));
        assert_eq!(forces.floor.len(), eliminated.floor.len());
        for (place, [z, x, y]) in forces.floor {
            assert_eq!(eliminated.floor[&site(place)], Vector { x, y, z });
        }
        for (place, above) in forces.above {
            assert_eq!(eliminated.spheres[&site(place)].from_above, above);
        }
    }
}

/// Checks that each sphere transmits the incoming forces and its weight, along the lines of centres. The positions of the
/// centres are independent of the oracle's equations.
fn balances(pile: &Balance, forces: &Forces) -> bool {
    let along = |from: [BigInt; 2], to: [BigInt; 2], axis: usize| {
        BigRational::from(&to[axis] - &from[axis])
    };
    forces.below.iter().all(|(place, below)| {
        let here = || pile.position(*place);
        let above = &forces.above[place];
        let mut down = pile.weight(*place) * ratio(3, 1);
        let mut across = [ratio(0, 1), ratio(0, 1)];
        for m in 0..3 {
            down += &above[m] - &below[m];
            for (axis, across) in across.iter_mut().enumerate() {
                if let Some(upper) = pile.above(*place, m) {
                    *across += &above[m] * along(pile.position(upper), here(), axis);
                }
                let lower = pile.below(*place, m).unwrap();
                *across -= &below[m] * along(here(), pile.position(lower), axis);
            }
        }
        [&down, &across[0], &across[1]]
            .iter()
            .all(|rest| **rest == ratio(0, 1))
    })
}

#[test]
fn the_oracle_of_any_stacking_balances_every_sphere() {
    let mut random = Random(1998);
    for _ in 0..200 {
        let (top, steps) = (random.bounds(3), 1 + random.below(6));
        let mut pile = Balance::under(&top.sites(), &random.signs(steps));
        let places: Vec<_> = pile.places().collect();
        for _ in 0..3 {
            let place = places[random.below(places.len())];
            pile.weights.insert(place, random.rational());
        }
        let forces = pile.forces();
        assert!(balances(&pile, &forces), "{pile:?}");
        // A slightly larger force is rejected.
        let mut wrong = forces.clone();
        let place = places[random.below(forces.below.len())];
        wrong.below.get_mut(&place).unwrap()[random.below(3)] += ratio(1, i64::MAX);
        assert!(!balances(&pile, &wrong), "{pile:?}");
    }
}
