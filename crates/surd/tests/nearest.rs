//! Correct rounding of roots, checked without a square root: by the squares of the midpoints between
//! floats.

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::judge::{Float, Value, beyond_greatest, exact, is_nearest, midpoint};
use exact_surd::{CorrectlyRounded, Surd};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow};

/// Returns 2^`exponent`.
fn power(exponent: i32) -> BigRational {
    BigRational::from_integer(2.into()).pow(exponent)
}

/// Returns the rounded value of c·√r, after asserting that the checker accepts it and rejects both of its neighbours.
fn rounds_correctly<F: Float>(c: &BigRational, r: &BigRational) -> Option<F> {
    let float = Surd::new(c.clone(), r.clone()).unwrap().nearest::<F>();
    let value = Value::root(c, r);
    let check = |float| is_nearest(float, &value);
    assert_eq!(check(float), Ok(()), "{c} {r}");
    if let Some(x) = float {
        for neighbour in [x.up(), x.down()].into_iter().filter(|x| x.is_finite()) {
            assert!(
                check(Some(neighbour)).is_err(),
                "{c} {r}: {neighbour:?} passes too"
            );
        }
    }
    float
}

/// Knuth's linear congruential generator. Only the upper half of each state is random enough.
fn random(state: &mut u64) -> u64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

/// Checks thousands of coefficients and radicands, from below the smallest subnormal to above the largest
/// float.
fn random_numbers<F: Float>(exponents: core::ops::Range<i32>, step: usize) -> usize {
    let mut state = 1998;
    let mut finite = 0;
    for exponent in exponents.step_by(step) {
        for _ in 0..4 {
            let mut odd = || BigInt::from(random(&mut state) << 20 | 1);
            let sign = if odd().bit(21) { -1 } else { 1 };
            let c = BigRational::new(odd() * odd() * sign, odd() * odd()) * power(exponent);
            let r = BigRational::new(odd(), odd());
            finite += usize::from(rounds_correctly::<F>(&c, &r).is_some());
            // Rational numbers are rounded by another function.
            finite += usize::from(rounds_correctly::<F>(&c, &BigRational::one()).is_some());
        }
    }
    finite
}

#[test]
fn nearest_of_random_numbers() {
    assert!(random_numbers::<f64>(-1100..1040, 3) > 4000);
    assert!(random_numbers::<f32>(-170..140, 1) > 2000);
}

/// Returns √(m²) as a product of roots whose square factors are too large to be found. A product is stored
/// as a rational if its value is rational.
fn root_of_square(m: &BigRational) -> Surd {
    // 1009 is the smallest prime whose square is not searched for, and the cofactor here is not a perfect
    // square.
    let hidden = Surd::sqrt(ratio(1009 * 1009 * 2 * 1013, 1)).unwrap();
    let product = hidden * &Surd::sqrt(ratio(2 * 1013, 1)).unwrap();
    let product = product.scaled(&ratio(1, 1013));
    assert_eq!(product.to_rational(), Some(ratio(2 * 1009, 1)));
    product.scaled(&(m * ratio(1, 2 * 1009)))
}

/// Checks that a midpoint between two floats rounds to the even one: upwards, downwards and across powers
/// of two, among the smallest subnormals, and at the overflow threshold.
fn ties<F: Float>(places: &[F]) {
    for x in places {
        let above = if *x == F::max_value() {
            beyond_greatest::<F>()
        } else {
            exact(x.up())
        };
        let middle = midpoint(&exact(*x), &above);
        let even = if x.is_even() {
            Some(*x)
        } else {
            Some(x.up()).filter(|x| x.is_finite())
        };
        for negative in [false, true] {
            let middle = if negative { -&middle } else { middle.clone() };
            let even = if negative { even.map(|x| -x) } else { even };
            assert_eq!(F::nearest_to_rational(&middle), even);
            assert_eq!(root_of_square(&middle).nearest::<F>(), even);
            let square = &middle * &middle;
            assert_eq!(
                is_nearest(even, &Value::root(&middle, &BigRational::one())),
                Ok(())
            );
            // Slightly off the midpoint, the nearer float is correct.
            let above_one = BigRational::one() + power(-300);
            for (near_tie, nearer) in [
                (&square / &above_one, Some(*x)),
                (&square * &above_one, Some(x.up())),
            ] {
                let sign = ratio(if negative { -1 } else { 1 }, 1);
                let nearer = nearer.filter(|x| x.is_finite());
                let nearer = if negative { nearer.map(|x| -x) } else { nearer };
                assert_eq!(rounds_correctly::<F>(&sign, &near_tie), nearer);
            }
        }
    }
}

#[test]
fn ties_go_to_the_even_float() {
    ties(&[
        f64::from_bits(0),
        f64::from_bits(1),
        f64::from_bits(2),
        f64::MIN_POSITIVE.next_down(),
        f64::MIN_POSITIVE,
        1_f64.next_down(),
        1.0,
        1_f64.next_up(),
        9_007_199_254_740_991.0,
        9_007_199_254_740_992.0,
        f64::MAX.next_down(),
        f64::MAX,
    ]);
    ties(&[
        f32::from_bits(0),
        f32::from_bits(1),
        f32::from_bits(2),
        f32::MIN_POSITIVE.next_down(),
        f32::MIN_POSITIVE,
        1_f32.next_down(),
        1.0,
        1_f32.next_up(),
        16_777_215.0,
        16_777_216.0,
        f32::MAX.next_down(),
        f32::MAX,
    ]);
}

/// √((2^p + 1)² ± 1) differs from the midpoint of two floats by a relative distance below 2^(−2p), at any
/// scale.
fn near_ties<F: Float>(exponents: core::ops::Range<i32>) {
    let p = i32::try_from(F::PRECISION).unwrap();
    let middle = power(p) + BigRational::one();
    for exponent in exponents {
        let at = |float: BigRational| float * power(exponent);
        for (by, nearest) in [(-1, at(power(p))), (1, at(power(p) + ratio(2, 1)))] {
            let radicand = &middle * &middle + ratio(by, 1);
            let float = rounds_correctly::<F>(&power(exponent), &radicand);
            assert_eq!(float.map(exact), Some(nearest), "2^{exponent}, {by}");
        }
    }
}

#[test]
fn near_ties_are_decided() {
    near_ties::<f64>(-1022..970);
    near_ties::<f32>(-126..103);
}

/// A number slightly off the midpoint of two `f32` rounds to the midpoint in `f64`, and then to the even
/// `f32`.
#[test]
fn f32_is_not_rounded_through_f64() {
    let traps = [
        // Above the midpoint of 1 and its successor, and below that of 1 + 2^−23 and its successor.
        (ratio(1, 1) + power(-24) + power(-60), 1_f32.next_up()),
        (
            ratio(1, 1) + power(-23) + power(-24) - power(-60),
            1_f32.next_up(),
        ),
        // Near the midpoint of the two smallest subnormals, and of the two largest floats.
        (power(-150) + power(-210), f32::from_bits(1)),
        (exact(f32::MAX) - power(103) + power(40), f32::MAX),
    ];
    for (value, nearest) in traps {
        let square = &value * &value;
        let root = Surd::sqrt(square.clone() + power(-800)).unwrap();
        assert_eq!(root.nearest::<f32>(), Some(nearest));
        assert_eq!(f32::nearest_to_rational(&value), Some(nearest));
        let exactly = Value::with_square(false, &square);
        assert_eq!(is_nearest(Some(nearest), &exactly), Ok(()));
        #[expect(
            clippy::cast_possible_truncation,
            reason = "double rounding is the error under test"
        )]
        let twice_rounded = root.nearest::<f64>().unwrap() as f32;
        assert_ne!(twice_rounded.to_bits(), nearest.to_bits());
        assert!(is_nearest(Some(twice_rounded), &exactly).is_err());
    }
}

/// The distance to the midpoint is below the precision of a double-double: the leading bits alone exceed
/// the midpoint.
#[test]
fn just_below_a_middle_is_rounded_down() {
    let two = |power: u32| BigInt::from(1) << power;
    // 1 + m/2^24 is the midpoint of two floats, for odd m.
    for (k, m, below) in [
        (two(107) + 0x3ff_f08a, 1, 1.0),
        (two(107) + 0xc6aa_9e22_i64, 3, 1.0_f32.next_up()),
    ] {
        let d: BigInt = &k << 24;
        let value = BigRational::new(&d + k * m - 1, d);
        assert_eq!(f32::nearest_to_rational(&value), Some(below), "{m}");
        assert_eq!(f32::nearest_to_rational(&-value), Some(-below), "{m}");
    }
}

/// The values are far below the smallest float. A positive value gives +0, a negative one −0.
#[test]
fn underflow_keeps_sign() {
    for value in [power(-300), power(-900) * ratio(5, 3)] {
        let nearest = |value| f32::nearest_to_rational(value).map(f32::to_bits);
        assert_eq!(nearest(&value), Some(0.0_f32.to_bits()));
        assert_eq!(nearest(&-value.clone()), Some((-0.0_f32).to_bits()));
    }
}

#[test]
fn overflow_is_none() {
    let limit = midpoint(&exact(f64::MAX), &beyond_greatest::<f64>());
    for (value, nearest) in [
        (limit.clone(), None),
        (limit * (ratio(1, 1) - power(-200)), Some(f64::MAX)),
    ] {
        assert_eq!(f64::nearest_to_rational(&value), nearest);
        assert_eq!(root_of_square(&value).nearest::<f64>(), nearest);
        assert_eq!(
            root_of_square(&-value).nearest::<f64>(),
            nearest.map(|x| -x)
        );
    }
    let root_two = Surd::sqrt(ratio(2, 1)).unwrap();
    assert_eq!(root_two.scaled(&power(5000)).nearest::<f64>(), None);
    assert_eq!(root_two.scaled(&power(-5000)).nearest::<f64>(), Some(0.0));
    assert_eq!(root_two.scaled(&power(128)).nearest::<f32>(), None);
    assert_eq!(Surd::zero().nearest::<f32>(), Some(0.0));
}

/// The checker rejects the neighbours of the correctly rounded float.
#[test]
fn checker_rejects_wrong_roundings() {
    let squared = |square: &BigRational| Value::with_square(false, square);
    let two = squared(&ratio(2, 1));
    let root = 2_f64.sqrt();
    assert_eq!(is_nearest(Some(root), &two), Ok(()));
    for wrong in [root.next_up(), root.next_down(), -root, 0.0] {
        assert!(is_nearest(Some(wrong), &two).is_err(), "{wrong}");
    }
    assert!(is_nearest(Some(root), &Value::with_square(true, &ratio(2, 1))).is_err());
    assert!(is_nearest::<f64>(None, &two).is_err());
    // At a midpoint it rejects the odd float, and at the overflow threshold the largest float.
    let tie = midpoint(&exact(1_f64), &exact(1_f64.next_up()));
    assert_eq!(is_nearest(Some(1_f64), &squared(&(&tie * &tie))), Ok(()));
    assert!(is_nearest(Some(1_f64.next_up()), &squared(&(&tie * &tie))).is_err());
    let limit = midpoint(&exact(f32::MAX), &beyond_greatest::<f32>());
    assert_eq!(
        is_nearest::<f32>(None, &squared(&(&limit * &limit))),
        Ok(())
    );
    assert!(is_nearest(Some(f32::MAX), &squared(&(&limit * &limit))).is_err());
    // It rejects zero if the smallest subnormal is nearer.
    let least = exact(f32::from_bits(1));
    assert!(is_nearest(Some(0_f32), &squared(&(&least * &least))).is_err());
}

/// (d(2⁵³ + 1) ± 1)/d differs from the midpoint of two floats by 1/d. Only the last of its 129 bits show
/// it.
#[test]
fn all_digits_of_long_numbers_count() {
    let d: BigInt = (BigInt::one() << 75) + (BigInt::one() << 63) + 1;
    let middle = (BigInt::one() << 53) + 1;
    let [above, below] = [1, -1].map(|offset| BigRational::new(&d * &middle + offset, d.clone()));
    assert_eq!(above.numer().bits(), 129);
    assert_eq!(f64::nearest_to_rational(&above), Some(2_f64.powi(53) + 2.0));
    assert_eq!(f64::nearest_to_rational(&below), Some(2_f64.powi(53)));
}

/// Integers of 55 and 56 bits, times a power of two, are rounded up, down, and at a midpoint to the even
/// float. The largest ones lie outside the range of the double-double enclosure.
#[test]
fn integers_are_rounded_by_dropped_bits() {
    let power = |e: u32| BigInt::one() << e;
    for scale in [0, 3, 40, 940, 960] {
        for (dropped, rounded) in [
            (0, 0),
            (1, 0),
            (2, 0),
            (3, 4),
            (5, 4),
            (6, 8),
            (7, 8),
            (9, 8),
            (10, 8),
            (11, 12),
        ] {
            let [value, wanted] = [dropped, rounded]
                .map(|n: i32| BigRational::from_integer((power(54) + n) * power(scale)));
            let float = f64::nearest_to_rational(&value).unwrap();
            assert_eq!(exact(float), wanted, "(2^54 + {dropped})*2^{scale}");
            assert_eq!(f64::nearest_to_rational(&-value), Some(-float));
        }
    }
}
