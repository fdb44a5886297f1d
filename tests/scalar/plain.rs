//! Number types of `num-traits` as scalars: floats give the forces of their own implementations, exact types are exact, and
//! types that truncate or wrap are refused.

use core::num::Wrapping;
use core::ops::Neg;

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::num_bigint::BigInt;
use cannonpile::num_rational::{BigRational, Ratio};
use cannonpile::num_traits::{FromPrimitive, Num, One, Pow, ToPrimitive, Zero};
use cannonpile::scalar::promise::{Exact, Rounded, Unknown};
use cannonpile::scalar::{Algebra, Exactness, FixedRational, Plain, Ring, laws};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use cannonpile_testkit::answers::ratio;

fn piles() -> impl Iterator<Item = Pile> {
    ["++++++++", "+-+-+-+-", "++-+---+"]
        .into_iter()
        .map(|stacking| {
            let top = Region::hexagon(2, 3).unwrap();
            Pile::under(top, stacking.parse().unwrap()).unwrap()
        })
}

/// Returns all forces one by one, and those that the sweep writes.
fn forces<T: Algebra>(pile: &Pile) -> Result<Vec<T>, Error> {
    let forces = pile.forces::<T>();
    let contacts = forces
        .contacts(Selection::All)?
        .map(|found| Ok(found?.force));
    let base = forces.base(Selection::Base)?.map(|found| Ok(found?.normal));
    let mut found: Vec<T> = contacts.chain(base).collect::<Result<_, Error>>()?;
    let layers = forces.layers(Selection::All)?;
    let mut slices = [(); 3].map(|()| vec![T::zero(); layers.slice_len().unwrap()]);
    layers.fill(slices.each_mut().map(Vec::as_mut_slice))?;
    found.extend(slices.into_iter().flatten());
    Ok(found)
}

fn values<T, P>(pile: &Pile) -> Vec<T>
where
    Plain<T, P>: Algebra,
{
    let found = forces::<Plain<T, P>>(pile).unwrap();
    found.into_iter().map(|value| value.0).collect()
}

#[test]
fn floats_give_the_forces_of_their_scalars() {
    for pile in piles() {
        assert_eq!(values::<f64, Rounded>(&pile), forces::<f64>(&pile).unwrap());
        assert_eq!(values::<f32, Rounded>(&pile), forces::<f32>(&pile).unwrap());
        // Without a promise a third is a quotient too, so the numbers are the same.
        assert_eq!(values::<f64, Unknown>(&pile), forces::<f64>(&pile).unwrap());
    }
}

#[test]
fn exact_types_are_exact() {
    for pile in piles() {
        let exact = forces::<BigRational>(&pile).unwrap();
        assert_eq!(values::<BigRational, Unknown>(&pile), exact);
        assert_eq!(values::<BigRational, Exact>(&pile), exact);
    }
}

fn is_refused<S: Algebra + From<T>, T>(number: T) {
    // The library remembers which type it has accepted last.
    assert!(Plain::<f64>::from(1.0).is_defined());
    for pile in piles().chain([Pile::triangular(1).unwrap(), Pile::triangular(30).unwrap()]) {
        let text = forces::<S>(&pile).unwrap_err().to_string();
        assert!(text.contains("use FixedRational"), "{text}");
    }
    assert!(!S::from_integer(1).is_defined() && !S::from(number).is_defined());
}

#[test]
fn types_that_truncate_or_wrap_are_refused() {
    is_refused::<Plain<_>, _>(1_i8);
    is_refused::<Plain<_>, _>(1_i64);
    is_refused::<Plain<_>, _>(1_i128);
    is_refused::<Plain<_>, _>(Wrapping(1_i64));
    is_refused::<Plain<_>, _>(BigInt::one());
    is_refused::<Plain<_>, _>(Ratio::<i8>::one());
    is_refused::<Plain<_>, _>(Ratio::<i64>::one());
    is_refused::<Plain<_>, _>(Ratio::<i128>::one());
    is_refused::<Plain<_>, _>(Fraction::one());
    is_refused::<Plain<_, Exact>, _>(Ratio::<i64>::one());
    is_refused::<Plain<_, Exact>, _>(Fraction::one());
    // The remedy.
    for pile in piles() {
        let fixed = forces::<FixedRational<i64>>(&pile).unwrap();
        let found: Vec<_> = fixed.iter().map(|x| x.to_rational().unwrap()).collect();
        assert_eq!(found, forces::<BigRational>(&pile).unwrap());
    }
}

#[test]
fn a_promise_of_exactness_is_refused_if_the_type_rounds() {
    is_refused::<Plain<_, Exact>, _>(1.0_f64);
    is_refused::<Plain<_, Exact>, _>(1.0_f32);
}

/// A load of one's own enters without a conversion.
#[test]
fn loads_of_a_refused_type_give_an_error() {
    let pile = Pile::under(Region::SITE, "+-+".parse().unwrap())
        .unwrap()
        .weightless();
    let forces = pile
        .forces::<Plain<i64>>()
        .with_load(Site::APEX, Plain::from(5))
        .unwrap();
    assert!(
        forces
            .contact(Site::new(0, 0, 1), Direction::Alpha)
            .is_err()
    );
    assert!(forces.on_floor(Site::new(0, 0, 3)).is_err());
}

#[test]
fn values_that_are_no_numbers_are_undefined() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(!Plain::<f64>::from(value).is_defined());
        assert_eq!(Plain::<f64>::from(1.0).checked_div(&value.into()), None);
    }
    assert_eq!(Plain::<f64>::from(1.0).checked_div(&0.0.into()), None);
    let huge = BigRational::from_integer(BigInt::from(10).pow(400_u32));
    assert!(!Plain::<f64, Rounded>::from_rational(&huge).is_defined());
    assert!(!Plain::<f64>::from_rational(&huge).is_defined());
}

#[test]
fn numbers_beyond_the_type_keep_their_first_digits() {
    let power = |e: u32| BigInt::from(10).pow(e);
    let near = |r: &BigRational, want: f64| {
        let found = Plain::<f64>::from_rational(r).0;
        assert!((found / want - 1.0).abs() < 1e-15, "{found} is not {want}");
    };
    near(&BigRational::new(power(400), power(400) * 3 + 1), 1.0 / 3.0);
    near(&BigRational::new(-power(400), power(390)), -1e10);
    near(
        &BigRational::new(-power(4_000) * 7 - 1, power(4_100)),
        -7e-100,
    );
    let large = Plain::<f64>::from_integer(i128::MAX);
    assert_eq!(large, Plain::from(i128::MAX.to_f64().unwrap()));
    for n in [i128::MIN, i128::MAX, -1, 0, 1] {
        let exact = BigRational::from_integer(n.into());
        assert_eq!(Plain::<BigRational>::from_integer(n).0, exact);
    }
    let long = BigRational::new(power(300) + 1, power(200) * 3);
    assert_eq!(Plain::<BigRational>::from_rational(&long).0, long);
}

/// Checks the laws of a promise.
fn laws_hold<T, P>(rational: impl Fn(T) -> Option<BigRational>)
where
    T: Clone,
    Plain<T, P>: cannonpile::scalar::Field,
{
    let known = |x: &Plain<T, P>| rational(x.0.clone()).map(|x| [x.clone(), x]);
    let numbers = [
        ratio(1, 3),
        ratio(-22, 7),
        ratio(5, 1),
        ratio(0, 1),
        ratio(1_001, 64),
        ratio(-1, 1_000),
    ];
    for (a, b) in numbers
        .iter()
        .flat_map(|a| numbers.iter().map(move |b| (a, b)))
    {
        let [x, y, z] = [a, b, &numbers[0]].map(Plain::<T, P>::from_rational);
        laws::algebra(&x, &y, &z).unwrap();
        laws::embedding(a, b, known).unwrap();
        laws::numerators::<Plain<T, P>>(a, b).unwrap();
    }
}

#[test]
fn laws_hold_for_each_promise() {
    laws_hold::<f32, Rounded>(BigRational::from_float);
    laws_hold::<f64, Rounded>(BigRational::from_float);
    laws_hold::<f64, Unknown>(BigRational::from_float);
    laws_hold::<BigRational, Unknown>(Some);
    laws_hold::<BigRational, Exact>(Some);
    for shift in 0..127 {
        for n in [(1 << shift) + 1, 1 - (1 << shift), 3 << shift >> 1] {
            laws::integers::<Plain<f32, Rounded>>(n).unwrap();
            laws::integers::<Plain<BigRational, Exact>>(n).unwrap();
        }
    }
    assert_eq!(<Plain<f32> as Algebra>::EXACTNESS, Exactness::Unknown);
    assert_eq!(
        <Plain<f32, Rounded> as Algebra>::EXACTNESS,
        Exactness::Rounded { bits: 24 }
    );
    assert_eq!(
        <Plain<BigRational, Exact> as Algebra>::EXACTNESS,
        Exactness::Exact
    );
}

#[cfg(feature = "half")]
mod half {
    use exact_surd::half::{bf16, f16};

    use super::*;

    #[test]
    fn forces_of_straight_piles_are_exact() {
        let pile = Pile::triangular(10).unwrap();
        let exact = forces::<f64>(&pile).unwrap();
        let found = |values: Vec<f64>| assert_eq!(values, exact);
        found(
            values::<f16, Unknown>(&pile)
                .into_iter()
                .map(f64::from)
                .collect(),
        );
        found(
            values::<bf16, Unknown>(&pile)
                .into_iter()
                .map(f64::from)
                .collect(),
        );
        found(
            values::<bf16, Rounded>(&pile)
                .into_iter()
                .map(f64::from)
                .collect(),
        );
    }

    #[test]
    fn forces_below_sign_changes_are_close() {
        for pile in piles() {
            let exact = forces::<f64>(&pile).unwrap();
            let greatest = exact
                .iter()
                .fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
            for (found, exact) in values::<f16, Rounded>(&pile).into_iter().zip(exact) {
                assert!((f64::from(found) - exact).abs() <= greatest * 2.0_f64.powi(-8));
            }
        }
    }

    /// The greatest `f16` is 65504.
    #[test]
    fn forces_beyond_the_format_are_an_error() {
        let site = Site::new(0, 0, 69_999);
        let pile = Pile::triangular(100_000).unwrap();
        let found = pile.forces::<Plain<f16>>().contact(site, Direction::Alpha);
        assert!(matches!(found, Err(Error::Overflow { .. })), "{found:?}");
        let found = pile
            .forces::<Plain<f16, Rounded>>()
            .contact(site, Direction::Alpha);
        assert!(matches!(found, Err(Error::Overflow { .. })), "{found:?}");
        let found = pile
            .forces::<Plain<bf16, Rounded>>()
            .contact(site, Direction::Alpha)
            .unwrap();
        assert_eq!(found.0, bf16::from_f64(70_000.0));
    }

    #[test]
    fn laws_hold_for_half_precision() {
        laws_hold::<f16, Rounded>(|x| BigRational::from_float(x.to_f64()));
        laws_hold::<bf16, Rounded>(|x| BigRational::from_float(x.to_f64()));
        laws_hold::<bf16, Unknown>(|x| BigRational::from_float(x.to_f64()));
        for n in
            (-70_000..70_000).chain((20..120).map(|shift| (1 << shift) + (1 << (shift - 9)) + 1))
        {
            laws::integers::<Plain<f16, Rounded>>(n).unwrap();
            laws::integers::<Plain<bf16, Rounded>>(n).unwrap();
        }
    }
}

/// A ratio of 200 bits that wraps, as of unsigned machine integers with a sign beside them.
#[derive(Clone, Debug, PartialEq)]
struct Fraction(BigRational);

impl Fraction {
    fn wrapped(exact: &BigRational) -> Self {
        let [n, d] = [exact.numer(), exact.denom()].map(|n| n % BigInt::from(2).pow(200_u32));
        Self(BigRational::new(n, d))
    }
}

macro_rules! operators {
    ($($name:ident $method:ident)*) => {$(
        impl core::ops::$name for Fraction {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                Self::wrapped(&self.0.$method(other.0))
            }
        }
    )*};
}
operators!(Add add Sub sub Mul mul Div div Rem rem);

impl Neg for Fraction {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Fraction {
    fn zero() -> Self {
        Self(ratio(0, 1))
    }

    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl One for Fraction {
    fn one() -> Self {
        Self(ratio(1, 1))
    }
}

impl Num for Fraction {
    type FromStrRadixErr = ();

    fn from_str_radix(_: &str, _: u32) -> Result<Self, ()> {
        Err(())
    }
}

impl FromPrimitive for Fraction {
    fn from_i64(n: i64) -> Option<Self> {
        BigRational::from_i64(n).map(Self)
    }

    fn from_u64(n: u64) -> Option<Self> {
        BigRational::from_u64(n).map(Self)
    }

    fn from_u128(n: u128) -> Option<Self> {
        BigRational::from_u128(n).map(Self)
    }
}
