//! Roots: their order, form and products.

use core::cmp::Ordering;

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::judge::exact;
use exact_surd::Surd;
use num_bigint::Sign;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, Zero};

fn surd(c: (i64, i64), r: (i64, i64)) -> Surd {
    Surd::new(ratio(c.0, c.1), ratio(r.0, r.1)).unwrap()
}

/// Returns surds, each with its sign and its square computed independently.
fn samples() -> Vec<(Surd, i32, BigRational)> {
    let coefficients = [
        (0, 1),
        (1, 1),
        (-1, 1),
        (2, 3),
        (-2, 3),
        (7, 5),
        (-1, 1009),
        (99, 70),
    ];
    let radicands = [
        (0, 1),
        (1, 1),
        (2, 1),
        (8, 1),
        (1, 2),
        (4, 9),
        (1_018_081, 1),
        (2_036_162, 1),
    ];
    let mut samples = Vec::new();
    for c in coefficients {
        for r in radicands {
            let [coefficient, radicand] = [c, r].map(|(n, d)| ratio(n, d));
            let sign = if radicand.is_zero() { 0 } else { c.0.signum() };
            let square = &coefficient * &coefficient * radicand;
            samples.push((surd(c, r), i32::try_from(sign).unwrap(), square));
        }
    }
    samples
}

#[test]
fn order_matches_signed_squares() {
    for (a, a_sign, a_square) in samples() {
        for (b, b_sign, b_square) in samples() {
            let order = match (a_sign, b_sign) {
                (-1, -1) => b_square.cmp(&a_square),
                (1, 1) => a_square.cmp(&b_square),
                _ => a_sign.cmp(&b_sign),
            };
            assert_eq!(a.cmp(&b), order, "{a} {b}");
            assert_eq!(a == b, order == Ordering::Equal, "{a} {b}");
            assert_eq!(a.partial_cmp(&b), Some(order));
        }
    }
}

#[test]
fn sign_square_and_negation() {
    for (a, sign, square) in samples() {
        let wanted = match sign {
            -1 => Sign::Minus,
            0 => Sign::NoSign,
            _ => Sign::Plus,
        };
        assert_eq!(a.sign(), wanted, "{a}");
        assert_eq!(a.square(), square, "{a}");
        assert_eq!((-a.clone()).cmp(&a), 0.cmp(&sign), "{a}");
        assert_eq!(-(-a.clone()), a);
        // A root is rational if and only if its square is the square of a rational.
        if let Some(rational) = a.to_rational() {
            assert_eq!(Surd::from(rational.clone()), a);
            assert_eq!(&rational * &rational, square);
        } else {
            let (n, d) = (square.numer().magnitude(), square.denom().magnitude());
            assert!(
                n.sqrt().pow(2_u32) != *n || d.sqrt().pow(2_u32) != *d,
                "{a}"
            );
        }
    }
}

#[test]
fn products_and_reciprocals() {
    for (a, a_sign, a_square) in samples() {
        for (b, b_sign, b_square) in samples() {
            let product = a.clone() * &b;
            assert_eq!(product.square(), &a_square * &b_square, "{a} {b}");
            assert_eq!(
                product.cmp(&Surd::zero()),
                (a_sign * b_sign).cmp(&0),
                "{a} {b}"
            );
        }
        let scaled = a.scaled(&ratio(-3, 7));
        assert_eq!(scaled, a.clone() * &Surd::from(ratio(-3, 7)));
        match a.checked_recip() {
            None => assert_eq!(a_sign, 0),
            Some(recip) => assert_eq!(recip * &a, Surd::from(BigRational::one())),
        }
    }
}

#[test]
fn text() {
    for (c, r, text) in [
        ((0, 1), (5, 1), "0"),
        ((5, 1), (0, 1), "0"),
        ((7, 3), (1, 1), "7/3"),
        ((-7, 3), (4, 1), "-14/3"),
        ((1, 1), (2, 1), "sqrt(2)"),
        ((-1, 1), (2, 1), "-sqrt(2)"),
        ((-7, 3), (2, 1), "-7/3*sqrt(2)"),
        ((1, 1), (8, 3), "2/3*sqrt(6)"),
        ((7, 3), (8, 17), "14/51*sqrt(34)"),
    ] {
        assert_eq!(surd(c, r).to_string(), text);
    }
    assert!(Surd::new(ratio(1, 1), ratio(-1, 9)).is_err());
}

#[test]
fn comparison_with_floats() {
    for (a, sign, square) in samples() {
        assert_eq!(a.partial_cmp(&f64::NAN), None);
        assert_eq!(a.partial_cmp(&f64::INFINITY), Some(Ordering::Less));
        assert_eq!(a.partial_cmp(&f64::NEG_INFINITY), Some(Ordering::Greater));
        assert_eq!(a.partial_cmp(&f32::NAN), None);
        assert_eq!(a.partial_cmp(&f32::INFINITY), Some(Ordering::Less));
        for float in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(a != float, "{a}");
        }
        for zero in [0.0, -0.0] {
            assert_eq!(a.partial_cmp(&zero), Some(sign.cmp(&0)), "{a}");
        }
        // The comparison partners are the correctly rounded float, its neighbours and the extremes. The expected
        // order comes from exact squares.
        let near = a.nearest::<f64>().unwrap();
        for float in [
            near.next_down(),
            near,
            near.next_up(),
            f64::MAX,
            -5e-324,
            5e-324,
        ] {
            let x = exact(float);
            let order = match (sign, x.is_negative()) {
                (-1, true) => (&x * &x).cmp(&square),
                (1, false) if x.is_positive() => square.cmp(&(&x * &x)),
                _ => sign.cmp(&if x.is_zero() {
                    0
                } else if x.is_negative() {
                    -1
                } else {
                    1
                }),
            };
            assert_eq!(a.partial_cmp(&float), Some(order), "{a} {float:e}");
            assert_eq!(a == float, order.is_eq(), "{a} {float:e}");
        }
    }
}

/// 10007 is the smallest prime above 10000.
#[test]
fn squares_of_small_primes_are_extracted() {
    for p in [2, 3, 5, 7, 11, 31, 101, 499, 991, 997] {
        for (square, front, under) in [
            (p * p * 10_007, p, 10_007),
            (p * p * p * 10_007, p, p * 10_007),
            (p * p * 6, p, 6),
        ] {
            let root = Surd::sqrt(ratio(square, 1)).unwrap();
            assert_eq!(root.coefficient(), &ratio(front, 1), "{square}");
            assert_eq!(root.radicand().to_string(), under.to_string());
        }
    }
    assert_eq!(Surd::sqrt(ratio(45, 1)).unwrap().to_string(), "3*sqrt(5)");
    let sum = surd((1, 1), (45, 1)).checked_add(&surd((1, 1), (5, 1)));
    assert_eq!(sum.unwrap().to_string(), "4*sqrt(5)");
}

/// Without a common factor of a and b, the square in the denominator is extracted whatever its factors are. A common square
/// of a prime above 1000 cancels in √(a/b²), but is not found in √a.
#[test]
fn radicand_of_coprime_quotient_is_that_of_numerator() {
    let form = |a: i64, b: i64| Surd::sqrt(ratio(a, b * b)).unwrap().radicand().clone();
    for a in [2, 12, 1009 * 1009 * 1013] {
        for b in [1, 5 * 7, 1_000_003, 25 * 1019] {
            assert_eq!(form(a, b), form(a, 1), "{a} {b}");
        }
    }
    assert_eq!(form(1009 * 1009 * 1013, 1009), 1013_u32.into());
    assert_eq!(form(1009 * 1009 * 1013, 1), 1_031_316_053_u32.into());
}

#[test]
fn reduced_fractions_are_taken_as_they_are() {
    for (n, d) in [(0, 1), (2, 3), (-2, 3)] {
        assert_eq!(Surd::from_reduced(ratio(n, d)), Surd::from(ratio(n, d)));
    }
    for (n, d) in [(2, 4), (1, -2), (0, 3)] {
        let raw = || BigRational::new_raw(n.into(), d.into());
        assert_eq!(Surd::from(raw()), Surd::from(ratio(n, d)));
        let taken = std::panic::catch_unwind(|| Surd::from_reduced(raw()));
        assert_eq!(taken.is_err(), cfg!(debug_assertions), "{n}/{d}");
    }
}
