//! Every scalar of the crate obeys the laws, on operands chosen to break them.

use crate::support::answers::ratio;
use cannonpile::scalar::{Algebra, Field, FixedInteger, FixedRational, RealEmbeddable, laws};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Pow;

/// Every triple of the operands.
fn obeys_algebra<T: Algebra>(operands: &[T]) {
    for a in operands {
        for b in operands {
            for c in operands {
                assert_eq!(laws::algebra(a, b, c), Ok(()));
            }
        }
    }
}

/// Every pair of the rationals below, and every one of the integers.
fn obeys_embedding<T: Field + RealEmbeddable>() {
    let rationals = rationals();
    for x in &rationals {
        for y in &rationals {
            assert_eq!(laws::embedding::<T>(x, y), Ok(()));
        }
    }
    for n in integers() {
        assert_eq!(laws::integers::<T>(n), Ok(()), "{n}");
    }
}

/// What strains one of the scalars: not representable, halfway, next to a limit, long.
fn rationals() -> Vec<BigRational> {
    let two = |exponent: i32| BigRational::from_integer(2.into()).pow(exponent);
    let small = [
        (0, 1),
        (1, 1),
        (-1, 1),
        (1, 2),
        (1, 3),
        (-2, 3),
        (22, 7),
        (127, 126),
        (1, 127),
    ];
    let small = small.into_iter().map(|(n, d)| ratio(n, d));
    let powers = [-1074, -149, -64, -60, -53, -24, 7, 24, 31, 53, 63, 64, 127];
    let large = powers.into_iter().flat_map(|exponent| {
        [
            two(exponent),
            -two(exponent),
            two(exponent) + ratio(1, 1),
            two(exponent) - ratio(1, 3),
        ]
    });
    small.chain(large).collect()
}

fn integers() -> impl Iterator<Item = i128> {
    let limits = [7_u32, 8, 15, 24, 25, 31, 53, 54, 63, 64, 100, 126].map(|bits| 1_i128 << bits);
    let around = limits.into_iter().flat_map(|n| [n - 1, n, n + 1]);
    let both = around.flat_map(|n| [n, -n]);
    both.chain([
        0,
        1,
        -1,
        2,
        -3,
        10_i128.pow(36),
        i128::MAX,
        i128::MAX - 1,
        i128::MIN,
    ])
}

#[test]
fn doubles() {
    obeys_algebra(&[
        0.0,
        -0.0,
        f64::from_bits(1),
        -f64::MIN_POSITIVE,
        1e-300,
        f64::EPSILON,
        0.1,
        1.0 / 3.0,
        1.0,
        -1.0,
        1_f64.next_up(),
        9_007_199_254_740_993.0,
        1e300,
        f64::MAX,
        f64::MIN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ]);
    obeys_embedding::<f64>();
}

#[test]
fn singles() {
    obeys_algebra(&[
        0.0,
        -0.0,
        f32::from_bits(1),
        -f32::MIN_POSITIVE,
        1e-30,
        f32::EPSILON,
        0.1,
        1.0 / 3.0,
        1.0,
        -1.0,
        1_f32.next_up(),
        16_777_217.0,
        1e30,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ]);
    obeys_embedding::<f32>();
}

#[test]
fn big_rationals() {
    let long = BigInt::from(3).pow(100_u32);
    obeys_algebra(&[
        ratio(0, 1),
        ratio(1, 1),
        ratio(-1, 1),
        ratio(1, 2),
        ratio(-2, 3),
        ratio(i64::MAX, 1),
        ratio(1, i64::MAX),
        ratio(i64::MIN, i64::MAX),
        BigRational::from_integer(long.clone()),
        BigRational::new((-1).into(), long.clone()),
        BigRational::new(&long + 1, &long - 1),
    ]);
    obeys_embedding::<BigRational>();
}

fn fixed_width<I: FixedInteger>() {
    let max = I::max_value();
    let (one, two) = (I::one(), I::one() + I::one());
    let three = two + one;
    obeys_algebra(&[
        FixedRational::new(I::zero(), one),
        FixedRational::new(one, one),
        FixedRational::new(-one, one),
        FixedRational::new(one, two),
        FixedRational::new(-two, three),
        FixedRational::new(max, one),
        FixedRational::new(-max, one),
        FixedRational::new(max, two),
        FixedRational::new(one, max),
        FixedRational::new(-one, max),
        FixedRational::new(max, max - one),
        FixedRational::new(max - one, max),
        FixedRational::new(I::min_value(), one),
        FixedRational::FAULT,
    ]);
    obeys_embedding::<FixedRational<I>>();
}

#[test]
fn fixed_width_rationals() {
    fixed_width::<i8>();
    fixed_width::<i16>();
    fixed_width::<i32>();
    fixed_width::<i64>();
    fixed_width::<i128>();
}

/// Numerators over a common denominator, divided at the end, are the rational they stand for.
#[test]
fn numerators_over_one_denominator() {
    fn holds<T: Algebra>() {
        for x in rationals() {
            for y in rationals() {
                laws::numerators::<T>(&x, &y).unwrap();
            }
        }
        let ([zero, one], _) = T::numerators(&[ratio(0, 1), ratio(1, 1)]);
        assert_eq!(T::from_ratio(one, &zero), None);
    }
    holds::<BigRational>();
    holds::<f64>();
    holds::<f32>();
    holds::<FixedRational<i8>>();
    holds::<FixedRational<i64>>();
    holds::<FixedRational<i128>>();
}
