//! Every scalar of the crate obeys the laws, on difficult operands.

use cannonpile::scalar::{
    Algebra, DoubleDouble, Exactness, Field, FixedInteger, FixedRational, Interval, Polynomial,
    Ring, Symbol,
};
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::laws::{
    keeps_numerators, narrow, obeys_algebra, obeys_embedding, obeys_integers, wide,
};
use cannonpile_testkit::pair::{Pair, weaker};
use cannonpile_testkit::real::Bounded;
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{Pow, Zero};

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
    obeys_embedding::<f64>(&narrow());
    obeys_integers::<f64>();
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
    obeys_embedding::<f32>(&narrow());
    obeys_integers::<f32>();
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
        Q::from_integer(long.clone()),
        Q::new((-1).into(), long.clone()),
        Q::new(&long + 1, &long - 1),
    ]);
    obeys_embedding::<Q>(&narrow());
    obeys_integers::<Q>();
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
    obeys_embedding::<FixedRational<I>>(&narrow());
    obeys_integers::<FixedRational<I>>();
}

#[test]
fn fixed_width_rationals() {
    fixed_width::<i8>();
    fixed_width::<i16>();
    fixed_width::<i32>();
    fixed_width::<i64>();
    fixed_width::<i128>();
}

/// The tests of other scalars include these laws.
#[test]
fn numerators_over_one_denominator() {
    let rationals = narrow();
    keeps_numerators::<Q>(&rationals);
    keeps_numerators::<f64>(&rationals);
    keeps_numerators::<f32>(&rationals);
    keeps_numerators::<FixedRational<i8>>(&rationals);
    keeps_numerators::<FixedRational<i64>>(&rationals);
    keeps_numerators::<FixedRational<i128>>(&rationals);
}

/// Floats that reach every branch of an algorithm.
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
    obeys_embedding::<Interval>(&wide());
    obeys_integers::<Interval>();
    keeps_numerators::<Interval>(&wide());
}

#[test]
fn double_doubles() {
    let floats = FLOATS.into_iter().chain([-1.0, -1e289, f64::NAN]);
    let operands = floats.flat_map(|high| {
        let low = DoubleDouble::new(high * -1e-17);
        [DoubleDouble::new(high), DoubleDouble::new(high) + low]
    });
    obeys_algebra(&operands.collect::<Vec<_>>());
    obeys_embedding::<DoubleDouble>(&wide());
    obeys_integers::<DoubleDouble>();
    keeps_numerators::<DoubleDouble>(&wide());
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
        Polynomial::from_integer(-1),
        Polynomial::constant(&ratio(i64::MIN, i64::MAX)),
        x.clone(),
        -y.clone(),
        x.clone() - &y,
        x.clone() + &y,
        (x.clone() * &x * &y).div_int(seventh) - &Polynomial::from_integer(5),
        x.clone() * &long + &y.div_int(i64::MIN.try_into().expect("not zero")),
        long - &x,
    ]);
    obeys_integers::<Polynomial>();
    keeps_numerators::<Polynomial>(&wide());
}

/// All laws. The laws of the embedding apply if the second scalar can represent the operands.
fn pairs_obey<B: Field + Bounded>() {
    let mut rationals = wide();
    obeys_integers::<Pair<Q, B>>();
    let image = Pair::<Q, B>::from_rational;
    obeys_algebra(&rationals.iter().step_by(6).map(image).collect::<Vec<_>>());
    rationals.retain(|r| image(r).divergence().is_none());
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

#[test]
fn a_pair_has_the_weaker_exactness() {
    let [single, double] = [24, 53].map(|bits| Exactness::Rounded { bits });
    let promises = [
        Exactness::Exact,
        Exactness::ExactOrFault,
        Exactness::Enclosure,
        double,
        single,
    ];
    for (n, stronger) in promises.into_iter().enumerate() {
        for weakest in &promises[n..] {
            assert_eq!(weaker(stronger, *weakest), *weakest);
            assert_eq!(weaker(*weakest, stronger), *weakest);
        }
    }
}
