//! The half-turn of each scalar: enclosures stay narrow, and rounded values are divided once.

use cannonpile::formula::half_turn;
use cannonpile::scalar::Interval;

/// Inputs [2, 4] along one line give −[2, 4]/3 along it and 2·[2, 4]/3 along the others, plus one rounding.
#[test]
fn intervals_widen_minimally() {
    let g = [
        Interval::new(2.0, 4.0).unwrap(),
        Interval::point(0.0),
        Interval::point(0.0),
    ];
    let ends = [[-4.0, -2.0], [4.0, 8.0], [4.0, 8.0]].map(|ends| ends.map(|end: f64| end / 3.0));
    for (turned, [lower, upper]) in half_turn::<Interval>(&g).into_iter().zip(ends) {
        assert!((turned.lower() - lower).abs() < 1e-15, "{turned:?}");
        assert!((turned.upper() - upper).abs() < 1e-15, "{turned:?}");
    }
}

/// 2/3 is rounded. The subtraction after it adds no rounding.
#[test]
fn floats_are_divided_once() {
    let third: f64 = 2.0 / 3.0;
    let turned = half_turn::<f64>(&[1.0, 0.0, 0.0]);
    assert_eq!(
        turned.map(f64::to_bits),
        [third - 1.0, third, third].map(f64::to_bits)
    );
    assert!(third - 1.0 < -1.0 / 3.0);
}
