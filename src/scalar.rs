//! The number traits that the formulas are generic over, and the scalar types that implement them.
//!
//! The traits are small. Each formula requires only the traits it needs:
//!
//! | trait | operations | implemented by |
//! |---|---|---|
//! | [`Ring`] | `+ − ×` and conversion from integers | all scalar types, and `BigInt` |
//! | [`Algebra`] | conversion from rationals, division by a nonzero machine integer, other divisions if they exist | all scalar types |
//! | [`Field`] | division by any nonzero value | all but [`Polynomial`] |
//!
//! The traits have no order: a function that needs `<` asks for `PartialOrd`. They do not require
//! `num_traits::{Num, Float}` or `Copy`, and the formulas contain no float literal. So a polynomial and an `f64` use the
//! same function bodies.
//!
//! | scalar | exactness | use |
//! |---|---|---|
//! | `f32`, `f64` | [`Rounded`](Exactness::Rounded) | speed |
//! | [`BigRational`] | [`Exact`](Exactness::Exact) | exact values of any size |
//! | [`DoubleDouble`] | [`Rounded`](Exactness::Rounded) | twice the digits of `f64` |
//! | [`Interval`] | [`Enclosure`](Exactness::Enclosure) | rigorous bounds of the true value |
//! | [`Polynomial`] | [`ExactOrFault`](Exactness::ExactOrFault) | symbols: proofs for every pile at once |
//! | [`FixedRational`] | [`ExactOrFault`](Exactness::ExactOrFault) | exact values of fixed width, with overflow detected |
//! | [`Plain<T>`](Plain) | that of a [promise](mod@promise), else [`Unknown`](Exactness::Unknown) | any number type of `num-traits` |
//!
//! The functions in [`laws`] test a scalar type. All scalars above pass, and a scalar of your own should too. [`Surd`]
//! does not implement these traits: it is the exact value c·√r of results that contain a root.

/// Implements `+`, `-` and `*` with the right operand by value, through the operators that take it by reference. A type
/// with parameters has them in front, in brackets: `by_value!([T: Ring] Dual<T>)`.
///
/// # Examples
/// See [`ring!`](crate::ring), which calls it.
#[macro_export]
macro_rules! by_value {
    ([$($generics:tt)*] $scalar:ty: $name:ident $method:ident) => {
        impl<$($generics)*> ::core::ops::$name for $scalar {
            type Output = Self;

            fn $method(self, rhs: Self) -> Self {
                ::core::ops::$name::<&Self>::$method(self, &rhs)
            }
        }
    };
    ([$($generics:tt)*] $scalar:ty) => {
        $crate::by_value!([$($generics)*] $scalar: Add add);
        $crate::by_value!([$($generics)*] $scalar: Sub sub);
        $crate::by_value!([$($generics)*] $scalar: Mul mul);
    };
    ($scalar:ty) => {
        $crate::by_value!([] $scalar);
    };
}

/// Implements what a scalar of your own needs for [`Ring`](crate::scalar::Ring) and what follows from it: zero, one, `-a`,
/// and `+`, `-` and `*` with the right operand by value.
///
/// The type has `+`, `-` and `*` with the right operand by reference, `==`, and
/// [`Ring::from_integer`](crate::scalar::Ring::from_integer). A type with parameters has them in front, in brackets.
///
/// # Examples
/// ```
/// use core::ops::{Add, Mul, Sub};
///
/// use cannonpile::num_traits::{One, Zero};
/// use cannonpile::scalar::Ring;
///
/// /// An integer modulo 7.
/// #[derive(Clone, Debug, PartialEq)]
/// struct Residue(i128);
///
/// macro_rules! operator {
///     ($name:ident, $method:ident) => {
///         impl $name<&Self> for Residue {
///             type Output = Self;
///
///             fn $method(self, other: &Self) -> Self {
///                 Self::from_integer(self.0.$method(other.0))
///             }
///         }
///     };
/// }
/// operator!(Add, add);
/// operator!(Sub, sub);
/// operator!(Mul, mul);
///
/// impl Ring for Residue {
///     fn from_integer(n: i128) -> Self {
///         Self(n.rem_euclid(7))
///     }
/// }
///
/// cannonpile::ring!(Residue);
///
/// assert_eq!(-Residue::one() + Residue(5), Residue(4));
/// assert!((Residue(3) + Residue(4)).is_zero());
/// ```
#[macro_export]
macro_rules! ring {
    ([$($generics:tt)*] $scalar:ty) => {
        $crate::by_value!([$($generics)*] $scalar);

        impl<$($generics)*> ::core::ops::Neg for $scalar {
            type Output = Self;

            fn neg(self) -> Self {
                <Self as $crate::num_traits::Zero>::zero() - &self
            }
        }

        impl<$($generics)*> $crate::num_traits::Zero for $scalar {
            fn zero() -> Self {
                $crate::scalar::Ring::from_integer(0)
            }

            fn is_zero(&self) -> bool {
                *self == <Self as $crate::num_traits::Zero>::zero()
            }
        }

        impl<$($generics)*> $crate::num_traits::One for $scalar {
            fn one() -> Self {
                $crate::scalar::Ring::from_integer(1)
            }
        }
    };
    ($scalar:ty) => {
        $crate::ring!([] $scalar);
    };
}

mod double_double;
mod fixed;
mod float;
mod interval;
pub mod laws;
mod plain;
mod polynomial;
mod ratio;
mod rational;
pub(crate) mod turn;

/// What is known of a number type `T`, as the second parameter of [`Plain`].
///
/// | scalar | for | exactness |
/// |---|---|---|
/// | `Plain<T>`, which is `Plain<T, promise::Unknown>` | any type with `+ − × ÷` | [`Unknown`](Exactness::Unknown) |
/// | `Plain<T, promise::Rounded>` | binary floats that are [`CorrectlyRounded`], such as `half::bf16` | [`Rounded`](Exactness::Rounded) |
/// | `Plain<T, promise::Exact>` | rationals of any size, such as those of dashu | [`Exact`](Exactness::Exact) |
pub mod promise {
    pub use super::plain::{Exact, Rounded, Unknown};
}

pub use exact_surd::rational::{ByValue, reduced};
pub use exact_surd::{CorrectlyRounded, DoubleDouble, Surd, SurdSum, parse};
pub use fixed::{FixedInteger, FixedRational};
pub use interval::Interval;
pub use plain::Plain;
pub use polynomial::{Polynomial, Symbol};
#[doc(hidden)]
pub use ratio::quotient;

use turn::{tripled_apart, tripled_half_turn};

pub(crate) use exact_surd::float_between;
pub(crate) use exact_surd::rational::{common_denominator, common_multiple, product, sum_of};
pub(crate) use numerators::Numerators;

use crate::each::Each;
use core::fmt::Debug;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

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
    /// Nothing is known.
    Unknown,
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
/// * [`from_integer`](Self::from_integer) respects `+`, `*` and 1.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a ring of cannonpile",
    note = "for exact rationals of machine integers use `FixedRational<i64>`; a scalar of your own implements `Ring` and `Algebra`",
    note = "implement `Add<&Self>`, `Sub<&Self>` and `Mul<&Self>`; `cannonpile::ring!` adds the other operators"
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
    fn from_integer(n: i128) -> Self;

    /// Returns whether two values are equal. Rationals override it, because their `==` calls itself once for each
    /// common term of two continued fractions.
    #[doc(hidden)]
    fn equals(&self, other: &Self) -> bool {
        self == other
    }

    /// Returns a key that compares the value by [`equals`](Self::equals).
    #[doc(hidden)]
    fn comparison_key(&self) -> ComparisonKey<'_, Self> {
        ComparisonKey(self)
    }
}

/// A value that is compared by [`Ring::equals`].
#[doc(hidden)]
#[derive(Debug)]
pub struct ComparisonKey<'a, T>(&'a T);

impl<T: Ring> PartialEq for ComparisonKey<'_, T> {
    fn eq(&self, other: &Self) -> bool {
        self.0.equals(other.0)
    }
}

/// The integers, of any size. They are numerators over a denominator that is known in advance.
impl Ring for BigInt {
    fn from_integer(n: i128) -> Self {
        n.into()
    }
}

/// A commutative algebra over ℚ. The formulas of this crate are evaluated in it.
///
/// # Laws
/// * The laws of a [`Ring`] hold.
/// * [`from_rational`](Self::from_rational) respects `+`, `*` and 1, and agrees with [`from_integer`](Ring::from_integer).
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
    note = "for exact rationals of machine integers use `FixedRational<i64>`; a scalar of your own implements `Ring` and `Algebra`"
)]
pub trait Algebra: Ring {
    /// The relation between results and true values.
    const EXACTNESS: Exactness;

    /// The name of the scalar type in messages, such as `f64`.
    const NAME: &'static str;

    /// The type of numerators over a common denominator: `Self`, for a scalar of your own. The library computes with
    /// numerators and divides once at the end, by [`checked_div`](Self::checked_div). Only rationals have other ones.
    type Numerator: Numerators<Self>;

    /// Returns the rational `r` as a value of this type: exact, or correctly rounded.
    fn from_rational(r: &BigRational) -> Self;

    /// Returns `self / n`.
    #[must_use]
    fn div_int(self, n: NonZeroI64) -> Self;

    /// Returns `self / divisor`, or `None` if the divisor is zero or undefined, or does not divide `self` in this type.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Algebra;
    ///
    /// assert_eq!(3.0.checked_div(&4.0), Some(0.75));
    /// assert_eq!(3.0.checked_div(&0.0), None);
    /// ```
    fn checked_div(&self, divisor: &Self) -> Option<Self>;

    /// Returns whether the value represents a number: false for a fault, an infinity or not-a-number.
    ///
    /// The library checks this once, before it returns a value, and returns [`Error::Overflow`](crate::Error::Overflow)
    /// if it is false. Operations may return undefined values freely.
    fn is_defined(&self) -> bool;

    /// Returns (2/3)(a + b + c)(1, 1, 1) − (a, b, c), the forces below a sign change
    /// ([`formula::half_turn`](crate::formula::half_turn)), with a single division.
    ///
    /// Bounds override it with an expression in which each operand occurs once, because they widen less.
    fn half_turn(g: &[Self; 3]) -> [Self; 3] {
        let twice_mean = turn::twice_sum(g).div_int(THREE);
        g.each_ref().each(|x| twice_mean.clone() - x)
    }
}

/// An [`Algebra`] with division by every nonzero value.
///
/// # Laws
/// `a.checked_div(b)` is `None` if and only if `b` is zero or undefined; otherwise
/// `a.checked_div(b) * b = a`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a scalar of cannonpile with division",
    note = "a scalar of your own implements `Field` if its `checked_div` is `None` only for a divisor of zero"
)]
pub trait Field: Algebra {}

mod numerators {
    //! Numerators over a common denominator. The library computes with them, and divides once at the end.
    //!
    //! The trait is sealed: other crates cannot name it. Every scalar is its own numerator, except rationals, whose
    //! numerators are integers. This avoids reductions of intermediate fractions.

    use exact_surd::rational::{common_denominator, quotient};
    use num_bigint::BigInt;
    use num_rational::BigRational;
    use num_traits::Zero;

    use super::{Algebra, Ring, tripled_half_turn};

    /// The numerators of a scalar type `T`.
    #[diagnostic::on_unimplemented(
        message = "`{Self}` cannot be the numerators of `{T}`",
        note = "write `type Numerator = Self;`"
    )]
    pub trait Numerators<T>: Ring {
        /// Whether these are integers, so that a sign change multiplies the denominator by 3.
        const ARE_INTEGERS: bool;

        /// Returns the numerators of `values` over a common denominator, and this denominator. For rationals it is the least
        /// one, otherwise it is 1.
        fn of<const N: usize>(values: &[BigRational; N]) -> ([Self; N], Self);

        /// Returns the numerators of integers over a common denominator. Rationals keep this denominator, and other scalars
        /// divide by it.
        fn of_integers(integers: [BigInt; 3], denominator: impl FnOnce() -> BigInt) -> [Self; 3];

        /// Returns the values as numerators over 1. Rationals, whose numerators need a common denominator, are returned as
        /// they are, in `Err`.
        fn of_scalars<const N: usize>(values: [T; N]) -> Result<[Self; N], [BigRational; N]>;

        /// Returns G g, or 3G g for integers: see [`half_turn`](crate::formula::half_turn).
        fn half_turn(g: &[Self; 3]) -> [Self; 3];

        /// Returns `self / d`, reduced or correctly rounded. Returns `None` if `d` is zero or does not divide `self` in `T`.
        fn over(self, d: &Self) -> Option<T>;
    }

    impl<T: Algebra<Numerator = T>> Numerators<T> for T {
        const ARE_INTEGERS: bool = false;

        fn of<const N: usize>(values: &[BigRational; N]) -> ([T; N], T) {
            (values.each_ref().map(T::from_rational), T::one())
        }

        fn of_integers(integers: [BigInt; 3], denominator: impl FnOnce() -> BigInt) -> [T; 3] {
            let denominator = denominator();
            integers.map(|n| T::from_rational(&quotient(n, &denominator)))
        }

        fn of_scalars<const N: usize>(values: [T; N]) -> Result<[T; N], [BigRational; N]> {
            Ok(values)
        }

        #[inline]
        fn half_turn(g: &[T; 3]) -> [T; 3] {
            T::half_turn(g)
        }

        #[inline]
        fn over(self, d: &T) -> Option<T> {
            self.checked_div(d)
        }
    }

    impl Numerators<BigRational> for BigInt {
        const ARE_INTEGERS: bool = true;

        fn of<const N: usize>(values: &[BigRational; N]) -> ([BigInt; N], BigInt) {
            let common = common_denominator(values);
            let numerators = values.each_ref().map(|r| r.numer() * (&common / r.denom()));
            (numerators, common)
        }

        fn of_integers(integers: [BigInt; 3], _: impl FnOnce() -> BigInt) -> [BigInt; 3] {
            integers
        }

        fn of_scalars<const N: usize>(
            values: [BigRational; N],
        ) -> Result<[BigInt; N], [BigRational; N]> {
            Err(values)
        }

        fn half_turn(g: &[BigInt; 3]) -> [BigInt; 3] {
            tripled_half_turn(g)
        }

        fn over(self, d: &BigInt) -> Option<BigRational> {
            (!d.is_zero()).then(|| quotient(self, d))
        }
    }
}
