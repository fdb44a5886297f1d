//! Each comparison can fail: it detects a single fault on the oracle's side.

use num_rational::BigRational;
use num_traits::One;

use cannonpile_testkit::cases::{Bounds, Case};
use cannonpile_testkit::compare::{agrees, all_agree, in_rows, one_by_one, standing};
use cannonpile_testkit::oracles::balance::{Forces, Place, ratio};

fn case() -> Case {
    Case::under(&Bounds::triangle(2), "+-++-").with_load((1, 0, 1), &ratio(2, 5))
}

/// The least possible difference of two forces.
fn least_difference() -> BigRational {
    ratio(1, 5 * 3_i64.pow(5))
}

#[test]
fn results_agree_without_a_fault() {
    agrees(&case()).unwrap();
}

#[test]
fn one_force_to_a_sphere_below_is_wrong() {
    let (case, right) = (case(), case().balance.forces());
    for place in right.below.keys() {
        for m in 0..3 {
            let mut wrong = right.clone();
            wrong.below.get_mut(place).unwrap()[m] += least_difference();
            assert!(one_by_one(&case.pile, &wrong).is_err(), "{place:?} {m}");
            assert!(in_rows(&case.pile, &wrong).is_err(), "{place:?} {m}");
        }
    }
}

#[test]
fn one_force_from_above_or_on_the_floor_is_wrong() {
    let (case, right) = (case(), case().balance.forces());
    for place in right.above.keys() {
        for m in 0..3 {
            let mut wrong = right.clone();
            wrong.above.get_mut(place).unwrap()[m] -= least_difference();
            assert!(one_by_one(&case.pile, &wrong).is_err(), "{place:?} {m}");
        }
    }
    for place in right.floor.keys() {
        for component in 0..3 {
            let mut wrong = right.clone();
            wrong.floor.get_mut(place).unwrap()[component] += least_difference();
            assert!(one_by_one(&case.pile, &wrong).is_err(), "{place:?}");
            assert!(in_rows(&case.pile, &wrong).is_err(), "{place:?}");
        }
    }
}

#[test]
fn two_forces_are_swapped() {
    let (case, right) = (case(), case().balance.forces());
    let mut detected = 0;
    for (place, [a, b, _]) in &right.below {
        if a != b {
            let mut wrong = right.clone();
            wrong.below.get_mut(place).unwrap().swap(0, 1);
            assert!(one_by_one(&case.pile, &wrong).is_err(), "{place:?}");
            assert!(in_rows(&case.pile, &wrong).is_err(), "{place:?}");
            detected += 1;
        }
    }
    assert!(detected > 10);
}

#[test]
fn one_sign_is_wrong() {
    let case = case();
    for n in 0..case.balance.signs.len() {
        let mut signs = case.balance.signs.clone();
        let flipped = if signs[n..].starts_with('+') {
            "-"
        } else {
            "+"
        };
        signs.replace_range(n..=n, flipped);
        let other = Case::under(&Bounds::triangle(2), &signs);
        // The loaded sphere may be missing in the other pile, so this compares without the load as well.
        for forces in [other.balance.forces(), case.balance.forces()] {
            assert!(all_agree(&other.pile, &forces).is_err() || forces == other.balance.forces());
        }
        assert!(
            all_agree(&case.pile, &other.balance.forces()).is_err(),
            "{signs}"
        );
    }
}

#[test]
fn a_site_is_missing_or_surplus() {
    let case = case();
    for (k, j, i) in case.balance.places().collect::<Vec<Place>>() {
        let mut wrong = case.balance.clone();
        let layer = &mut wrong.layers[usize::try_from(k).unwrap()];
        assert!(layer.remove(&(j, i)));
        assert!(
            all_agree(&case.pile, &wrong.forces()).is_err(),
            "{k} {j} {i}"
        );
    }
    for k in 0..6 {
        let mut wrong = case.balance.clone();
        let layer = &mut wrong.layers[k];
        let last = *layer.last().expect("a site");
        layer.insert((last.0, last.1 + 1));
        assert!(all_agree(&case.pile, &wrong.forces()).is_err(), "{k}");
    }
}

#[test]
fn one_weight_is_wrong() {
    let case = case();
    for place in case.balance.places().collect::<Vec<Place>>() {
        let mut wrong = case.balance.clone();
        let weight = wrong.weight(place) + ratio(1, 1_000_000);
        wrong.weights.insert(place, weight);
        assert!(all_agree(&case.pile, &wrong.forces()).is_err(), "{place:?}");
    }
}

#[test]
fn the_least_force_is_different_or_elsewhere() {
    let (case, right) = (case(), case().balance.forces());
    standing(&case.pile, &right).unwrap();
    let (least, at, m) = right.least().unwrap();
    let place_of = |forces: &Forces| forces.least().map(|(_, at, m)| (at, m));
    let mut more = right.clone();
    more.below.get_mut(&at).unwrap()[m] += least_difference();
    assert!(standing(&case.pile, &more).is_err());
    // An equally small force earlier in the order of tables, and tension in an earlier layer.
    let first = *right.below.keys().next().unwrap();
    for force in [least.clone(), -BigRational::one()] {
        let mut wrong = right.clone();
        wrong.below.get_mut(&first).unwrap()[0] = force;
        assert_ne!(place_of(&wrong), Some((at, m)));
        assert!(standing(&case.pile, &wrong).is_err());
    }
}
