//! Which spacings fit, and what touches: the library against the distances of all pairs.

use std::collections::BTreeSet;

use cannonpile::geometry::{Clearance, LayerGap, Spacing};
use cannonpile::lattice::{Region, Sign};
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile};
use cannonpile_testkit::answers::{Shape, ratio};
use cannonpile_testkit::oracles::overlap::{self, Difference};
use num_rational::BigRational;
use num_traits::{One, Signed};

fn spacing(q: &BigRational) -> Spacing {
    Spacing::from_square(q.clone()).unwrap()
}

fn shapes() -> impl Iterator<Item = Shape> {
    Shape::isosceles().chain([Shape::Discs])
}

/// Every q at which two spheres touch that are a few steps apart, and q a billionth to both sides of
/// it; also some between, and where contacts would be horizontal.
fn questions(shape: &Shape, tall: &BTreeSet<Difference>) -> Vec<BigRational> {
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
fn every_verdict_is_that_of_all_pairs() {
    for shape in shapes() {
        let questions = questions(&shape, &overlap::differences(&shape, 9));
        for layers in 1..=9 {
            let differences = overlap::differences(&shape, layers);
            let clearance = shape.pile(layers).clearance();
            for q in &questions {
                let room = overlap::room(&shape, &differences, q);
                let answer = clearance.check(&spacing(q));
                let agree = overlap::agree(room.as_ref(), &answer);
                assert!(
                    agree,
                    "{shape:?}, {layers} layers, q = {q}: {answer:?}, not {room:?}"
                );
            }
        }
    }
}

/// What an error says is so: the spheres named do overlap, the spacing lies outside the bounds named,
/// and "none fits" is said just where none of the questions has room.
#[test]
fn every_error_is_true() {
    for shape in shapes() {
        let questions = questions(&shape, &overlap::differences(&shape, 9));
        for layers in 1..=9 {
            let differences = overlap::differences(&shape, layers);
            let clearance = shape.pile(layers).clearance();
            let fits = |q: &BigRational| overlap::room(&shape, &differences, q).is_some();
            let some_fit = questions.iter().any(fits);
            for q in &questions {
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
                        assert!(outside, "{case} lies within the bounds it is told to keep");
                        assert!(some_fit, "{case}");
                    }
                    Err(other) => panic!("{case}: {other:?}"),
                }
            }
        }
    }
}

/// A q just below `q`, and one just above.
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
            unreachable!("no discs among them")
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
    // At 5/6 exactly one spacing is left.
    let clearance = Shape::Spheres(ratio(5, 6)).pile(3).clearance();
    assert_eq!(clearance.least(), clearance.most());
    assert_eq!(clearance.most(), Some(spacing(&ratio(27, 11))));
}

/// `least` and `most` are allowed, and nothing beyond them is.
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
                // Then no spacing is: known_bounds_of_isosceles_bases says where.
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

/// Layers whose rows along every direction but one have a single sphere.
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
            // Under two spheres and under one, every layer but the first has neighbours.
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

/// The comparison with all pairs refuses wrong verdicts.
#[test]
fn wrong_verdicts_are_refused() {
    const LAYERS: i128 = 5;
    let shape = Shape::equilateral();
    let differences = overlap::differences(&shape, LAYERS);
    let room = |q: &BigRational| overlap::room(&shape, &differences, q);
    let check = |clearance: &Clearance, q: &BigRational| {
        clearance.check(&Spacing::from_square(q.clone()).unwrap())
    };
    let right = shape.pile(LAYERS).clearance();
    let (tight, wide, open) = (ratio(1, 1), ratio(8, 3), ratio(3, 2));
    for q in [&tight, &wide, &open] {
        assert!(overlap::agree(room(q).as_ref(), &check(&right, q)));
    }
    // A touch too few, a touch too many, and touching spheres of other layers.
    assert!(!overlap::agree(room(&tight).as_ref(), &Ok(vec![])));
    assert!(!overlap::agree(
        room(&open).as_ref(),
        &check(&right, &tight)
    ));
    assert!(!overlap::agree(
        room(&wide).as_ref(),
        &check(&right, &tight)
    ));
    // Room where there is none, and the other way round.
    assert!(!overlap::agree(room(&ratio(14, 5)).as_ref(), &Ok(vec![])));
    let refused = Err(Error::Interrupted);
    assert!(!overlap::agree(room(&open).as_ref(), &refused));
    // The bounds of a lower pile, and of another sin φ.
    let low = shape.pile(3).clearance();
    assert!(!overlap::agree(
        room(&ratio(14, 5)).as_ref(),
        &check(&low, &ratio(14, 5))
    ));
    let other = Shape::Spheres(ratio(2, 5)).pile(LAYERS).clearance();
    assert!(!overlap::agree(
        room(&tight).as_ref(),
        &check(&other, &tight)
    ));
}

/// One sphere has no neighbour, whatever it was grown from.
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

/// sin φ = 4/5: the neighbours across are at q = 25/12, spheres two layers apart at q = 5/2, which both are irrational; a
/// lower bound is rounded up, an upper one down.
#[test]
fn what_is_too_close_and_the_bounds_are_named() {
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
