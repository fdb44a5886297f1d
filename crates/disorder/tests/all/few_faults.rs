//! Closed form of the response of a stacking with few faults: a sum over all choices of one direction for each run.

use std::collections::BTreeMap;

use cannonpile_disorder::FirstSign;
use num_rational::BigRational;

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Piles, Place, Sums, by_faults};

type Loads = BTreeMap<Place, BigRational>;

/// Returns the place below runs of these lengths, with alternating signs, along one direction in each run. The labels
/// 0, 1 and 2 are the directions α, β and γ.
fn place(runs: &[i64], labels: &[usize]) -> Place {
    let mut steps = [0; 3];
    let signs = [1, -1].into_iter().cycle();
    for ((run, label), sign) in runs.iter().zip(labels).zip(signs) {
        steps[*label] += sign * run;
    }
    let [a, b, c] = steps;
    [b - a, c - a]
}

/// Returns ⅓ times a product over the sign changes. The factor is −⅓ if the direction stays the same at the sign
/// change, and ⅔ if not.
fn amplitude(labels: &[usize]) -> BigRational {
    let factor = |pair: &[usize]| {
        if pair[0] == pair[1] {
            ratio(-1, 3)
        } else {
            ratio(2, 3)
        }
    };
    labels
        .windows(2)
        .map(factor)
        .fold(ratio(1, 3), |product, factor| product * factor)
}

/// Returns all sequences with one direction for each run.
fn labels(runs: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..runs {
        let longer =
            |labels: &Vec<usize>| [0, 1, 2].map(|label| [labels.as_slice(), &[label]].concat());
        all = all.iter().flat_map(longer).collect();
    }
    all
}

/// Returns the response to a unit load below runs of these lengths.
fn response(runs: &[i64]) -> Loads {
    let mut loads = Loads::new();
    for labels in labels(runs.len()) {
        *loads.entry(place(runs, &labels)).or_default() += amplitude(&labels);
    }
    loads
}

/// Returns all divisions of n steps into this number of runs.
fn compositions(n: i64, runs: usize) -> Vec<Vec<i64>> {
    if runs == 1 {
        return vec![vec![n]];
    }
    let first = 1..=n - i64::try_from(runs).unwrap() + 1;
    let cut = |first: i64| {
        compositions(n - first, runs - 1)
            .into_iter()
            .map(move |rest| [&[first], &rest[..]].concat())
    };
    first.flat_map(cut).collect()
}

/// Returns the sum of the responses of all stackings of n steps with this number of faults, by the closed form.
fn closed(n: i64, faults: usize) -> Loads {
    let mut sums = Loads::new();
    for runs in compositions(n, faults + 1) {
        for (place, load) in response(&runs) {
            *sums.entry(place).or_default() += load;
        }
    }
    sums.retain(|_, load| *load != ratio(0, 1));
    sums
}

/// Returns the same sum from the library.
fn of_library(sums: &Sums, of: usize) -> Loads {
    let rows = sums.iter().filter(|((_, faults), _)| *faults == of);
    let loads = rows.map(|((place, _), (_, floor))| (*place, floor[0].clone()));
    loads.filter(|(_, load)| *load != ratio(0, 1)).collect()
}

#[test]
fn closed_form_agrees_with_the_library() {
    for (n, steps) in (1..=8).zip(1..) {
        let piles = Piles::response(n, FirstSign::Plus).piles().unwrap();
        let sums = by_faults(&piles).unwrap();
        for faults in 0..n {
            assert_eq!(
                of_library(&sums, faults),
                closed(steps, faults),
                "{n} {faults}"
            );
        }
    }
    // Many steps with few faults.
    let piles = Piles::response(20, FirstSign::Plus).piles().unwrap();
    let sums = by_faults(&piles).unwrap();
    for faults in 0..=2 {
        assert_eq!(of_library(&sums, faults), closed(20, faults));
    }
}

/// Counts the occurrences of each load.
fn spots(loads: &Loads) -> BTreeMap<BigRational, usize> {
    let mut counts = BTreeMap::new();
    for load in loads.values() {
        *counts.entry(load.clone()).or_default() += 1;
    }
    counts
}

/// With one fault the response is nonzero at nine places. With the fault in the middle, three of them coincide below
/// the load.
#[test]
fn one_fault_has_9_or_7_spots() {
    let spots_of = |runs: &[i64]| spots(&response(runs));
    let nine = BTreeMap::from([(ratio(2, 9), 6), (ratio(-1, 9), 3)]);
    assert_eq!(spots_of(&[2, 3]), nine);
    assert_eq!(spots_of(&[5, 1]), nine);
    // With the fault in the middle, the three terms −1/9 are at the place below the load.
    let seven = BTreeMap::from([(ratio(2, 9), 6), (ratio(-1, 3), 1)]);
    for half in 1..=4 {
        assert_eq!(spots_of(&[half, half]), seven);
        assert_eq!(response(&[half, half])[&[0, 0]], ratio(-1, 3));
    }
    // Only one stacking of two steps has one fault, so the sum of the library is its response.
    let piles = Piles::response(2, FirstSign::Plus).piles().unwrap();
    assert_eq!(
        of_library(&by_faults(&piles).unwrap(), 1),
        response(&[1, 1])
    );
}

#[test]
fn two_faults_have_27_or_21_or_18_spots() {
    let general = BTreeMap::from([(ratio(1, 27), 3), (ratio(-2, 27), 12), (ratio(4, 27), 12)]);
    assert_eq!(spots(&response(&[2, 7, 3])), general);
    let two_alike = spots(&response(&[3, 3, 7]));
    assert_eq!(two_alike.values().sum::<usize>(), 21);
    assert_eq!(two_alike[&ratio(-1, 9)], 3);
    let ends_alike = spots(&response(&[3, 5, 3]));
    let expected = [
        (ratio(1, 27), 3),
        (ratio(-4, 27), 6),
        (ratio(4, 27), 6),
        (ratio(8, 27), 3),
    ];
    assert_eq!(ends_alike, BTreeMap::from(expected));
}

/// The derivative of the mean response at q = 0 is the sum of the responses with one fault, minus n − 1 times that of
/// FCC.
#[test]
fn slope_at_fcc() {
    for n in 1..=9 {
        let piles = Piles::response(n, FirstSign::Plus).piles().unwrap();
        let polynomials = piles.by_faults().unwrap().polynomial().unwrap();
        let under = polynomials.at(cannonpile_disorder::Place { a: 0, b: 0 });
        let slope = under.map_or_else(
            || ratio(0, 1),
            |row| {
                let q = cannonpile::scalar::Symbol("q");
                let at = |x: BigRational| row.normal.evaluate(&[(q, x)]).unwrap();
                // The derivative is a multiple of 1/9. So the difference quotient, rounded to ninths, is exact.
                let step = BigRational::new(1.into(), num_bigint::BigInt::from(10).pow(40));
                let quotient = (at(step.clone()) - at(ratio(0, 1))) / &step;
                (quotient * ratio(9, 1)).round() / ratio(9, 1)
            },
        );
        let expected = if n > 1 && n % 2 == 0 {
            ratio(-1, 3)
        } else {
            ratio(0, 1)
        };
        assert_eq!(slope, expected, "{n}");
    }
}

/// The comparison detects a wrong load, a wrong number of faults and a wrong first sign.
#[test]
fn planted_faults_are_detected() {
    let piles = Piles::response(4, FirstSign::Plus).piles().unwrap();
    let sums = by_faults(&piles).unwrap();
    let right = closed(4, 2);
    assert_eq!(of_library(&sums, 2), right);
    let mut load = right.clone();
    *load.values_mut().next().unwrap() += ratio(1, 27);
    assert_ne!(of_library(&sums, 2), load);
    assert_ne!(of_library(&sums, 1), right);
    let minus = by_faults(&Piles::response(4, FirstSign::Minus).piles().unwrap()).unwrap();
    assert_ne!(of_library(&minus, 2), of_library(&sums, 2));
}
