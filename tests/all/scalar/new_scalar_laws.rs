//! Intervals, double-doubles, polynomials and pairs obey the laws of scalars, on operands chosen to break them.

use cannonpile::scalar::{
    Algebra, DoubleDouble, Field, FixedRational, Interval, Polynomial, RealEmbeddable, Ring,
    Symbol, laws,
};
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{Pow, Zero};

use crate::support::pair::Pair;

fn ratio(n: i64, d: i64) -> Q {
    Q::new(n.into(), d.into())
}

fn power_of_two(exponent: i32) -> Q {
    Q::from_integer(2.into()).pow(exponent)
}

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

/// Every pair of these rationals.
fn obeys_embedding<T: Field + RealEmbeddable>(rationals: &[Q]) {
    for x in rationals {
        for y in rationals {
            assert_eq!(laws::embedding::<T>(x, y), Ok(()));
        }
    }
}

fn obeys_integers<T: Algebra>() {
    for n in integers() {
        assert_eq!(laws::integers::<T>(n), Ok(()), "{n}");
    }
}

/// A rational taken apart over a common denominator, and put together, is itself again.
fn keeps_numerators<T: Algebra>() {
    for x in rationals() {
        for y in rationals() {
            assert_eq!(laws::numerators::<T>(&x, &y), Ok(()));
        }
    }
    let ([zero, one], _) = T::numerators(&[Q::zero(), ratio(1, 1)]);
    assert!(T::from_ratio(one, &zero).is_none());
}

/// Not representable, halfway between two floats or double-doubles, next to a limit, long.
fn rationals() -> Vec<Q> {
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
        let beside = &power * (ratio(1, 1) - power_of_two(-107) / BigInt::from(3));
        [-&power, power, next, beside]
    });
    small
        .into_iter()
        .map(|(n, d)| ratio(n, d))
        .chain(about)
        .collect()
}

fn integers() -> impl Iterator<Item = i128> {
    let limits = [7_u32, 31, 53, 54, 63, 64, 105, 106, 107, 126].map(|bits| 1_i128 << bits);
    let around = limits.into_iter().flat_map(|n| [n - 1, n, n + 1]);
    let both = around.flat_map(|n| [n, -n]);
    both.chain([
        0,
        1,
        -1,
        10_i128.pow(36),
        i128::MAX,
        i128::MAX - 1,
        i128::MIN,
    ])
}

/// Floats that strain every case of an algorithm.
const FLOATS: [f64; 13] = [
    0.0,
    5e-324,
    f64::MIN_POSITIVE,
    1e-290,
    1e-154,
    0.1,
    1.0,
    3.0,
    9_007_199_254_740_993.0,
    1e154,
    1e289,
    f64::MAX,
    f64::INFINITY,
];

#[test]
fn intervals() {
    let both_signs = FLOATS.into_iter().step_by(2).flat_map(|x| [-x, x]);
    let ends: Vec<f64> = both_signs.chain([0.1, 1.0]).collect();
    let between = |lower: &f64| {
        ends.iter()
            .filter_map(|upper| Interval::new(*lower, *upper))
            .collect::<Vec<_>>()
    };
    let operands: Vec<_> = ends.iter().flat_map(between).step_by(5).collect();
    obeys_algebra(&operands);
    obeys_embedding::<Interval>(&rationals());
    obeys_integers::<Interval>();
    keeps_numerators::<Interval>();
}

#[test]
fn double_doubles() {
    let floats = FLOATS.into_iter().chain([-1.0, -1e289, f64::NAN]);
    let operands = floats.flat_map(|high| {
        let low = DoubleDouble::new(high * -1e-17);
        [DoubleDouble::new(high), DoubleDouble::new(high) + low]
    });
    obeys_algebra(&operands.collect::<Vec<_>>());
    obeys_embedding::<DoubleDouble>(&rationals());
    obeys_integers::<DoubleDouble>();
    keeps_numerators::<DoubleDouble>();
}

#[test]
fn polynomials() {
    let [x, y] = ["x", "y"].map(|name| Polynomial::from(Symbol(name)));
    let long = Polynomial::constant(&Q::new(
        BigInt::from(3).pow(200_u32),
        BigInt::from(7).pow(150_u32),
    ));
    let seventh = 7.try_into().expect("7");
    obeys_algebra(&[
        Polynomial::zero(),
        Polynomial::from_i128(-1),
        Polynomial::constant(&ratio(i64::MIN, i64::MAX)),
        x.clone(),
        -y.clone(),
        x.clone() - &y,
        x.clone() + &y,
        (x.clone() * &x * &y).div_int(seventh) - &Polynomial::from_i128(5),
        x.clone() * &long + &y.div_int(i64::MIN.try_into().expect("not zero")),
        long - &x,
    ]);
    obeys_integers::<Polynomial>();
    keeps_numerators::<Polynomial>();
}

/// All laws; the embedding where the second scalar holds the operands at all.
fn pairs_obey<B: Field + RealEmbeddable>() {
    let mut rationals = rationals();
    obeys_integers::<Pair<Q, B>>();
    let image = Pair::<Q, B>::from_rational;
    obeys_algebra(&rationals.iter().step_by(6).map(image).collect::<Vec<_>>());
    rationals.retain(|r| image(r).parting().is_none());
    obeys_embedding::<Pair<Q, B>>(&rationals);
}

#[test]
fn pairs_with_intervals() {
    pairs_obey::<Interval>();
}

#[test]
fn pairs_with_fixed_rationals() {
    pairs_obey::<FixedRational<i64>>();
}

#[test]
fn pairs_with_floats() {
    pairs_obey::<f64>();
}

#[test]
fn pairs_with_double_doubles() {
    pairs_obey::<DoubleDouble>();
}
