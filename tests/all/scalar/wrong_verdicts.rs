//! The checks of overlap and of rounding refuse wrong verdicts.

use crate::support::answers::{Shape, ratio};
use crate::support::judge::{Value, beyond_greatest, exact, is_nearest, midpoint};
use crate::support::oracles::overlap;
use cannonpile::Error;
use cannonpile::geometry::{Clearance, Spacing};
use num_rational::BigRational;

const LAYERS: i128 = 5;

#[test]
fn of_overlap() {
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
    let refused = Err(Error::SinPhiOfDiscs);
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

#[test]
fn of_rounding() {
    let squared = |square: &BigRational| Value::with_square(false, square);
    let two = squared(&ratio(2, 1));
    let root = 2_f64.sqrt();
    assert_eq!(is_nearest(Some(root), &two), Ok(()));
    for wrong in [root.next_up(), root.next_down(), -root, 0.0] {
        assert!(is_nearest(Some(wrong), &two).is_err(), "{wrong}");
    }
    assert!(is_nearest(Some(root), &Value::with_square(true, &ratio(2, 1))).is_err());
    assert!(is_nearest::<f64>(None, &two).is_err());
    // Half way, the odd float; and the greatest one instead of an infinity.
    let tie = midpoint(&exact(1_f64), &exact(1_f64.next_up()));
    assert_eq!(is_nearest(Some(1_f64), &squared(&(&tie * &tie))), Ok(()));
    assert!(is_nearest(Some(1_f64.next_up()), &squared(&(&tie * &tie))).is_err());
    let limit = midpoint(&exact(f32::MAX), &beyond_greatest::<f32>());
    assert_eq!(
        is_nearest::<f32>(None, &squared(&(&limit * &limit))),
        Ok(())
    );
    assert!(is_nearest(Some(f32::MAX), &squared(&(&limit * &limit))).is_err());
    // Nothing, where the least subnormal is nearer.
    let least = exact(f32::from_bits(1));
    assert!(is_nearest(Some(0_f32), &squared(&(&least * &least))).is_err());
}
