//! Rationals of fixed width with checked arithmetic.
//!
//! `Ratio<i64>` wraps silently in release builds. [`FixedRational`] contains a `Ratio` and uses checked operations
//! only. The first result that does not fit becomes a *fault*, and every operation on a fault gives a fault.

use alloc::format;
use core::cmp::Ordering;
use core::fmt;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::{BigRational, Ratio};
use num_traits::{Bounded, CheckedAdd, CheckedDiv, CheckedMul, CheckedSub, One, Signed, Zero};

use super::{Algebra, CorrectlyRounded, Exactness, Field, Ring};

mod sealed {
    pub trait Sealed {}
}

/// A signed machine integer that can be the base of a [`FixedRational`]. This trait is sealed.
pub trait FixedInteger:
    sealed::Sealed
    + Copy
    + fmt::Debug
    + fmt::Display
    + Integer
    + Signed
    + Bounded
    + CheckedAdd
    + CheckedSub
    + CheckedMul
    + TryFrom<i128>
    + TryFrom<BigInt>
    + Into<BigInt>
    + Send
    + Sync
{
    /// The name of the rational over this integer.
    const RATIONAL_NAME: &'static str;
}

macro_rules! fixed_integer {
    ($($int:ident)*) => {$(
        impl sealed::Sealed for $int {}
        impl FixedInteger for $int {
            const RATIONAL_NAME: &'static str = concat!("FixedRational<", stringify!($int), ">");
        }
    )*};
}

fixed_integer!(i8 i16 i32 i64 i128);

/// A rational n/d in lowest terms with |n|, d ≤ `I::MAX`, or a fault.
///
/// `I::MIN` is excluded from the range, so negation never overflows. If a result or an intermediate product leaves the
/// range, the result is a fault, never a wrong number. Every operation on a fault gives a fault. A fault is unequal to
/// every value, including itself.
///
/// # Examples
/// ```
/// use cannonpile::scalar::{Algebra, FixedRational, Ring};
/// use num_traits::One;
///
/// let third = FixedRational::<i64>::one().div_int(3.try_into().unwrap());
/// assert_eq!(third.parts(), Some((1, 3)));
///
/// let huge = FixedRational::<i64>::from_integer(i128::from(i64::MAX));
/// let fault = huge + &FixedRational::one();
/// assert_eq!(fault.parts(), None);
/// assert_ne!(fault, fault);
/// ```
#[derive(Clone, Copy)]
pub struct FixedRational<I: FixedInteger>(Option<Ratio<I>>);

impl<I: FixedInteger> FixedRational<I> {
    /// The result of an operation that did not fit.
    pub const FAULT: Self = Self(None);

    /// Returns the rational `numer / denom`, or a [fault](Self::FAULT) if it has no value in this type. It never
    /// panics: `new(1, 0)` is a fault.
    ///
    /// The result is a fault for a denominator of zero, and for `I::MIN` as either part. [`parts`](Self::parts) returns
    /// `None` for a fault.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::FixedRational;
    ///
    /// assert_eq!(FixedRational::new(4, -6).parts(), Some((-2, 3)));
    /// assert_eq!(FixedRational::new(1, 0).parts(), None);
    /// assert_eq!(FixedRational::new(i64::MIN, i64::MIN).parts(), None);
    /// ```
    #[must_use]
    pub fn new(numer: I, denom: I) -> Self {
        if denom.is_zero() || numer == I::min_value() || denom == I::min_value() {
            return Self::FAULT;
        }
        Self(Some(Ratio::new(numer, denom)))
    }

    /// Returns the numerator and the positive denominator in lowest terms, or `None` for a fault.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::FixedRational;
    ///
    /// assert_eq!(FixedRational::new(6, -4).parts(), Some((-3, 2)));
    /// assert_eq!(FixedRational::<i64>::FAULT.parts(), None);
    /// ```
    #[must_use]
    pub fn parts(&self) -> Option<(I, I)> {
        self.0.as_ref().map(|r| (*r.numer(), *r.denom()))
    }

    /// Returns the value as a `BigRational`, or `None` for a fault.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::FixedRational;
    ///
    /// assert_eq!(FixedRational::new(7i32, 3).to_rational().unwrap().to_string(), "7/3");
    /// ```
    #[must_use]
    pub fn to_rational(&self) -> Option<BigRational> {
        // Already in lowest terms, with a positive denominator.
        self.parts()
            .map(|(n, d)| BigRational::new_raw(n.into(), d.into()))
    }

    /// Returns the correctly rounded `f64`, or not-a-number for a fault.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::FixedRational;
    ///
    /// assert_eq!(FixedRational::new(1_i64, 3).to_f64(), 1.0 / 3.0);
    /// assert!(FixedRational::<i64>::FAULT.to_f64().is_nan());
    /// ```
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let nearest = self
            .to_rational()
            .as_ref()
            .and_then(f64::nearest_to_rational);
        // Every number of 128 bits is within the range of floats, and a fault is not a number.
        nearest.unwrap_or(f64::NAN)
    }

    /// Applies a checked operation to two values. A result with `I::MIN` becomes a fault.
    fn checked(self, rhs: &Self, op: impl Fn(&Ratio<I>, &Ratio<I>) -> Option<Ratio<I>>) -> Self {
        let result = match (&self.0, &rhs.0) {
            (Some(a), Some(b)) => op(a, b),
            _ => None,
        };
        Self(result.filter(|r| *r.numer() != I::min_value() && *r.denom() != I::min_value()))
    }
}

impl<I: FixedInteger> PartialEq for FixedRational<I> {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(a), Some(b)) => a == b,
            _ => false,
        }
    }
}

impl<I: FixedInteger> PartialOrd for FixedRational<I> {
    /// Compares exactly. A fault is neither less nor greater than any value.
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.0.as_ref()?.cmp(other.0.as_ref()?))
    }
}

impl<I: FixedInteger> fmt::Debug for FixedRational<I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<I: FixedInteger> fmt::Display for FixedRational<I> {
    /// Prints `7/3`, and `overflow` for a fault.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some((n, d)) = self.parts() else {
            return f.pad("overflow");
        };
        // |n| ≤ MAX, so `abs` cannot overflow.
        let magnitude = if d.is_one() {
            format!("{}", n.abs())
        } else {
            format!("{}/{d}", n.abs())
        };
        f.pad_integral(!n.is_negative(), "", &magnitude)
    }
}

impl<I: FixedInteger> Add<&Self> for FixedRational<I> {
    type Output = Self;

    fn add(self, rhs: &Self) -> Self {
        self.checked(rhs, CheckedAdd::checked_add)
    }
}

impl<I: FixedInteger> Sub<&Self> for FixedRational<I> {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        self.checked(rhs, CheckedSub::checked_sub)
    }
}

impl<I: FixedInteger> Mul<&Self> for FixedRational<I> {
    type Output = Self;

    fn mul(self, rhs: &Self) -> Self {
        self.checked(rhs, CheckedMul::checked_mul)
    }
}

crate::by_value!([I: FixedInteger] FixedRational<I>);

impl<I: FixedInteger> Neg for FixedRational<I> {
    type Output = Self;

    fn neg(self) -> Self {
        // |n| ≤ MAX: negation cannot overflow.
        Self(self.0.map(|r| -r))
    }
}

impl<I: FixedInteger> Zero for FixedRational<I> {
    fn zero() -> Self {
        Self(Some(Ratio::zero()))
    }

    fn is_zero(&self) -> bool {
        self.0.as_ref().is_some_and(Zero::is_zero)
    }
}

impl<I: FixedInteger> One for FixedRational<I> {
    fn one() -> Self {
        Self(Some(Ratio::one()))
    }
}

impl<I: FixedInteger> Ring for FixedRational<I> {
    fn from_integer(n: i128) -> Self {
        I::try_from(n).map_or(Self::FAULT, |n| Self::new(n, I::one()))
    }
}

impl<I: FixedInteger> Algebra for FixedRational<I> {
    const EXACTNESS: Exactness = Exactness::ExactOrFault;
    const NAME: &'static str = I::RATIONAL_NAME;
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        match (
            I::try_from(r.numer().clone()),
            I::try_from(r.denom().clone()),
        ) {
            (Ok(n), Ok(d)) => Self::new(n, d),
            _ => Self::FAULT,
        }
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        let divisor = Self::from_integer(n.get().into());
        self.checked(&divisor, CheckedDiv::checked_div)
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (divisor.is_defined() && !divisor.is_zero())
            .then(|| self.checked(divisor, CheckedDiv::checked_div))
    }

    fn is_defined(&self) -> bool {
        self.0.is_some()
    }
}

impl<I: FixedInteger> Field for FixedRational<I> {}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;

    /// Tests every pair of 8-bit rationals with these denominators against rationals of 64 bits, which cannot overflow
    /// here. Each result is the true one or a fault.
    #[test]
    fn eight_bits_exhaustively() {
        let mut values: Vec<(i8, i8)> = Vec::new();
        for n in i8::MIN..=i8::MAX {
            for d in [1, 2, 5, 64, 127, -127, i8::MIN] {
                values.push(FixedRational::new(n, d).parts().unwrap_or((0, 0)));
            }
        }
        values.sort_unstable();
        values.dedup();
        let wide = |(n, d): (i8, i8)| Ratio::new(i64::from(n), i64::from(d));
        let mut held = 0_u32;
        let mut check = |got: FixedRational<i8>, want: Ratio<i64>| {
            if let Some(parts) = got.parts() {
                assert_eq!(wide(parts), want);
                held += 1;
            }
        };
        for &x in &values {
            for &y in &values {
                // Denominator 0 gives a fault.
                let (a, b) = (FixedRational::new(x.0, x.1), FixedRational::new(y.0, y.1));
                if x.1 == 0 || y.1 == 0 {
                    assert!(!(a + b).is_defined() && !(a * b).is_defined());
                    continue;
                }
                check(a + b, wide(x) + wide(y));
                check(a - b, wide(x) - wide(y));
                check(a * b, wide(x) * wide(y));
                if let Some(quotient) = a.checked_div(&b) {
                    check(quotient, wide(x) / wide(y));
                }
                check(-a, -wide(x));
            }
        }
        assert!(held > 500_000, "only {held} results were in range");
    }

    #[test]
    fn numbers_are_ordered_and_faults_are_not() {
        let ratio = FixedRational::<i8>::new;
        let numbers = [
            ratio(-127, 1),
            ratio(-1, 2),
            ratio(0, 5),
            ratio(126, 127),
            ratio(1, 1),
        ];
        for (n, x) in numbers.iter().enumerate() {
            for (m, y) in numbers.iter().enumerate() {
                assert_eq!(x.partial_cmp(y), Some(n.cmp(&m)));
            }
            assert_eq!(x.partial_cmp(&FixedRational::FAULT), None);
        }
        let fault = FixedRational::<i8>::FAULT;
        assert_eq!(fault.partial_cmp(&fault), None);
        // The comparison must not multiply the parts, which might overflow.
        let [a, b] = [i128::MAX - 1, i128::MAX].map(|n| FixedRational::new(n, i128::MAX - 2));
        assert_eq!(a.partial_cmp(&b), Some(Ordering::Less));
        assert_eq!(b.partial_cmp(&a), Some(Ordering::Greater));
    }

    /// This needs `std`, because without it `Ratio` ignores the width.
    #[cfg(feature = "std")]
    #[test]
    fn width_fill_and_sign_match_big_rationals() {
        for (n, d) in [(22, 7), (-22, 7), (3, 1), (0, 1)] {
            let (short, long) = (FixedRational::new(n, d), ratio_of(n, d));
            for (short, long) in [
                (format!("{short}"), format!("{long}")),
                (format!("{short:>9}"), format!("{long:>9}")),
                (format!("{short:9}"), format!("{long:9}")),
                (format!("{short:*<9}"), format!("{long:*<9}")),
                (format!("{short:^+9}"), format!("{long:^+9}")),
                (format!("{short:07}"), format!("{long:07}")),
                (format!("{short:.1}"), format!("{long:.1}")),
            ] {
                assert_eq!(short, long);
            }
        }
        assert_eq!(format!("{:>10}", FixedRational::<i64>::FAULT), "  overflow");
    }

    fn ratio_of(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    #[test]
    fn floats_are_the_nearest() {
        for (n, d) in [(1, 3), (-2, 3), (0, 1), (i64::MAX, 1), (1, i64::MAX)] {
            let nearest = FixedRational::new(n, d).to_f64();
            assert_eq!(f64::nearest_to_rational(&ratio_of(n, d)), Some(nearest));
        }
        let greatest = FixedRational::new(i128::MAX, 1).to_f64();
        assert_eq!(Some(greatest), Some(2_f64.powi(127)));
    }
}
