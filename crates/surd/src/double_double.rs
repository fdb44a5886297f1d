//! Double-double: an unevaluated sum of two floats, twice the precision of one.
//!
//! Algorithms and their bounds: M. Joldes, J.-M. Muller and V. Popescu, "Tight and rigorous error bounds for
//! basic building blocks of double-word arithmetic", ACM Trans. Math. Softw. 44 (2017). With u = 2^−53 the
//! relative error of a sum is at most 3u² + 13u³, of a product 7u², of a quotient 15u² + 56u³.

use core::fmt;
use core::ops::{Add, Mul, Neg, Sub};

use alloc::format;

use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::NearestFloat;
use crate::error_free::{fast_two_sum, is_ordinary, scale, significand, two_product, two_sum};
use crate::layout::padded;

/// A number high + low with |low| at most half a unit in the last place of high: about 106 bits.
///
/// Each operation errs by at most 2^−100 of its result, as long as that is between 2^−900 and 2^1023. Below,
/// digits are lost gradually. A result beyond the floats, or one of operands that are not finite, is what
/// `f64` gives for the high parts: an infinity or not-a-number, with low = 0.
///
/// # Examples
/// ```
/// use exact_surd::DoubleDouble;
///
/// let third = DoubleDouble::new(1.0).checked_div(&DoubleDouble::new(3.0)).unwrap();
/// let rest = DoubleDouble::new(1.0) - (third + third + third);
/// assert!(rest.high().abs() < 1e-31);
/// assert_ne!(third.low(), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// Returns a float as a double-double.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    ///
    /// let x = DoubleDouble::new(0.1);
    /// assert_eq!((x.high(), x.low()), (0.1, 0.0));
    /// ```
    #[must_use]
    pub const fn new(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }

    /// Returns high + low, if they are the parts of a double-double: low at most half a unit in the last place of high.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    ///
    /// assert!(DoubleDouble::from_parts(1.0, 1e-17).is_some());
    /// assert!(DoubleDouble::from_parts(1.0, 1e-15).is_none());
    /// ```
    #[must_use]
    pub fn from_parts(high: f64, low: f64) -> Option<Self> {
        let apart = if high.is_finite() {
            fast_two_sum(high, low) == (high, low)
        } else {
            low == 0.0
        };
        apart.then_some(Self { high, low })
    }

    /// Returns the double-double nearest to a rational, to 2^−106 of it; not-a-number beyond the floats.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    /// use num_rational::BigRational;
    ///
    /// let tenth = DoubleDouble::from_rational(&BigRational::new(1.into(), 10.into()));
    /// assert_eq!((tenth.high(), tenth.low()), (0.1, -5.551115123125783e-18));
    /// ```
    #[must_use]
    pub fn from_rational(r: &BigRational) -> Self {
        let parts = || {
            let high = f64::nearest_to_rational(r)?;
            let rest = r - BigRational::from_float(high)?;
            Some((high, f64::nearest_to_rational(&rest)?))
        };
        match parts() {
            Some((high, low)) => Self::finite(fast_two_sum(high, low), high),
            // Beyond the floats.
            None => Self::new(f64::NAN),
        }
    }

    /// Returns the exact value, or `None` if the number is not finite.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    /// use num_rational::BigRational;
    ///
    /// let half = BigRational::new(1.into(), 2.into());
    /// assert_eq!(DoubleDouble::new(0.5).to_rational(), Some(half));
    /// assert_eq!(DoubleDouble::new(f64::NAN).to_rational(), None);
    /// ```
    #[must_use]
    pub fn to_rational(&self) -> Option<BigRational> {
        Some(BigRational::from_float(self.high)? + BigRational::from_float(self.low)?)
    }

    /// Returns whether the number is neither an infinity nor not-a-number.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    ///
    /// assert!(DoubleDouble::new(1.0).is_finite());
    /// assert!(!DoubleDouble::new(f64::INFINITY).is_finite());
    /// ```
    #[must_use]
    pub const fn is_finite(&self) -> bool {
        self.high.is_finite()
    }

    /// Returns `self / divisor`, or `None` if the divisor is zero or not finite.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    ///
    /// let [three, four] = [3.0, 4.0].map(DoubleDouble::new);
    /// assert_eq!(three.checked_div(&four), Some(DoubleDouble::new(0.75)));
    /// assert_eq!(three.checked_div(&DoubleDouble::new(0.0)), None);
    /// ```
    #[must_use]
    pub fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (divisor.is_finite() && !divisor.is_zero()).then(|| self.over(divisor))
    }

    /// Returns the nearest float.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    /// use num_rational::BigRational;
    ///
    /// let third = DoubleDouble::from_rational(&BigRational::new(1.into(), 3.into()));
    /// assert_eq!(third.high(), 1.0 / 3.0);
    /// ```
    #[must_use]
    pub const fn high(&self) -> f64 {
        self.high
    }

    /// Returns the rest: the number less its nearest float.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    ///
    /// // 2⁵³ + 1 lies between two floats.
    /// let n = DoubleDouble::from_rational(&num_rational::BigRational::from_integer(((1_i64 << 53) + 1).into()));
    /// assert_eq!((n.high(), n.low()), (9007199254740992.0, 1.0));
    /// ```
    #[must_use]
    pub const fn low(&self) -> f64 {
        self.low
    }

    /// Returns the parts of a result, or the float if that is not finite.
    fn finite((high, low): (f64, f64), float: f64) -> Self {
        if high.is_finite() && low.is_finite() {
            Self { high, low }
        } else {
            Self::new(float)
        }
    }

    /// Returns the number times 2^`e`.
    fn scaled(self, e: i32) -> Self {
        if e == 0 {
            return self;
        }
        let float = scale(self.high, e);
        // Among the subnormals a low part may be rounded up to a tie.
        Self::finite(fast_two_sum(float, scale(self.low, e)), float)
    }

    /// Returns the number with its high part between 1 and 2, and the power of two taken out: no product of two such
    /// numbers overflows or loses its error. One of ordinary size is not changed.
    fn normalised(self) -> (Self, i32) {
        if is_ordinary(self.high) {
            return (self, 0);
        }
        let (_, e) = significand(self.high);
        (self.scaled(-e), e)
    }

    /// Returns the sum of two floats, of which the first is the greater, or zero.
    pub(crate) fn from_sum(greater: f64, lesser: f64) -> Self {
        let (high, low) = fast_two_sum(greater, lesser);
        Self { high, low }
    }

    /// Returns the product, by `DWTimesDW1`; both are of ordinary size.
    pub(crate) fn ordinary_product(self, rhs: &Self) -> Self {
        let (c, c1) = two_product(self.high, rhs.high);
        let c2 = self.high * rhs.low + self.low * rhs.high;
        Self::from_sum(c, c1 + c2)
    }

    /// Returns the quotient, by `DWDivDW2`; both are of ordinary size.
    pub(crate) fn ordinary_quotient(self, divisor: &Self) -> Self {
        let t = self.high / divisor.high;
        let (r, r1) = divisor.times_float(t);
        let rest = (self.high - r) + (self.low - r1);
        Self::from_sum(t, rest / divisor.high)
    }

    /// Returns the quotient; the divisor is finite and not zero.
    #[doc(hidden)]
    #[must_use]
    pub fn over(self, divisor: &Self) -> Self {
        let ((x, e), (y, f)) = (self.normalised(), divisor.normalised());
        let Self { high, low } = x.ordinary_quotient(&y);
        Self::finite((high, low), x.high / y.high).scaled(e - f)
    }

    /// Returns the product with a float.
    fn times_float(self, y: f64) -> (f64, f64) {
        let (c, c1) = two_product(self.high, y);
        let c2 = self.low * y;
        let (t, t1) = fast_two_sum(c, c2);
        fast_two_sum(t, t1 + c1)
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    /// Returns the sum, by `AccurateDWPlusDW`.
    fn add(self, rhs: Self) -> Self {
        let (s, s1) = two_sum(self.high, rhs.high);
        let (t, t1) = two_sum(self.low, rhs.low);
        let (v, v1) = fast_two_sum(s, s1 + t);
        Self::finite(fast_two_sum(v, t1 + v1), self.high + rhs.high)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, rhs: Self) -> Self {
        let negated = -rhs;
        self + negated
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        let ((x, e), (y, f)) = (self.normalised(), rhs.normalised());
        let Self { high, low } = x.ordinary_product(&y);
        Self::finite((high, low), x.high * y.high).scaled(e + f)
    }
}

impl Add<&Self> for DoubleDouble {
    type Output = Self;

    fn add(self, rhs: &Self) -> Self {
        self + *rhs
    }
}

impl Sub<&Self> for DoubleDouble {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        self - *rhs
    }
}

impl Mul<&Self> for DoubleDouble {
    type Output = Self;

    fn mul(self, rhs: &Self) -> Self {
        self * *rhs
    }
}

impl PartialOrd for DoubleDouble {
    /// Compares the exact values; not-a-number is neither less nor greater than anything.
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        let high = self.high.partial_cmp(&other.high)?;
        Some(high.then(self.low.partial_cmp(&other.low)?))
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self::new(value)
    }
}

/// Returns the nearest float.
impl From<DoubleDouble> for f64 {
    fn from(value: DoubleDouble) -> Self {
        value.high
    }
}

impl fmt::Display for DoubleDouble {
    /// Writes the two parts as an exact sum, `0.1 - 5.551115123125783e-18`; one that is a float alone.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.low == 0.0 {
            return fmt::Display::fmt(&self.high, f);
        }
        let sign = if self.low < 0.0 { '-' } else { '+' };
        let high = if f.sign_plus() {
            format!("{:+?}", self.high)
        } else {
            format!("{:?}", self.high)
        };
        padded(f, format_args!("{high} {sign} {:?}", self.low.abs()))
    }
}

impl Zero for DoubleDouble {
    fn zero() -> Self {
        Self::new(0.0)
    }

    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
}

impl One for DoubleDouble {
    fn one() -> Self {
        Self::new(1.0)
    }
}
