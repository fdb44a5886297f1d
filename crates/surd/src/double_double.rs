//! Double-double arithmetic: a number is an unevaluated sum of two floats, with twice the precision of one.
//!
//! The algorithms and error bounds are from M. Joldes, J.-M. Muller and V. Popescu, "Tight and rigorous
//! error bounds for basic building blocks of double-word arithmetic", ACM Trans. Math. Softw. 44 (2017).
//! With u = 2^−53, the relative error is at most 3u² + 13u³ for a sum, 7u² for a product and 15u² + 56u³
//! for a quotient.

use core::fmt;
use core::ops::{Add, Mul, Neg, Sub};

use alloc::format;

use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::error_free::{fast_two_sum, is_ordinary, scale, significand, two_product, two_sum};
use crate::layout::padded;

/// A number high + low of about 106 bits, with |low| at most half a unit in the last place of high.
///
/// The relative error of each operation is at most 2^−100 if the result lies between 2^−900 and 2^1023 in
/// magnitude. Smaller results lose digits gradually. If the result overflows, or an operand is not finite,
/// the result is that of `f64` for the high parts: an infinity or not-a-number, with low = 0.
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
    /// Returns `value` as a double-double, exactly.
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

    /// Returns high + low, or `None` if `high` is not this sum rounded to `f64`. If `high` is not finite, `low` must be
    /// zero.
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

    /// Returns `false` for infinities and not-a-number, `true` otherwise.
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

    /// Returns the high part: the number rounded to `f64`.
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

    /// Returns the low part: the number minus its high part.
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

    /// Returns (high, low) as a double-double, or `float` alone if one part is not finite.
    pub(crate) fn finite((high, low): (f64, f64), float: f64) -> Self {
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
        // In the subnormal range scaling can round the low part up to half a unit of the high part, so the sum is
        // formed again.
        Self::finite(fast_two_sum(float, scale(self.low, e)), float)
    }

    /// Returns (m, e) with the number equal to m·2^e and 1 ≤ |high part of m| < 2.
    ///
    /// Products of two such m neither overflow nor lose their rounding error. A number of moderate size
    /// (see [`is_ordinary`]) is returned unchanged, with e = 0.
    fn normalised(self) -> (Self, i32) {
        if is_ordinary(self.high) {
            return (self, 0);
        }
        let (_, e) = significand(self.high);
        (self.scaled(-e), e)
    }

    /// Returns the sum of two floats with |`greater`| ≥ |`lesser`| or `greater` = 0.
    pub(crate) fn from_sum(greater: f64, lesser: f64) -> Self {
        let (high, low) = fast_two_sum(greater, lesser);
        Self { high, low }
    }

    /// Returns the product, by the algorithm `DWTimesDW1`. Both factors must be of moderate size
    /// ([`is_ordinary`]).
    pub(crate) fn ordinary_product(self, rhs: &Self) -> Self {
        let (c, c1) = two_product(self.high, rhs.high);
        let c2 = self.high * rhs.low + self.low * rhs.high;
        Self::from_sum(c, c1 + c2)
    }

    /// Returns the quotient, by the algorithm `DWDivDW2`. Both operands must be of moderate size
    /// ([`is_ordinary`]).
    pub(crate) fn ordinary_quotient(self, divisor: &Self) -> Self {
        let t = self.high / divisor.high;
        let (r, r1) = divisor.times_float(t);
        let rest = (self.high - r) + (self.low - r1);
        Self::from_sum(t, rest / divisor.high)
    }

    /// Returns the quotient. The divisor must be finite and not zero.
    #[doc(hidden)]
    #[must_use]
    pub fn over(self, divisor: &Self) -> Self {
        let ((x, e), (y, f)) = (self.normalised(), divisor.normalised());
        let Self { high, low } = x.ordinary_quotient(&y);
        Self::finite((high, low), x.high / y.high).scaled(e - f)
    }

    /// Returns the product with a float, as (high, low).
    fn times_float(self, y: f64) -> (f64, f64) {
        let (c, c1) = two_product(self.high, y);
        let c2 = self.low * y;
        let (t, t1) = fast_two_sum(c, c2);
        fast_two_sum(t, t1 + c1)
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    /// Returns the sum, by the algorithm `AccurateDWPlusDW`.
    #[inline]
    fn add(self, rhs: Self) -> Self {
        let (s, s1) = two_sum(self.high, rhs.high);
        let (t, t1) = two_sum(self.low, rhs.low);
        let (v, v1) = fast_two_sum(s, s1 + t);
        Self::finite(fast_two_sum(v, t1 + v1), self.high + rhs.high)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
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

    #[inline]
    fn add(self, rhs: &Self) -> Self {
        self + *rhs
    }
}

impl Sub<&Self> for DoubleDouble {
    type Output = Self;

    #[inline]
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
    /// Compares the exact values. Not-a-number is unordered, as for `f64`.
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

/// Returns the number rounded to `f64`.
impl From<DoubleDouble> for f64 {
    fn from(value: DoubleDouble) -> Self {
        value.high
    }
}

impl fmt::Display for DoubleDouble {
    /// Writes the two parts as an exact sum, `0.1 - 5.551115123125783e-18`, or the high part alone if low =
    /// 0.
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
