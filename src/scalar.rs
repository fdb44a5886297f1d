//! The number traits every formula is written over, and the numbers that implement them.
//!
//! The traits are small, and say no more than a formula needs:
//!
//! | trait | what it promises | who stops here |
//! |---|---|---|
//! | [`Ring`] | `+ − ×` and the integers | integers |
//! | [`Algebra`] | a ring that contains ℚ: rationals in, division by a nonzero machine integer | polynomials |
//! | [`Field`] | division by whatever is not zero | |
//! | [`RealEmbeddable`] | comparison with rationals: a sign, and rational bounds | |
//!
//! [`Field`] and [`RealEmbeddable`] are independent: the first is algebraic structure, the second
//! is order. None of them is built on `num_traits::{Num, Float}`, none asks for `Copy`, and no
//! formula contains a float literal, so that a polynomial runs through the same body as an `f64`.
//!
//! | scalar | exactness | for |
//! |---|---|---|
//! | `f32`, `f64` | [`Rounded`](Exactness::Rounded) | speed |
//! | [`BigRational`] | [`Exact`](Exactness::Exact) | proof by computation, any size |
//! | [`DoubleDouble`] | [`Rounded`](Exactness::Rounded) | twice the digits of `f64` |
//! | [`Interval`] | [`Enclosure`](Exactness::Enclosure) | bounds that hold the true value |
//! | [`Polynomial`] | [`ExactOrFault`](Exactness::ExactOrFault) | symbols: proof for every pile at once |
//! | [`FixedRational`] | [`ExactOrFault`](Exactness::ExactOrFault) | exact and small, and never silently wrong |
//!
//! [`laws`] is the one suite that all of them pass, and that a scalar of your own should pass.
//! [`Surd`] is not a scalar: it is the exact value c·√r at the edge, where roots come in.

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

pub use exact_surd::{DoubleDouble, NearestFloat, Surd, parse};
pub use fixed::{FixedInteger, FixedRational};
pub use interval::Interval;
pub use polynomial::{Polynomial, Symbol};
#[doc(hidden)]
pub use ratio::quotient;

pub(crate) use exact_surd::float_between;
pub(crate) use exact_surd::rational::{common_denominator, common_multiple, product, sum_of};

use core::fmt::{self, Debug};
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use exact_surd::layout::{padded, part};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

// What is divided by in formulas. Unwrapped by the compiler: zero would not build.
pub(crate) const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();
pub(crate) const THREE: NonZeroI64 = NonZeroI64::new(3).unwrap();

/// How the result of an operation relates to the true one.
///
/// It is part of the scalar's type ([`Algebra::EXACTNESS`]); the law suite reads it to know what to
/// demand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Exactness {
    /// Every operation gives the true value.
    Exact,
    /// Every operation gives the true value, or a fault that spreads to all that is computed from
    /// it and is unequal to everything, itself included.
    ExactOrFault,
    /// Every operation gives bounds that hold the true value.
    Enclosure,
    /// Every single operation on finite operands that neither overflows nor underflows errs by at
    /// most 2^(−`bits`) of the true value: 24 for `f32`, 53 for `f64`.
    Rounded {
        /// The precision p of the significand, in bits.
        bits: u32,
    },
}

impl Exactness {
    /// Returns what two scalars promise together.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Algebra, Exactness};
    ///
    /// assert_eq!(f64::EXACTNESS.weaker(f32::EXACTNESS), Exactness::Rounded { bits: 24 });
    /// assert_eq!(Exactness::Exact.weaker(Exactness::Enclosure), Exactness::Enclosure);
    /// ```
    #[must_use]
    pub const fn weaker(self, other: Self) -> Self {
        match (self, other) {
            (Self::Rounded { bits: a }, Self::Rounded { bits: b }) => Self::Rounded {
                bits: if a < b { a } else { b },
            },
            (rounded @ Self::Rounded { .. }, _) | (_, rounded @ Self::Rounded { .. }) => rounded,
            (Self::Enclosure, _) | (_, Self::Enclosure) => Self::Enclosure,
            (Self::ExactOrFault, _) | (_, Self::ExactOrFault) => Self::ExactOrFault,
            (Self::Exact, Self::Exact) => Self::Exact,
        }
    }
}

/// A commutative ring with the integers in it: all that most formulas need.
///
/// Operators take the right operand by reference, so that no big number is copied for nothing; in a generic body `Self`
/// stays on the left. So a·b − a of two references is `a.clone() * b - a`, and a temporary value on the right needs `&`.
///
/// Every scalar is `Send` and `Sync`, also without the feature `rayon`, with which threads share the rows of a layer. Cargo
/// turns a feature on for all crates of a build: if `rayon` added these bounds, another dependency could break a scalar
/// without them. So a value that holds an `Rc`, such as a node of a tape for reverse differentiation, is no scalar. An
/// index into the tape, or an `Arc`, is.
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
/// For exact scalars, and for rounded ones as far as their precision goes ([`laws`] checks this):
/// * `+` and `*` are commutative and associative, `*` distributes over `+`;
/// * [`Zero::zero`] and [`One::one`] are their neutral elements, `a + &(-a)` is zero;
/// * [`from_i128`](Self::from_i128) respects `+`, `*` and 1.
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
    /// Returns the image of the integer `n`: exact, or rounded once.
    fn from_i128(n: i128) -> Self;
}

/// The integers themselves, of any size: numerators over a denominator known beforehand.
impl Ring for BigInt {
    fn from_i128(n: i128) -> Self {
        n.into()
    }
}

/// A commutative algebra over ℚ: what the formulas of this crate are evaluated in.
///
/// # Laws
/// * those of a [`Ring`];
/// * [`from_rational`](Self::from_rational) respects `+`, `*` and 1, and agrees with
///   [`from_i128`](Ring::from_i128);
/// * `a.div_int(n)` is the one `b` with `b * n = a`;
///
/// # Examples
/// A formula written once, evaluated in two scalars:
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
    /// How far results can be trusted.
    const EXACTNESS: Exactness;

    /// The scalar's name in messages, such as `f64`.
    const NAME: &'static str;

    /// Returns the image of the rational `r`: exact, or rounded once to the nearest.
    fn from_rational(r: &BigRational) -> Self;

    /// Returns `self / n`.
    #[must_use]
    fn div_int(self, n: NonZeroI64) -> Self;

    /// Returns whether the value stands for a number; false for a fault, an infinity, not-a-number.
    ///
    /// The library asks once, before it returns a value, and answers [`Error::Overflow`](crate::Error::Overflow) if this is
    /// false. Operations may return undefined values freely.
    fn is_defined(&self) -> bool;

    /// Returns whether two values may stand for the same number: equality, or for bounds that they overlap.
    fn may_equal(&self, other: &Self) -> bool {
        self == other
    }
}

/// A scalar that is its own ring of numerators: every one but the rationals, whose numerators are integers.
///
/// The engines compute numerators over a known denominator and divide once. A scalar of your own needs this and nothing
/// else for them.
///
/// # Examples
/// In a [`Field`] the quotient is that of the field:
/// ```text
/// impl OwnNumerators for Mine {
///     fn ratio(n: Self, d: &Self) -> Option<Self> {
///         n.checked_div(d)
///     }
/// }
/// ```
pub trait OwnNumerators: Algebra + Numerators<Numerator = Self> {
    /// Returns n/d, reduced or rounded once; `None` if d is zero or does not divide n in the scalar.
    fn ratio(n: Self, d: &Self) -> Option<Self>;
}

/// What the engines compute a scalar by: numerators over a common denominator, and one division at the end.
///
/// A scalar of your own has it by [`OwnNumerators`].
#[doc(hidden)]
pub trait Numerators: Sized {
    /// The ring in which a formula is cheapest before one final division: the scalar itself, or for
    /// rationals their integers, where nothing is reduced along the way.
    ///
    /// For a scalar of your own it is `Self`: implement [`OwnNumerators`], and this trait follows.
    type Numerator: Ring;

    /// Returns numerators of `values` over a common denominator, and that denominator.
    ///
    /// For rationals they are integers, and the denominator is the least one; a scalar that is its own ring
    /// of numerators takes the values themselves, over 1.
    fn numerators<const N: usize>(
        values: &[BigRational; N],
    ) -> ([Self::Numerator; N], Self::Numerator);

    /// Returns `n / by` in the ring of numerators, or `None` if its denominator has to take the divisor instead, as for
    /// integers. Which of the two it is does not depend on `n`.
    #[must_use]
    fn divide_numerator(n: Self::Numerator, by: NonZeroI64) -> Option<Self::Numerator>;

    /// Returns `n / d`, reduced or rounded once; `None` if `d` is zero or does not divide `n` in the scalar.
    fn from_ratio(n: Self::Numerator, d: &Self::Numerator) -> Option<Self>;
}

impl<T: OwnNumerators> Numerators for T {
    type Numerator = T;

    fn numerators<const N: usize>(values: &[BigRational; N]) -> ([T; N], T) {
        (values.each_ref().map(T::from_rational), T::one())
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

/// The sign of a value on the real line, as far as the scalar knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RealSign {
    /// Less than zero.
    Negative,
    /// Zero.
    Zero,
    /// Greater than zero.
    Positive,
    /// Not known to the scalar, as for a fault or not-a-number.
    Unknown,
}

/// Rational bounds of a value: `lower ≤ x ≤ upper`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Enclosure {
    /// The greatest lower bound that is known.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub lower: BigRational,
    /// The least upper bound that is known.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub upper: BigRational,
}

impl Enclosure {
    /// Returns the enclosure of a value known exactly.
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
        &self.lower <= value && value <= &self.upper
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
        let [lower, upper] = [&self.lower, &self.upper].map(|bound| part(f, bound));
        padded(f, format_args!("[{lower}, {upper}]"))
    }
}

/// A scalar that can be compared with rationals: it has a sign, and rational bounds.
///
/// Of a rounded scalar this is the place of the *stored* value, which says nothing certain about
/// the quantity it approximates: a verdict needs a scalar that is exact.
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

    /// Returns the tightest rational bounds known, or `None` for a value without finite bounds.
    fn enclosure(&self) -> Option<Enclosure>;
}
