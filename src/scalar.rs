//! The number traits that the formulas are generic over, and the scalar types that implement them.
//!
//! The traits are small. Each formula requires only the traits it needs:
//!
//! | trait | operations | implemented by |
//! |---|---|---|
//! | [`Ring`] | `+ − ×` and conversion from integers | all scalar types, and `BigInt` |
//! | [`Algebra`] | conversion from rationals, division by a nonzero machine integer | all scalar types |
//! | [`Field`] | division by any nonzero value | all but [`Polynomial`] |
//! | [`RealEmbeddable`] | comparison with rationals: a sign and rational bounds | all but [`Polynomial`] |
//!
//! [`Field`] and [`RealEmbeddable`] are independent: the first is algebraic structure, the second is order. The traits
//! do not require `num_traits::{Num, Float}` or `Copy`, and the formulas contain no float literal. So a polynomial and
//! an `f64` use the same function bodies.
//!
//! | scalar | exactness | use |
//! |---|---|---|
//! | `f32`, `f64` | [`Rounded`](Exactness::Rounded) | speed |
//! | [`BigRational`] | [`Exact`](Exactness::Exact) | exact values of any size |
//! | [`DoubleDouble`] | [`Rounded`](Exactness::Rounded) | twice the digits of `f64` |
//! | [`Interval`] | [`Enclosure`](Exactness::Enclosure) | rigorous bounds of the true value |
//! | [`Polynomial`] | [`ExactOrFault`](Exactness::ExactOrFault) | symbols: proofs for every pile at once |
//! | [`FixedRational`] | [`ExactOrFault`](Exactness::ExactOrFault) | exact values of fixed width, with overflow detected |
//!
//! The functions in [`laws`] test a scalar type. All scalars above pass, and a scalar of your own should too. [`Surd`]
//! does not implement these traits: it is the exact value c·√r of results that contain a root.

/// Implements `+`, `-` and `*` with the right operand by value, through the operators that take it by reference.
macro_rules! by_value {
    ($scalar:ty $(, $generic:ident: $bound:path)?) => {
        impl$(<$generic: $bound>)? Add for $scalar {
            type Output = Self;

            fn add(self, rhs: Self) -> Self {
                self + &rhs
            }
        }

        impl$(<$generic: $bound>)? Sub for $scalar {
            type Output = Self;

            fn sub(self, rhs: Self) -> Self {
                self - &rhs
            }
        }

        impl$(<$generic: $bound>)? Mul for $scalar {
            type Output = Self;

            fn mul(self, rhs: Self) -> Self {
                self * &rhs
            }
        }
    };
}

mod double_double;
mod fixed;
mod float;
mod interval;
pub mod laws;
mod polynomial;
mod ratio;
mod rational;

pub use exact_surd::rational::{ByValue, reduced};
pub use exact_surd::{CorrectlyRounded, DoubleDouble, Surd, SurdSum, parse};
pub use fixed::{FixedInteger, FixedRational};
pub use interval::Interval;
pub use polynomial::{Polynomial, Symbol};
#[doc(hidden)]
pub use ratio::quotient;

pub(crate) use exact_surd::float_between;
pub(crate) use exact_surd::rational::{common_denominator, common_multiple, product, sum_of};

use crate::each::Each;
use core::fmt::{self, Debug};
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use exact_surd::layout::{padded, part};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

// The divisors in formulas. The compiler evaluates `unwrap`, so a zero would not compile.
pub(crate) const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();
pub(crate) const THREE: NonZeroI64 = NonZeroI64::new(3).unwrap();

/// The relation between the result of an operation and the true result.
///
/// The exactness is part of the scalar type ([`Algebra::EXACTNESS`]). The functions in [`laws`] test it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Exactness {
    /// Every operation gives the true value.
    Exact,
    /// Every operation gives the true value or a fault. Any operation on a fault gives a fault. A fault is unequal to
    /// every value, including itself.
    ExactOrFault,
    /// Every operation gives bounds that contain the true value.
    Enclosure,
    /// Every operation has a relative error of at most 2^(−`bits`), where `bits` is 24 for `f32` and 53 for `f64`. This
    /// holds for finite operands if the operation neither overflows nor underflows.
    Rounded {
        /// The precision p of the significand, in bits.
        bits: u32,
    },
}

/// A commutative ring that contains the integers. Most formulas need nothing else.
///
/// Operators take the right operand by reference, which avoids copies of big numbers. In generic code `Self` stays on
/// the left. For two references, a·b − a is `a.clone() * b - a`. A temporary value on the right needs `&`.
///
/// Every scalar is `Send` and `Sync`, with or without the feature `rayon`, whose threads share the rows of a layer.
/// Cargo enables a feature for all crates of a build. If `rayon` added these bounds, another dependency could therefore
/// break a scalar without them. A type that contains an `Rc`, such as a node of a tape for reverse differentiation,
/// cannot be a scalar. A type that contains an index into the tape, or an `Arc`, can.
///
/// # Examples
/// ```
/// use cannonpile::scalar::Ring;
///
/// fn square_of_difference<T: Ring>(a: &T, b: &T) -> T {
///     let difference = a.clone() - b;
///     difference.clone() * &difference
/// }
///
/// fn product_less_first<T: Ring>(a: &T, b: &T) -> T {
///     a.clone() * b - a
/// }
///
/// assert_eq!(square_of_difference(&2.0, &5.0), 9.0);
/// assert_eq!(product_less_first(&2.0, &5.0), 8.0);
/// ```
///
/// # Laws
/// The laws hold for exact scalars, and for rounded ones up to their precision. The module [`laws`] checks them.
/// * `+` and `*` are commutative and associative, and `*` distributes over `+`.
/// * [`Zero::zero`] and [`One::one`] are their neutral elements, and `a + &(-a)` is zero.
/// * [`from_i128`](Self::from_i128) respects `+`, `*` and 1.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a ring of cannonpile",
    note = "for exact rationals of machine integers use `FixedRational<i64>`; a scalar of your own implements `Ring`, `Algebra` and `OwnNumerators`"
)]
pub trait Ring:
    Clone
    + Debug
    + PartialEq
    + Zero
    + One
    + Neg<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
    + Send
    + Sync
{
    /// Returns the integer `n` as a value of this type: exact, or correctly rounded.
    fn from_i128(n: i128) -> Self;

    /// Returns a key: two values are equal if and only if their keys are. Rationals override it, because their `==`
    /// calls itself once for each common term of two continued fractions.
    #[doc(hidden)]
    fn comparison_key(&self) -> impl PartialEq {
        self
    }
}

/// The integers, of any size. They are numerators over a denominator that is known in advance.
impl Ring for BigInt {
    fn from_i128(n: i128) -> Self {
        n.into()
    }
}

/// A commutative algebra over ℚ. The formulas of this crate are evaluated in it.
///
/// # Laws
/// * The laws of a [`Ring`] hold.
/// * [`from_rational`](Self::from_rational) respects `+`, `*` and 1, and agrees with [`from_i128`](Ring::from_i128).
/// * `a.div_int(n)` is the unique `b` with `b * n = a`.
///
/// # Examples
/// One formula, evaluated in two scalar types:
/// ```
/// use cannonpile::scalar::Algebra;
/// use num_rational::BigRational;
///
/// fn triangle_number<T: Algebra>(n: &T) -> T {
///     (n.clone() * &(n.clone() + &T::one())).div_int(2.try_into().unwrap())
/// }
///
/// assert_eq!(triangle_number(&10.0), 55.0);
/// let half = BigRational::new(1.into(), 2.into());
/// assert_eq!(triangle_number(&half), BigRational::new(3.into(), 8.into()));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a scalar of cannonpile",
    note = "for exact rationals of machine integers use `FixedRational<i64>`; a scalar of your own implements `Ring`, `Algebra` and `OwnNumerators`"
)]
pub trait Algebra: Ring + Numerators {
    /// The relation between results and true values.
    const EXACTNESS: Exactness;

    /// The name of the scalar type in messages, such as `f64`.
    const NAME: &'static str;

    /// Returns the rational `r` as a value of this type: exact, or correctly rounded.
    fn from_rational(r: &BigRational) -> Self;

    /// Returns `self / n`.
    #[must_use]
    fn div_int(self, n: NonZeroI64) -> Self;

    /// Returns whether the value represents a number: false for a fault, an infinity or not-a-number.
    ///
    /// The library checks this once, before it returns a value, and returns [`Error::Overflow`](crate::Error::Overflow)
    /// if it is false. Operations may return undefined values freely.
    fn is_defined(&self) -> bool;

    /// Returns whether two values may represent the same number. For bounds this means that they overlap, otherwise
    /// that they are equal.
    fn may_equal(&self, other: &Self) -> bool {
        let [a, b] = [self, other].map(Self::comparison_key);
        a == b
    }
}

/// A scalar type that is its own ring of numerators. This applies to every scalar except the rationals, whose
/// numerators are integers.
///
/// The library computes numerators over a known denominator and divides once at the end. A scalar of your own
/// implements this trait for that purpose.
///
/// # Examples
/// In a [`Field`], use its division:
/// ```text
/// impl OwnNumerators for Mine {
///     fn ratio(n: Self, d: &Self) -> Option<Self> {
///         n.checked_div(d)
///     }
/// }
/// ```
pub trait OwnNumerators: Algebra + Numerators<Numerator = Self> {
    /// Returns n/d, reduced or correctly rounded. Returns `None` if d is zero or does not divide n in this type.
    fn ratio(n: Self, d: &Self) -> Option<Self>;
}

/// The numerators of a scalar type over a common denominator, and the division at the end.
///
/// A scalar of your own gets this trait from [`OwnNumerators`].
#[doc(hidden)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not say how it divides numerators",
    note = "a scalar of your own implements `OwnNumerators`: `fn ratio(n, d)` returns n/d"
)]
pub trait Numerators: Sized {
    /// The type of the numerators: the scalar itself, or integers for rationals, which avoids reductions of
    /// intermediate fractions.
    ///
    /// For a scalar of your own it is `Self`: implement [`OwnNumerators`] instead of this trait.
    type Numerator: Ring;

    /// Returns the numerators of `values` over a common denominator, and this denominator.
    ///
    /// For rationals the numerators are integers, and the denominator is the least common one. A scalar with
    /// [`OwnNumerators`] returns the values themselves, over 1.
    fn numerators<const N: usize>(
        values: &[BigRational; N],
    ) -> ([Self::Numerator; N], Self::Numerator);

    /// Returns the numerators of integers over a common denominator. Rationals keep this denominator, and a scalar with
    /// [`OwnNumerators`] divides by it.
    fn from_integers(
        integers: [BigInt; 3],
        denominator: impl FnOnce() -> BigInt,
    ) -> [Self::Numerator; 3];

    /// Returns the values as numerators over 1. Rationals, whose numerators need a common denominator, are returned as
    /// they are, in `Err`.
    fn into_numerators<const N: usize>(
        values: [Self; N],
    ) -> Result<[Self::Numerator; N], [BigRational; N]>;

    /// Returns `n / by`. Returns `None` for every `n` if the numerators, such as integers, do not allow this division.
    /// The caller then multiplies the denominator instead.
    #[must_use]
    fn divide_numerator(n: Self::Numerator, by: NonZeroI64) -> Option<Self::Numerator>;

    /// Returns `n / d`, reduced or correctly rounded. Returns `None` if `d` is zero or does not divide `n` in this
    /// type.
    fn from_ratio(n: Self::Numerator, d: &Self::Numerator) -> Option<Self>;
}

impl<T: OwnNumerators> Numerators for T {
    type Numerator = T;

    fn numerators<const N: usize>(values: &[BigRational; N]) -> ([T; N], T) {
        (values.each_ref().map(T::from_rational), T::one())
    }

    fn from_integers(integers: [BigInt; 3], denominator: impl FnOnce() -> BigInt) -> [T; 3] {
        let denominator = denominator();
        integers.each(|n| T::from_rational(&exact_surd::rational::quotient(n, &denominator)))
    }

    fn into_numerators<const N: usize>(values: [T; N]) -> Result<[T; N], [BigRational; N]> {
        Ok(values)
    }

    #[inline]
    fn divide_numerator(n: T, by: NonZeroI64) -> Option<T> {
        Some(n.div_int(by))
    }

    #[inline]
    fn from_ratio(n: T, d: &T) -> Option<T> {
        T::ratio(n, d)
    }
}

/// An [`Algebra`] with division.
///
/// # Laws
/// `a.checked_div(b)` is `None` if and only if `b` is zero or undefined; otherwise
/// `a.checked_div(b) * b = a`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a scalar of cannonpile with division",
    note = "a scalar of your own implements `Field`: `fn checked_div` returns the quotient, or `None` for a divisor of zero"
)]
pub trait Field: Algebra {
    /// Returns `self / divisor`, or `None` if the divisor is zero or undefined.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Field;
    ///
    /// assert_eq!(3.0.checked_div(&4.0), Some(0.75));
    /// assert_eq!(3.0.checked_div(&0.0), None);
    /// ```
    fn checked_div(&self, divisor: &Self) -> Option<Self>;
}

/// The sign of a real value, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RealSign {
    /// Less than zero.
    Negative,
    /// Zero.
    Zero,
    /// Greater than zero.
    Positive,
    /// Not known, as for a fault or not-a-number.
    Unknown,
}

/// Rational bounds of a value x: `lower ≤ x ≤ upper`.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Enclosure {
    /// The greatest known lower bound.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub lower: BigRational,
    /// The least known upper bound.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub upper: BigRational,
}

exact_surd::equality!(Hash for Enclosure; |x| [&x.lower, &x.upper].map(ByValue));

impl Enclosure {
    /// Returns the enclosure of a value that is known exactly.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Enclosure, RealEmbeddable};
    /// use num_rational::BigRational;
    ///
    /// // A float is a rational, and known exactly.
    /// let half = BigRational::new(1.into(), 2.into());
    /// assert_eq!(0.5_f64.enclosure(), Some(Enclosure::point(half)));
    /// ```
    #[must_use]
    pub fn point(value: BigRational) -> Self {
        Self {
            lower: value.clone(),
            upper: value,
        }
    }

    /// Returns whether `value` lies within the bounds.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Enclosure;
    /// use num_rational::BigRational;
    ///
    /// let half = BigRational::new(1.into(), 2.into());
    /// assert!(Enclosure::point(half.clone()).contains(&half));
    /// ```
    #[must_use]
    pub fn contains(&self, value: &BigRational) -> bool {
        ByValue(&self.lower) <= ByValue(value) && ByValue(value) <= ByValue(&self.upper)
    }
}

impl fmt::Display for Enclosure {
    /// Prints `[1/3, 1/2]`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::RealEmbeddable;
    ///
    /// let half = 0.5.enclosure().unwrap();
    /// assert_eq!(format!("{half:>14}"), "    [1/2, 1/2]");
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [lower, upper] = [&self.lower, &self.upper].each(|bound| part(f, bound));
        padded(f, format_args!("[{lower}, {upper}]"))
    }
}

/// A scalar type that can be compared with rationals: it has a sign and rational bounds.
///
/// For a rounded scalar, sign and bounds describe the *stored* value. They do not bound the quantity that this value
/// approximates, so a verdict needs an exact scalar.
///
/// # Laws
/// The sign is that of every value in the enclosure, or [`RealSign::Unknown`].
///
/// # Examples
/// ```
/// use cannonpile::scalar::{RealEmbeddable, RealSign};
///
/// assert_eq!((-0.5).sign(), RealSign::Negative);
/// assert_eq!(f64::NAN.sign(), RealSign::Unknown);
/// assert!(f64::INFINITY.enclosure().is_none());
/// ```
pub trait RealEmbeddable {
    /// Returns the sign of the value.
    fn sign(&self) -> RealSign;

    /// Returns the tightest known rational bounds, or `None` for a value without finite bounds.
    fn enclosure(&self) -> Option<Enclosure>;
}
