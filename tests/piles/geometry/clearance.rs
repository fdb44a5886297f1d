//! Allowed spacings and touching spheres, compared with the distances of all pairs.

use std::collections::BTreeSet;

use cannonpile::geometry::{Clearance, LayerGap, Spacing};
use cannonpile::lattice::{Region, Sign};
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile};
use cannonpile_testkit::answers::{Shape, ratio};
use num_rational::BigRational;
use num_traits::{One, Signed};

use super::overlap::{self, Difference};

fn spacing(q: &BigRational) -> Spacing {
    Spacing::from_square(q.clone()).unwrap()
}

fn shapes() -> impl Iterator<Item = Shape> {
    Shape::isosceles().chain([Shape::Discs])
}

/// Returns every q at which two spheres a few steps apart touch, slightly smaller and larger q, some values between,
/// and those at which contacts would be horizontal.
fn test_values(shape: &Shape, tall: &BTreeSet<Difference>) -> Vec<BigRational> {
    let few = tall
        .iter()
        .filter(|n| n.iter().all(|steps| steps.abs() <= 2));
    let touching = few.filter_map(|n| overlap::touching_at(shape, *n));
    let others = [
        (1, 2),
        (5, 4),
        (3, 2),
        (2, 1),
        (5, 2),
        (3, 1),
        (7, 2),
        (4, 1),
        (5, 1),
    ];
    let places: BTreeSet<_> = touching.chain(others.map(|(n, d)| ratio(n, d))).collect();
    let little = ratio(1, 1_000_000_000);
    let around = |q: BigRational| [&q - &little, q.clone(), q + &little];
    places
        .into_iter()
        .flat_map(around)
        .filter(Signed::is_positive)
        .collect()
}

#[test]
fn every_verdict_agrees_with_all_pairs() {
    for shape in shapes() {
        let test_values = test_values(&shape, &overlap::differences(&shape, 9));
        for layers in 1..=9 {
            let differences = overlap::differences(&shape, layers);
            let clearance = shape.pile(layers).clearance();
            for q in &test_values {
                let gaps = overlap::allowed_gaps(&shape, &differences, q);
                let answer = clearance.check(&spacing(q));
                let agree = overlap::agree(gaps.as_ref(), &answer);
                assert!(
                    agree,
                    "{shape:?}, {layers} layers, q = {q}: {answer:?}, not {gaps:?}"
                );
            }
        }
    }
}

/// An error is true: the named spheres overlap, and the spacing lies outside the named bounds. The error reports that
/// no spacing fits if and only if none of the tested ones does.
#[test]
fn every_error_is_true() {
    for shape in shapes() {
        let test_values = test_values(&shape, &overlap::differences(&shape, 9));
        for layers in 1..=9 {
            let differences = overlap::differences(&shape, layers);
            let clearance = shape.pile(layers).clearance();
            let fits = |q: &BigRational| overlap::allowed_gaps(&shape, &differences, q).is_some();
            let some_fit = test_values.iter().any(fits);
            for q in &test_values {
                let case = format!("{shape:?}, {layers} layers, q = {q}");
                match clearance.check(&spacing(q)) {
                    Ok(_) => {}
                    Err(Error::NoSpacing { .. }) => assert!(!some_fit, "{case}"),
                    Err(Error::TooFlat { limit, .. }) => {
                        let flat = ratio(overlap::flat(&shape).try_into().unwrap(), 1);
                        assert_eq!(limit.square(), &flat, "{case}");
                        assert!(*q >= flat && some_fit, "{case}");
                    }
                    Err(Error::Overlap { apart, allowed, .. }) => {
                        let mut pairs = differences
                            .iter()
                            .filter(|n| n.iter().sum::<i128>() == i128::from(apart.layers));
                        let close = |n: &Difference| {
                            let (distance, one) = overlap::squared_distance(&shape, *n, q);
                            distance < one
                        };
                        assert!(pairs.any(close), "{case}: {apart}");
                        let (least, most) = *allowed;
                        let outside = least.is_some_and(|least| q < least.square())
                            || most.is_some_and(|most| q > most.square());
                        assert!(outside, "{case} lies within the bounds of the error");
                        assert!(some_fit, "{case}");
                    }
                    Err(other) => panic!("{case}: {other:?}"),
                }
            }
        }
    }
}

/// A q slightly below `q`, and one slightly above.
fn around(q: &BigRational) -> [BigRational; 2] {
    let little = ratio(1, 1_000_000_000_000);
    [q - &little, q + little]
}

#[test]
fn known_bounds_of_the_equilateral_base() {
    let fits = |layers, q: &BigRational| {
        let clearance = Shape::equilateral().pile(layers).clearance();
        clearance.check(&spacing(q)).is_ok()
    };
    let (one, tall, flat) = (ratio(1, 1), ratio(8, 3), ratio(3, 1));
    for layers in 2..=9 {
        let [below, _] = around(&one);
        assert!(fits(layers, &one) && !fits(layers, &below));
        let [_, above] = around(&tall);
        assert!(fits(layers, &tall));
        assert_eq!(fits(layers, &above), layers <= 3);
        let [below, _] = around(&flat);
        assert!(!fits(layers, &flat));
        assert_eq!(fits(layers, &below), layers <= 3);
    }
}

#[test]
fn known_bounds_of_discs() {
    let fits = |layers, q: &BigRational| {
        Shape::Discs
            .pile(layers)
            .clearance()
            .check(&spacing(q))
            .is_ok()
    };
    let (one, tall, flat) = (ratio(1, 1), ratio(3, 1), ratio(4, 1));
    for layers in 2..=9 {
        let [below, _] = around(&one);
        assert!(fits(layers, &one) && !fits(layers, &below));
        let [_, above] = around(&tall);
        assert!(fits(layers, &tall));
        assert_eq!(fits(layers, &above), layers == 2);
        let [below, _] = around(&flat);
        assert!(!fits(layers, &flat));
        assert_eq!(fits(layers, &below), layers == 2);
    }
}

/// q ≥ max(3/(2(1+s)), 3/(4(1−s²))), and from three layers on s ≤ 5/6 (`paper`, "Overlap").
#[test]
fn known_bounds_of_isosceles_bases() {
    for shape in Shape::isosceles() {
        let Shape::Spheres(s) = &shape else {
            unreachable!("isosceles bases only")
        };
        let one = BigRational::one();
        let legs = ratio(3, 2) / (&one + s);
        let side = ratio(3, 4) / (&one - s * s);
        for layers in 2..=9 {
            let clearance = shape.pile(layers).clearance();
            let least = clearance.least().unwrap();
            assert_eq!(least.square(), (&legs).max(&side), "{shape:?}");
            let fits = clearance.check(&least).is_ok();
            assert_eq!(
                fits,
                if layers == 2 {
                    side < ratio(3, 1)
                } else {
                    *s <= ratio(5, 6)
                }
            );
        }
    }
    // At 5/6 exactly one spacing remains.
    let clearance = Shape::Spheres(ratio(5, 6)).pile(3).clearance();
    assert_eq!(clearance.least(), clearance.most());
    assert_eq!(clearance.most(), Some(spacing(&ratio(27, 11))));
}

/// `least` and `most` are allowed. No spacing beyond them is.
#[test]
fn the_bounds_are_sharp() {
    for shape in shapes() {
        for layers in 1..=9 {
            let clearance = shape.pile(layers).clearance();
            let fits = |q: &BigRational| clearance.check(&spacing(q)).is_ok();
            let (least, most) = (clearance.least(), clearance.most());
            let flat = ratio(overlap::flat(&shape).try_into().unwrap(), 1);
            let low = least
                .as_ref()
                .map_or(ratio(1, 1_000_000), |q| q.square().clone());
            if !fits(&low) {
                // No spacing fits here. The test known_bounds_of_isosceles_bases covers this.
                continue;
            }
            let [below, _] = around(&low);
            assert!(
                least.is_none() || !fits(&below),
                "{shape:?}, {layers} layers"
            );
            if let Some(most) = most {
                let [_, above] = around(most.square());
                assert!(
                    fits(most.square()) && !fits(&above),
                    "{shape:?}, {layers} layers"
                );
            } else {
                let [below, _] = around(&flat);
                assert!(fits(&below) && !fits(&flat), "{shape:?}, {layers} layers");
            }
        }
    }
}

/// Layers whose rows have two spheres along one direction only.
#[test]
fn two_spheres_are_neighbours_in_a_layer() {
    let pair = |x, y, s| Region::new(0..=x, 0..=y, 0..=s).unwrap();
    let tight = spacing(&ratio(81, 100));
    for (base, neighbours) in [
        (pair(1, 0, 1), true),
        (pair(0, 1, 1), true),
        (Region::new(0..=1, -1..=0, 0..=0).unwrap(), true),
        (Region::SITE, false),
    ] {
        for signs in ["", "+", "-", "+-"] {
            let stacking = Stacking::from_signs(
                signs
                    .chars()
                    .map(|sign| if sign == '+' { Sign::Plus } else { Sign::Minus }),
            );
            let pile = Pile::under(base, stacking.unwrap()).unwrap();
            // Below one or two spheres, every layer but the first has neighbours.
            let overlap = neighbours || !signs.is_empty();
            let verdict = pile.clearance().check(&tight);
            assert_eq!(
                matches!(verdict, Err(Error::Overlap { .. })),
                overlap,
                "{base:?} {signs}"
            );
            assert_eq!(verdict.is_ok(), !overlap, "{base:?} {signs}");
        }
    }
}

/// The comparison with all pairs rejects wrong verdicts.
#[test]
fn wrong_verdicts_are_caught() {
    const LAYERS: i128 = 5;
    let shape = Shape::equilateral();
    let differences = overlap::differences(&shape, LAYERS);
    let gaps = |q: &BigRational| overlap::allowed_gaps(&shape, &differences, q);
    let check = |clearance: &Clearance, q: &BigRational| {
        clearance.check(&Spacing::from_square(q.clone()).unwrap())
    };
    let right = shape.pile(LAYERS).clearance();
    let (tight, wide, open) = (ratio(1, 1), ratio(8, 3), ratio(3, 2));
    for q in [&tight, &wide, &open] {
        assert!(overlap::agree(gaps(q).as_ref(), &check(&right, q)));
    }
    // A missing pair that touches, a surplus one, and one of other layers.
    assert!(!overlap::agree(gaps(&tight).as_ref(), &Ok(vec![])));
    assert!(!overlap::agree(
        gaps(&open).as_ref(),
        &check(&right, &tight)
    ));
    assert!(!overlap::agree(
        gaps(&wide).as_ref(),
        &check(&right, &tight)
    ));
    // An allowed spacing taken as rejected, and the converse.
    assert!(!overlap::agree(gaps(&ratio(14, 5)).as_ref(), &Ok(vec![])));
    let refused = Err(Error::Interrupted);
    assert!(!overlap::agree(gaps(&open).as_ref(), &refused));
    // The bounds of a lower pile, and of another sin φ.
    let low = shape.pile(3).clearance();
    assert!(!overlap::agree(
        gaps(&ratio(14, 5)).as_ref(),
        &check(&low, &ratio(14, 5))
    ));
    let other = Shape::Spheres(ratio(2, 5)).pile(LAYERS).clearance();
    assert!(!overlap::agree(
        gaps(&tight).as_ref(),
        &check(&other, &tight)
    ));
}

/// A single sphere has no neighbour, for any base and top.
#[test]
fn one_sphere_sets_no_lower_bound() {
    let elsewhere = Region::new(5..=5, -3..=-3, 2..=2).unwrap();
    let one = Stacking::single_layer;
    for pile in [
        Pile::on(Region::SITE, one()),
        Pile::under(elsewhere, one()),
        Pile::triangular(1),
    ] {
        let clearance = pile.unwrap().clearance();
        assert_eq!((clearance.least(), clearance.most()), (None, None));
        assert_eq!(clearance.check(&spacing(&ratio(1, 100))), Ok(vec![]));
    }
}

/// sin φ = 4/5. The horizontal neighbours touch at q = 25/12, and spheres two layers apart at q = 5/2. Both spacings are
/// irrational, so the message rounds a lower bound up and an upper bound down.
#[test]
fn errors_name_the_overlap_and_the_bounds() {
    let clearance = Shape::Spheres(ratio(4, 5)).pile(9).clearance();
    let apart = |layers| LayerGap { layers };
    let touching = |q| clearance.check(&spacing(&q)).unwrap();
    assert_eq!(touching(ratio(25, 12)), [apart(0)]);
    assert_eq!(touching(ratio(5, 2)), [apart(2)]);
    let refused = |q| clearance.check(&spacing(&q)).unwrap_err().to_string();
    let allowed = "a/R must be at least 5/6*sqrt(3), just below 1.443376 and at most 1/2*sqrt(10) = 1.581138…";
    assert_eq!(
        refused(ratio(1, 1)),
        format!("spacing 1 lets spheres in one layer overlap: {allowed}")
    );
    assert_eq!(
        refused(ratio(64, 25)),
        format!("spacing 8/5 lets spheres 2 layers apart overlap: {allowed}")
    );
}
