//! The law suite of scalars on operands that are likely to break it.

use crate::real::Bounded;
use cannonpile::scalar::{Algebra, Field, laws};
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::Pow;

use crate::answers::ratio;

/// Panics unless the laws of algebra hold for every triple of the operands.
pub fn obeys_algebra<T: Algebra>(operands: &[T]) {
    for a in operands {
        for b in operands {
            for c in operands {
                assert_eq!(laws::algebra(a, b, c), Ok(()));
            }
        }
    }
}

/// Panics unless the laws of the embedding hold for every pair of these rationals.
pub fn obeys_embedding<T: Field + Bounded>(rationals: &[Q]) {
    for x in rationals {
        for y in rationals {
            assert_eq!(laws::embedding(x, y, T::bounds), Ok(()));
        }
    }
}

/// Panics unless the laws of integers hold near the limits of all formats.
pub fn obeys_integers<T: Algebra>() {
    for n in integers() {
        assert_eq!(laws::integers::<T>(n), Ok(()), "{n}");
    }
}

/// Panics unless rationals survive a split into numerators over a common denominator.
pub fn keeps_numerators<T: Algebra>(rationals: &[Q]) {
    for x in rationals {
        for y in rationals {
            assert_eq!(laws::numerators::<T>(x, y), Ok(()));
        }
    }
    assert!(T::one().checked_div(&T::zero()).is_none());
}

fn power_of_two(exponent: i32) -> Q {
    Q::from_integer(2.into()).pow(exponent)
}

fn ratios<const N: usize>(small: [(i64, i64); N]) -> impl Iterator<Item = Q> {
    small.into_iter().map(|(n, d)| ratio(n, d))
}

/// Difficult operands for a float or a fixed-width rational: not representable, ties, next to a limit, long.
pub fn narrow() -> Vec<Q> {
    let two = power_of_two;
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
    let powers = [-1074, -149, -64, -60, -53, -24, 7, 24, 31, 53, 63, 64, 127];
    let large = powers.into_iter().flat_map(|exponent| {
        [
            two(exponent),
            -two(exponent),
            two(exponent) + ratio(1, 1),
            two(exponent) - ratio(1, 3),
        ]
    });
    ratios(small).chain(large).collect()
}

/// Difficult operands for enclosures and double-doubles: midpoints of two double-doubles, next to a limit, long.
pub fn wide() -> Vec<Q> {
    let small = [
        (0, 1),
        (1, 1),
        (-1, 1),
        (1, 2),
        (1, 3),
        (-2, 3),
        (22, 7),
        (1, i64::MAX),
        (-10, 1),
    ];
    let powers = [
        -1075, -1074, -1022, -900, -801, -107, -54, -1, 53, 106, 127, 959, 960, 1023, 1024,
    ];
    let about = powers.into_iter().flat_map(|exponent| {
        let power = power_of_two(exponent);
        let next = &power * (ratio(1, 1) + power_of_two(-53));
        let nearby = &power * (ratio(1, 1) - power_of_two(-107) / BigInt::from(3));
        [-&power, power, next, nearby]
    });
    ratios(small).chain(about).collect()
}

fn integers() -> impl Iterator<Item = i128> {
    let limits = [
        7_u32, 8, 15, 24, 25, 31, 53, 54, 63, 64, 100, 105, 106, 107, 126,
    ];
    let limits = limits.map(|bits| 1_i128 << bits);
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
