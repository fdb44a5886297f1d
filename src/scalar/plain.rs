//! Number types of `num-traits` as scalars, without code of one's own.

use core::fmt::{self, Debug};
use core::marker::PhantomData;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};
use core::sync::atomic::{AtomicUsize, Ordering};

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{FromPrimitive, Num};

use super::{Algebra, CorrectlyRounded, Exactness, Field, Ring};

/// A number type of `num-traits` 0.2 as a scalar: `pile.forces::<Plain<half::bf16>>()`.
///
/// The value is `.0`, and `Plain::from` makes one. The promise `P` says what is known of `T`: [`Unknown`], [`Rounded`] or
/// [`Exact`]. Other scalars, such as a float whose precision is a value, implement [`Algebra`].
///
/// # What is refused
/// Integer types truncate quotients, and ratios such as `Ratio<i64>` may wrap. None of their values is
/// [defined](Algebra::is_defined): the first query returns [`Error::Overflow`](crate::Error::Overflow), whose text says what to
/// use: [`FixedRational`](super::FixedRational). Unsigned types do not compile. A type is also refused if it does not
/// convert every `u64`, and if it promises [`Exact`] but rounds.
///
/// Infinities and not-a-number are undefined too: a query returns an error in their place. The library never divides by
/// zero, except that [`Rounded`] computes 0/0 to get not-a-number. An operator of the type that panics, for example on
/// overflow, panics in the query. A float that wraps beyond 2^64 is not detected, nor a
/// ratio that wraps beyond 384 bits: promise [`Exact`] for integers of any size alone.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::scalar::Plain;
/// use cannonpile::{Error, Pile};
///
/// let pile = Pile::triangular(10)?;
/// let site = Site::new(2, 3, 7);
/// let force = pile.forces::<Plain<f32>>().contact(site, Direction::Alpha)?;
/// assert_eq!(force.0, 3.0);
///
/// let refused = pile.forces::<Plain<i64>>().contact(site, Direction::Alpha);
/// assert!(refused.unwrap_err().to_string().contains("use FixedRational"));
/// # Ok::<(), Error>(())
/// ```
/// Unsigned numbers have no differences:
/// ```compile_fail,E0277
/// # use cannonpile::scalar::Plain;
/// let pile = cannonpile::Pile::triangular(10).unwrap();
/// let forces = pile.forces::<Plain<u64>>();
/// ```
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub struct Plain<T, P = Unknown>(pub T, pub PhantomData<P>);

/// The promise of a type of which nothing is known. A rational becomes the quotient of two converted integers.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Unknown;

/// The promise of a binary float that rounds the result of every operation to nearest. Integers and rationals are rounded
/// once. The conversion to `f64` must be exact, and 0/0 must be not-a-number.
///
/// # Examples
/// ```
/// use cannonpile::ratio;
/// use cannonpile::scalar::{Algebra, Exactness, Plain, promise};
///
/// type Single = Plain<f32, promise::Rounded>;
/// assert_eq!(Single::EXACTNESS, Exactness::Rounded { bits: 24 });
/// // Two converted integers and a quotient would round three times.
/// let rational = ratio!(16_777_217 / 3);
/// assert_eq!(Single::from_rational(&rational).0, f32::from_rational(&rational));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Rounded;

/// The promise of rationals of any size, whose operations are all exact.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Exact;

/// The bounds on a number type. This trait and the next are sealed: a promise that does not hold could give a wrong number
/// that is called exact.
pub trait Number: Num + Neg<Output = Self> + FromPrimitive + Clone + Debug + Send + Sync {}

impl<T: Num + Neg<Output = T> + FromPrimitive + Clone + Debug + Send + Sync> Number for T {}

/// What is known of a number type.
pub trait Promise<T: Number>: Clone + PartialEq + Send + Sync {
    const EXACTNESS: Exactness;

    /// The number of bits of integers that the type converts exactly or with the best rounding.
    const CONVERTED_BITS: u32 = 127;

    /// Returns whether the type is accepted as a scalar.
    fn accepts() -> bool {
        true
    }

    fn from_rational(r: &BigRational) -> T {
        let number = is_accepted::<T, Self>().then(|| quotient(r));
        // A refused type computes with zeros, so that no overflow comes before the error. An accepted one has a quotient.
        number.flatten().unwrap_or_else(T::zero)
    }

    fn from_integer(n: i128) -> T {
        let converted = T::from_i128(n).filter(|_| n.unsigned_abs() >> Self::CONVERTED_BITS == 0);
        converted.unwrap_or_else(|| Self::from_rational(&BigInt::from(n).into()))
    }

    fn div_int(value: T, n: NonZeroI64) -> T {
        value / Self::from_integer(n.get().into())
    }
}

impl<T: Number> Promise<T> for Unknown {
    const EXACTNESS: Exactness = Exactness::Unknown;

    fn accepts() -> bool {
        let thirds = three_thirds::<T>();
        !thirds.is_zero() && T::from_u64(u64::MAX).is_some() && (!thirds.is_one() || is_wide::<T>())
    }
}

impl<T: Number> Promise<T> for Exact {
    const EXACTNESS: Exactness = Exactness::Exact;

    fn accepts() -> bool {
        three_thirds::<T>().is_one() && is_wide::<T>()
    }
}

impl<T: Number + CorrectlyRounded + Into<f64>> Promise<T> for Rounded {
    const EXACTNESS: Exactness = Exactness::Rounded { bits: T::PRECISION };
    const CONVERTED_BITS: u32 = T::PRECISION;

    fn from_rational(r: &BigRational) -> T {
        // 0/0 is not-a-number.
        T::nearest_to_rational(r).unwrap_or_else(|| T::zero() / T::zero())
    }

    fn div_int(value: T, n: NonZeroI64) -> T {
        let is_long = n.get().unsigned_abs() >> T::PRECISION != 0;
        if is_long && let Some(exact) = BigRational::from_float(value.into()) {
            // The exact quotient is rounded once. Otherwise the divisor would be rounded too.
            return Self::from_rational(&(exact / BigInt::from(n.get())));
        }
        value / Self::from_integer(n.get().into())
    }
}

/// Returns [`Promise::accepts`]. Its test takes longer than an operation, so the last type that passed it is not tested again.
///
/// The type is known by the address of its test. Types share an address only if their tests are the same code, whose result must
/// not depend on anything else.
fn is_accepted<T: Number, P: Promise<T>>() -> bool {
    static LAST: AtomicUsize = AtomicUsize::new(0);
    let test: fn() -> bool = P::accepts;
    if LAST.load(Ordering::Relaxed) == test as usize {
        return true;
    }
    let accepts = test();
    if accepts {
        LAST.store(test as usize, Ordering::Relaxed);
    }
    accepts
}

/// Returns (4/3 − 1)·3: one for an exact type, zero for integers. If 4/3 is rounded, the difference to 1 shows the error.
fn three_thirds<T: Number>() -> T {
    let three = T::one() + T::one() + T::one();
    ((three.clone() + T::one()) / three.clone() - T::one()) * three
}

/// Returns whether an exact type holds numbers beyond 128 bits, even if they come from products. A quotient of powers of
/// two takes a short time in rationals, unlike one of other numbers.
fn is_wide<T: Number>() -> bool {
    let is_held = |n: T| n.clone() * n.clone() * n.clone() / n.clone() / n.clone() == n;
    T::from_u128(1 << 127).is_some_and(is_held)
}

/// Returns whether a value is neither infinite nor not-a-number.
fn is_number<T: Number>(value: &T) -> bool {
    (value.clone() * T::zero()).is_zero()
}

/// Returns the quotient of numerator and denominator. Where the type does not hold one of them, its low bits are lost.
fn quotient<T: Number>(r: &BigRational) -> Option<T> {
    let held = |n: &BigInt| (0..=n.bits()).find_map(|e| Some((integer::<T>(&(n >> e))?, e)));
    let ((n, n_lost), (d, d_lost)) = (held(r.numer())?, held(r.denom())?);
    let two = T::one() + T::one();
    let factor = if n_lost > d_lost { two } else { T::one() / two };
    Some((0..n_lost.abs_diff(d_lost)).fold(n / d, |value, _| value * factor.clone()))
}

/// Returns an integer, if the type holds it. One that is too long for a conversion is the sum of its bits.
fn integer<T: Number>(n: &BigInt) -> Option<T> {
    let by_bits = || {
        let mut digits = (0..n.bits())
            .rev()
            .map(|bit| u8::from(n.magnitude().bit(bit)));
        let sum = digits.try_fold(T::zero(), |sum: T, digit| {
            Some(sum.clone() + sum + T::from_u8(digit)?).filter(is_number)
        })?;
        Some(if n.sign() == Sign::Minus { -sum } else { sum })
    };
    let converted = i128::try_from(n).ok().and_then(T::from_i128);
    converted.or_else(by_bits).filter(is_number)
}

impl<T, P> From<T> for Plain<T, P> {
    fn from(value: T) -> Self {
        Self(value, PhantomData)
    }
}

impl<T: Debug, P> Debug for Plain<T, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

macro_rules! operators {
    ($($name:ident $method:ident)*) => {$(
        impl<T: Number, P> $name<&Self> for Plain<T, P> {
            type Output = Self;

            fn $method(self, other: &Self) -> Self {
                self.0.$method(other.0.clone()).into()
            }
        }
    )*};
}

operators!(Add add Sub sub Mul mul);
crate::ring!([T: Number, P: Promise<T>] Plain<T, P>);

impl<T: Number, P: Promise<T>> Ring for Plain<T, P> {
    fn from_integer(n: i128) -> Self {
        P::from_integer(n).into()
    }
}

impl<T: Number, P: Promise<T>> Algebra for Plain<T, P> {
    const EXACTNESS: Exactness = P::EXACTNESS;
    const NAME: &'static str = "this number type (for integers and ratios, use FixedRational)";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        P::from_rational(r).into()
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        P::div_int(self.0, n).into()
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        if divisor.0.is_one() {
            return Some(self.clone());
        }
        let divides = !divisor.0.is_zero() && is_number(&divisor.0);
        divides.then(|| (self.0.clone() / divisor.0.clone()).into())
    }

    fn is_defined(&self) -> bool {
        is_accepted::<T, P>() && is_number(&self.0)
    }
}

impl<T: Number, P: Promise<T>> Field for Plain<T, P> {}
