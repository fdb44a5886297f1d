//! Tests of the algebraic laws, for any scalar type.
//!
//! Each function takes operands and returns the first law that they break. The function demands as much as
//! [`Algebra::EXACTNESS`] promises:
//!
//! * An exact scalar must satisfy each law with equality.
//! * A fixed-width scalar must satisfy it with equality or return a fault.
//! * Bounds must contain the true result.
//! * A rounded scalar must satisfy the laws that survive rounding, and must return the true result up to its precision.
//! * A scalar of unknown exactness must satisfy the laws that survive rounding.
//!
//! The scalars of this crate pass with fixed, random and fuzzed operands. Use the same functions to test your own.
//!
//! # Examples
//! ```
//! use cannonpile::scalar::laws;
//! use num_rational::BigRational;
//!
//! laws::algebra(&0.1, &0.2, &0.3)?;
//! let third = BigRational::new(1.into(), 3.into());
//! // A float is a rational, so it is known exactly.
//! let known = |x: &f32| BigRational::from_float(*x).map(|x| [x.clone(), x]);
//! laws::embedding(&third, &third, known)?;
//! # Ok::<(), laws::BrokenLaw>(())
//! ```

use alloc::format;
use alloc::string::String;
use core::fmt;
use core::num::NonZeroI64;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{Algebra, ByValue, Exactness, Field, Numerators};

/// A violated law, with the operands that violate it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BrokenLaw {
    /// The law, as a formula.
    pub law: &'static str,
    /// The name of the scalar type.
    pub scalar: &'static str,
    /// The operands and the results.
    pub witness: String,
}

fn broken<T: Algebra>(law: &'static str, witness: String) -> Result<(), BrokenLaw> {
    Err(BrokenLaw {
        law,
        scalar: T::NAME,
        witness,
    })
}

impl fmt::Display for BrokenLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} breaks {}: {}", self.scalar, self.law, self.witness)
    }
}

impl core::error::Error for BrokenLaw {}

/// Checks the laws of a commutative algebra over ℚ.
///
/// Every scalar must satisfy commutativity, neutral elements and negation. Associativity, distributivity and division
/// by integers are not required of rounded scalars.
///
/// # Errors
/// The first law that a, b and c break.
///
/// # Examples
/// ```
/// use cannonpile::scalar::{laws, Polynomial, Symbol};
///
/// let [a, b, c] = ["a", "b", "c"].map(|name| Polynomial::from(Symbol(name)));
/// laws::algebra(&a, &b, &c)?;
/// // Floats need not be associative.
/// assert_ne!((1e16 - 1e16) + 1.0, 1e16 + (1.0 - 1e16));
/// laws::algebra(&1e16, &-1e16, &1.0)?;
/// # Ok::<(), laws::BrokenLaw>(())
/// ```
pub fn algebra<T: Algebra>(a: &T, b: &T, c: &T) -> Result<(), BrokenLaw> {
    let law = |law: &'static str, left: T, right: T| {
        // A fault or an overflow on either side is allowed, unless the scalar is exact.
        let excused =
            T::EXACTNESS != Exactness::Exact && !(left.is_defined() && right.is_defined());
        if may_equal(&left, &right) || excused {
            return Ok(());
        }
        let witness = format!("a = {a:?}, b = {b:?}, c = {c:?}: {left:?} is not {right:?}");
        broken::<T>(law, witness)
    };
    let (a_, b_) = (|| a.clone(), || b.clone());
    law("a + b = b + a", a_() + b, b_() + a)?;
    law("a b = b a", a_() * b, b_() * a)?;
    law("a + 0 = a", a_() + &T::zero(), a_())?;
    law("1 a = a", T::one() * a, a_())?;
    law("0 a = 0", T::zero() * a, T::zero())?;
    law("a - a = 0", a_() - a, T::zero())?;
    law("a + (-b) = a - b", a_() + &-b_(), a_() - b)?;
    law("-(-a) = a", -(-a_()), a_())?;
    if let Exactness::Rounded { .. } | Exactness::Unknown = T::EXACTNESS {
        return Ok(());
    }
    law(
        "(a + b) + c = a + (b + c)",
        a_() + b + c,
        a_() + &(b_() + c),
    )?;
    law("(a b) c = a (b c)", a_() * b * c, a_() * &(b_() * c))?;
    law(
        "a (b + c) = a b + a c",
        a_() * &(b_() + c),
        a_() * b + &(a_() * c),
    )?;
    for n in [1, -1, 2, 3, -7, i64::MAX, i64::MIN] {
        let Some(n) = NonZeroI64::new(n) else {
            continue;
        };
        let back = a_().div_int(n) * &T::from_integer(n.get().into());
        law("(a / n) n = a", back, a_())?;
    }
    Ok(())
}

/// Checks that operations agree with those on rationals. It converts x and y to the scalar type and compares the result
/// of each operation with the exact one on the stored values.
///
/// `bounds` returns the tightest rational bounds of a value, [lower, upper], or `None` for a value without finite bounds.
/// For a scalar that is not an enclosure, both are the stored value.
///
/// A rounded scalar is tested where 2^−e ≤ |result| ≤ 2^e, away from overflow and underflow. The exponent e is the
/// greatest one up to 64 for which 2^e and 2^−(e+p) are representable, where p is the precision in bits, but at least
/// 8. For half precision e is 13.
///
/// # Errors
/// The first law that x and y break.
///
/// # Examples
/// ```
/// use cannonpile::scalar::{laws, FixedRational};
/// use num_rational::BigRational;
///
/// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
/// let known = |x: &FixedRational<i8>| x.to_rational().map(|x| [x.clone(), x]);
/// laws::embedding(&ratio(1, 3), &ratio(-2, 7), known)?;
/// // The sum does not fit in eight bits: a fault, which breaks no law.
/// laws::embedding(&ratio(1, 100), &ratio(1, 101), known)?;
/// # Ok::<(), laws::BrokenLaw>(())
/// ```
pub fn embedding<T: Field>(
    x: &BigRational,
    y: &BigRational,
    bounds: impl Fn(&T) -> Option<[BigRational; 2]>,
) -> Result<(), BrokenLaw> {
    let zero = BigRational::zero();
    let may_be_zero = |b: &T| {
        T::EXACTNESS == Exactness::Enclosure
            && bounds(b).is_none_or(|[lower, upper]| lower <= zero && zero <= upper)
    };
    let check_value = |law, got: &T, want: &BigRational| check_value(law, got, want, &bounds);
    let (a, b) = (T::from_rational(x), T::from_rational(y));
    check_value("the image of x is x", &a, x)?;
    // Bounds represent the numbers that they were made from. Other scalars represent the stored value.
    let stored = |a: &T, x: &BigRational| match T::EXACTNESS {
        Exactness::Enclosure => Some(x.clone()),
        _ => point(a, &bounds),
    };
    let (Some(p), Some(q)) = (stored(&a, x), stored(&b, y)) else {
        return Ok(());
    };
    check_value("a + b", &(a.clone() + &b), &(&p + &q))?;
    check_value("a - b", &(a.clone() - &b), &(&p - &q))?;
    check_value("a b", &(a.clone() * &b), &(&p * &q))?;
    match a.checked_div(&b) {
        Some(quotient) if !q.is_zero() => check_value("a / b", &quotient, &(&p / &q))?,
        // Bounds of a value that is not zero may contain zero.
        None if q.is_zero() || may_be_zero(&b) => {}
        _ => {
            let (law, witness) = ("a / b is undefined just for b = 0", format!("b = {b:?}"));
            return broken::<T>(law, witness);
        }
    }
    for n in [
        3_i64,
        -10,
        1_099_511_693_313,
        1_152_921_504_606_847_105,
        i64::MAX,
    ] {
        let Some(n) = NonZeroI64::new(n) else {
            continue;
        };
        let quotient = &p / BigInt::from(n.get());
        check_value("a / n", &a.clone().div_int(n), &quotient)?;
    }
    Ok(())
}

/// Checks that n and n/1 convert to the same value.
///
/// # Errors
/// The law, if n breaks it.
///
/// # Examples
/// ```
/// use cannonpile::scalar::laws;
///
/// // This integer is not an `f32`. Both conversions round it to the same value.
/// laws::integers::<f32>((1 << 24) + 1)?;
/// # Ok::<(), laws::BrokenLaw>(())
/// ```
pub fn integers<T: Algebra>(n: i128) -> Result<(), BrokenLaw> {
    let (direct, by_rational) = (
        T::from_integer(n),
        T::from_rational(&BigRational::from_integer(n.into())),
    );
    if direct == by_rational || !(direct.is_defined() || by_rational.is_defined()) {
        return Ok(());
    }
    let witness = format!("{n}: {direct:?} is not {by_rational:?}");
    broken::<T>("n and n/1 have one image", witness)
}

/// Checks that each numerator over the common denominator gives the original value in canonical form.
///
/// # Errors
/// The law, if x and y break it.
///
/// # Examples
/// ```
/// use cannonpile::scalar::laws;
/// use num_rational::BigRational;
///
/// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
/// // The numerators are 3/6 and 2/6, and are reduced at the end.
/// laws::numerators::<BigRational>(&ratio(1, 2), &ratio(1, 3))?;
/// # Ok::<(), laws::BrokenLaw>(())
/// ```
pub fn numerators<T: Algebra>(x: &BigRational, y: &BigRational) -> Result<(), BrokenLaw> {
    let values = [x.clone(), y.clone()];
    let (numerators, denominator) = T::Numerator::of(&values);
    for (numerator, value) in numerators.into_iter().zip(&values) {
        let (back, image) = (numerator.over(&denominator), T::from_rational(value));
        // The text distinguishes unreduced fractions, and equality may not. Enclosures may widen, and floating-point
        // zeros are signed, so these scalars are compared by value.
        let same = back.as_ref().is_some_and(|back| match T::EXACTNESS {
            Exactness::Exact | Exactness::ExactOrFault => {
                format!("{back:?}") == format!("{image:?}")
            }
            _ => may_equal(back, &image),
        });
        if same || !image.is_defined() {
            continue;
        }
        let (law, witness) = (
            "n / d is the value",
            format!("{value}: {back:?} is not {image:?}"),
        );
        return broken::<T>(law, witness);
    }
    Ok(())
}

/// Returns whether two values may represent the same number: bounds overlap, and other values are equal.
fn may_equal<T: Algebra>(a: &T, b: &T) -> bool {
    let overlap = || T::one().checked_div(&(a.clone() - b)).is_none();
    a.equals(b) || T::EXACTNESS == Exactness::Enclosure && overlap()
}

/// Returns the rational that the scalar represents, if its bounds are equal.
fn point<T>(a: &T, bounds: &impl Fn(&T) -> Option<[BigRational; 2]>) -> Option<BigRational> {
    let [lower, upper] = bounds(a)?;
    (ByValue(&lower) == ByValue(&upper)).then_some(lower)
}

/// Checks that `got` approximates `want` as well as the scalar promises.
fn check_value<T: Algebra>(
    law: &'static str,
    got: &T,
    want: &BigRational,
    bounds: &impl Fn(&T) -> Option<[BigRational; 2]>,
) -> Result<(), BrokenLaw> {
    let contains = |[lower, upper]: [BigRational; 2]| {
        ByValue(&lower) <= ByValue(want) && ByValue(want) <= ByValue(&upper)
    };
    let holds = match (T::EXACTNESS, point(got, bounds)) {
        (Exactness::Unknown, _) => true,
        (Exactness::Exact, value) => value.is_some_and(|value| ByValue(&value) == ByValue(want)),
        (Exactness::ExactOrFault, None) => !got.is_defined(),
        (Exactness::ExactOrFault, Some(value)) => ByValue(&value) == ByValue(want),
        (Exactness::Enclosure, _) => {
            // An enclosure without finite bounds contains everything.
            got.is_defined() && bounds(got).is_none_or(contains)
        }
        (Exactness::Rounded { bits }, None) => !in_range(want, bits, bounds),
        (Exactness::Rounded { bits }, Some(value)) => {
            (value - want).abs() <= want.abs() / (BigInt::from(1) << bits)
                || !in_range(want, bits, bounds)
        }
    };
    if holds {
        return Ok(());
    }
    let witness = format!("{got:?} in place of {want}");
    broken::<T>(law, witness)
}

/// Returns whether a rational is zero, or has a magnitude that a rounded scalar with `bits` bits represents with full
/// precision.
fn in_range<T: Algebra>(
    want: &BigRational,
    bits: u32,
    bounds: &impl Fn(&T) -> Option<[BigRational; 2]>,
) -> bool {
    let power = |e: u32| BigRational::from_integer(BigInt::from(1) << e);
    let holds =
        |r: &BigRational| point(&T::from_rational(r), bounds).is_some_and(|value| !value.is_zero());
    // If 2^−(e+bits) does not underflow, then a value of magnitude 2^−e keeps all its digits.
    let in_reach = |e: &u32| holds(&power(*e)) && holds(&power(e + bits).recip());
    let least = 8;
    // Without this minimum, a scalar that represents no number would break no law.
    let limit = power((least..=64).rev().find(in_reach).unwrap_or(least));
    want.is_zero() || (want.abs() <= limit && want.abs() >= limit.recip())
}
