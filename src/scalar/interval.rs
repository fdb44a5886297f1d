//! Intervals with `f64` ends. Every result contains the true result.

use core::cmp::Ordering;
use core::fmt;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Algebra, CorrectlyRounded, Exactness, Field, Ring, THREE, tripled_apart};
use crate::each::Each;
use exact_surd::error_free::{is_ordinary, significand, two_product, two_sum};
use exact_surd::layout::padded;

/// A closed interval [lower, upper] of real numbers. Its ends are `f64` values and may be infinite.
///
/// Operations round outward: the result contains all results for operands in the given intervals. So the true value
/// always lies inside. Each end is the tightest possible `f64`, with two exceptions: it may be one float wider for
/// products and quotients in the subnormal range, and two floats wider after division by an integer of more than 53
/// bits. Away from the limits of the range, a single point stays a single point as long as the exact results are
/// floats.
///
/// # Examples
/// ```
/// use cannonpile::scalar::{Algebra, Interval, Ring};
///
/// let third = Interval::from_integer(1).div_int(3.try_into().unwrap());
/// assert_eq!(third.upper(), third.lower().next_up());
/// let rest = Interval::from_integer(1) - (third + third + third);
/// assert!(rest.contains_f64(0.0));
/// // The divisor contains zero, so the quotient is undefined.
/// assert_eq!(third.checked_div(&rest), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lower: f64,
    upper: f64,
}

impl Interval {
    /// The whole real line: the interval of an unknown value.
    pub const WHOLE: Self = Self {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    };

    /// Returns the interval [`lower`, `upper`]. Returns `None` unless `lower` ≤ `upper` and the interval contains a
    /// real number.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Interval;
    ///
    /// assert!(Interval::new(1.0, f64::INFINITY).is_some());
    /// assert!(Interval::new(2.0, 1.0).is_none());
    /// assert!(Interval::new(f64::INFINITY, f64::INFINITY).is_none());
    /// assert!(Interval::new(f64::NAN, 1.0).is_none());
    /// ```
    #[must_use]
    pub fn new(lower: f64, upper: f64) -> Option<Self> {
        let holds = lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY;
        holds.then_some(Self { lower, upper })
    }

    /// Returns the interval that contains only `value`, or the whole line if `value` is not finite.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Interval;
    ///
    /// assert_eq!(Some(Interval::point(0.1)), Interval::new(0.1, 0.1));
    /// assert_eq!(Interval::point(f64::NAN), Interval::WHOLE);
    /// ```
    #[must_use]
    pub fn point(value: f64) -> Self {
        // A value that is not finite may be any number.
        Self::new(value, value).unwrap_or(Self::WHOLE)
    }

    /// Returns the lower end.
    #[must_use]
    pub const fn lower(&self) -> f64 {
        self.lower
    }

    /// Returns the upper end.
    #[must_use]
    pub const fn upper(&self) -> f64 {
        self.upper
    }

    /// Returns whether the interval contains a rational. The test is exact.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Algebra, Interval};
    /// use num_rational::BigRational;
    ///
    /// let tenth = BigRational::new(1.into(), 10.into());
    /// assert!(Interval::from_rational(&tenth).contains(&tenth));
    /// assert!(!Interval::point(0.1).contains(&tenth));
    /// ```
    #[must_use]
    pub fn contains(&self, value: &BigRational) -> bool {
        // An infinite end has no rational and does not limit the interval.
        let above = BigRational::from_float(self.lower).is_none_or(|lower| lower <= *value);
        above && BigRational::from_float(self.upper).is_none_or(|upper| *value <= upper)
    }

    /// Returns whether the interval contains a finite float. The result is false for an infinity or not-a-number.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Interval;
    ///
    /// let interval = Interval::new(1.0, f64::INFINITY).unwrap();
    /// assert!(interval.contains_f64(1.0) && !interval.contains_f64(0.5));
    /// assert!(!interval.contains_f64(f64::INFINITY));
    /// ```
    #[must_use]
    pub fn contains_f64(&self, value: f64) -> bool {
        value.is_finite() && self.lower <= value && value <= self.upper
    }

    /// Returns the width, upper − lower, rounded up. It is infinite unless both ends are finite.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Interval;
    ///
    /// assert_eq!(Interval::new(1.0, 1.5).unwrap().width(), 0.5);
    /// assert_eq!(Interval::point(0.1).width(), 0.0);
    /// assert_eq!(Interval::WHOLE.width(), f64::INFINITY);
    /// ```
    #[must_use]
    pub fn width(&self) -> f64 {
        if self.lower.is_infinite() || self.upper.is_infinite() {
            return f64::INFINITY;
        }
        (Self::point(self.upper) - Self::point(self.lower)).upper
    }

    /// Returns a float in the interval, halfway between the ends up to rounding. An infinite end counts as the greatest
    /// float.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Interval;
    ///
    /// assert_eq!(Interval::new(1.0, 2.0).unwrap().midpoint(), 1.5);
    /// assert_eq!(Interval::point(0.1).midpoint(), 0.1);
    /// assert_eq!(Interval::WHOLE.midpoint(), 0.0);
    /// ```
    #[must_use]
    pub fn midpoint(&self) -> f64 {
        self.lower.max(f64::MIN).midpoint(self.upper.min(f64::MAX))
    }

    /// Returns the smallest interval that contains the bounds `end(x, y)` for all four `corners` (x, y).
    fn hull(corners: [(f64, f64); 4], end: impl Fn(f64, f64) -> (f64, f64)) -> Self {
        let (mut lower, mut upper) = (f64::INFINITY, f64::NEG_INFINITY);
        for (x, y) in corners {
            let (down, up) = end(x, y);
            lower = lower.min(down);
            upper = upper.max(up);
        }
        Self { lower, upper }
    }

    /// Returns the quotient. The divisor must not contain zero.
    fn over(self, divisor: &Self) -> Self {
        Self::hull(self.corners(divisor), quotient)
    }

    fn corners(self, other: &Self) -> [(f64, f64); 4] {
        [
            (self.lower, other.lower),
            (self.lower, other.upper),
            (self.upper, other.lower),
            (self.upper, other.upper),
        ]
    }

    fn has_zero(&self) -> bool {
        self.lower <= 0.0 && self.upper >= 0.0
    }
}

impl PartialOrd for Interval {
    /// Compares disjoint intervals: one is less if all its values are below all values of the other.
    ///
    /// Overlapping intervals are unordered, except that two intervals with the same ends are equal, as for `==`.
    /// Equality compares the ends, not the unknown values inside, unless both are single points. The results `<` and
    /// `>` are certain for the values inside.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::Interval;
    ///
    /// let interval = |lower, upper| Interval::new(lower, upper).unwrap();
    /// assert!(interval(0.0, 1.0) < interval(1.5, 2.0));
    /// assert_eq!(interval(0.0, 1.0).partial_cmp(&interval(1.0, 2.0)), None);
    /// ```
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self == other {
            Some(Ordering::Equal)
        } else if self.upper < other.lower {
            Some(Ordering::Less)
        } else if self.lower > other.upper {
            Some(Ordering::Greater)
        } else {
            None
        }
    }
}

impl fmt::Display for Interval {
    /// Prints `[0.5, 0.75]`. Each end is the shortest decimal that reads back the same. The precision of the format is
    /// ignored.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (lower, upper) = (self.lower, self.upper);
        if f.sign_plus() {
            padded(f, format_args!("[{lower:+?}, {upper:+?}]"))
        } else {
            padded(f, format_args!("[{lower:?}, {upper:?}]"))
        }
    }
}

/// Returns the tightest floats around `value` + ε. Only the sign of ε = `error` is used. If it is unknown (NaN),
/// returns both neighbours of `value`.
fn outward(value: f64, error: f64) -> (f64, f64) {
    if value == f64::INFINITY {
        // The result is finite but exceeds the range of floats.
        return (f64::MAX, value);
    }
    if value == f64::NEG_INFINITY {
        return (value, f64::MIN);
    }
    let down = if error >= 0.0 {
        value
    } else {
        value.next_down()
    };
    let up = if error <= 0.0 { value } else { value.next_up() };
    (down, up)
}

/// Returns lower and upper bounds of the product of two ends.
fn product(x: f64, y: f64) -> (f64, f64) {
    if x == 0.0 || y == 0.0 {
        // An infinite end represents arbitrarily great real numbers, and their products with zero are zero.
        return (0.0, 0.0);
    }
    let p = x * y;
    if x.is_infinite() || y.is_infinite() {
        return (p, p);
    }
    let (x, y) = in_reach(x, y);
    let (_, error) = two_product(x, y);
    outward(p, if is_normal(p) { error } else { f64::NAN })
}

/// Returns the operands, or their significands if the operands are very great or small. The rounding error then has the
/// same sign and is exact.
fn in_reach(x: f64, y: f64) -> (f64, f64) {
    if is_ordinary(x) && is_ordinary(y) {
        (x, y)
    } else {
        (significand(x).0, significand(y).0)
    }
}

/// Returns whether a product or quotient has a rounding error of the same sign as that of the significands. This is not
/// certain if the result was rounded to the coarser grid of subnormals.
fn is_normal(value: f64) -> bool {
    value.is_finite() && value.abs() > f64::MIN_POSITIVE
}

/// Returns lower and upper bounds of the quotient of two ends. `y` must not be zero.
fn quotient(x: f64, y: f64) -> (f64, f64) {
    if x == 0.0 || y.is_infinite() {
        // The quotient tends to zero as the divisor grows.
        return (0.0, 0.0);
    }
    let q = x / y;
    if x.is_infinite() {
        return (q, q);
    }
    let (x, y) = in_reach(x, y);
    let (p, e) = two_product(x / y, y);
    // x − p is exact, because p equals x up to a few units in the last place.
    let remainder = (x - p) - e;
    let error = if y < 0.0 { -remainder } else { remainder };
    outward(q, if is_normal(q) { error } else { f64::NAN })
}

impl Add<&Self> for Interval {
    type Output = Self;

    fn add(self, rhs: &Self) -> Self {
        let sum = |x: f64, y: f64| {
            // `two_sum` starts with the greater operand. The other order can overflow near the largest float.
            let (s, e) = if x.abs() < y.abs() {
                two_sum(y, x)
            } else {
                two_sum(x, y)
            };
            if x.is_infinite() || y.is_infinite() {
                (s, s)
            } else {
                outward(s, e)
            }
        };
        Self {
            lower: sum(self.lower, rhs.lower).0,
            upper: sum(self.upper, rhs.upper).1,
        }
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            lower: -self.upper,
            upper: -self.lower,
        }
    }
}

impl Sub<&Self> for Interval {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        self + (-*rhs)
    }
}

impl Mul<&Self> for Interval {
    type Output = Self;

    fn mul(self, rhs: &Self) -> Self {
        Self::hull(self.corners(rhs), product)
    }
}

crate::by_value!(Interval);

impl Zero for Interval {
    fn zero() -> Self {
        Self::point(0.0)
    }

    fn is_zero(&self) -> bool {
        self.lower == 0.0 && self.upper == 0.0
    }
}

impl One for Interval {
    fn one() -> Self {
        Self::point(1.0)
    }
}

impl Ring for Interval {
    fn from_integer(n: i128) -> Self {
        Self::from_rational(&BigRational::from_integer(n.into()))
    }
}

impl Algebra for Interval {
    const EXACTNESS: Exactness = Exactness::Enclosure;
    const NAME: &'static str = "Interval";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        let nearest = f64::nearest_to_rational(r);
        let stored = nearest.and_then(|nearest| Some((nearest, BigRational::from_float(nearest)?)));
        let Some((nearest, value)) = stored else {
            let (lower, upper) = outward(
                if *r > BigRational::zero() {
                    f64::INFINITY
                } else {
                    f64::NEG_INFINITY
                },
                f64::NAN,
            );
            return Self { lower, upper };
        };
        let error = match r.cmp(&value) {
            Ordering::Less => -1.0,
            Ordering::Equal => 0.0,
            Ordering::Greater => 1.0,
        };
        let (lower, upper) = outward(nearest, error);
        Self { lower, upper }
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        self.over(&Self::from_integer(n.get().into()))
    }

    /// Returns the quotient, or `None` if the divisor contains zero.
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (divisor.is_defined() && !divisor.has_zero()).then(|| self.over(divisor))
    }

    fn is_defined(&self) -> bool {
        self.lower <= self.upper
    }

    /// Each operand occurs once.
    fn half_turn(g: &[Self; 3]) -> [Self; 3] {
        tripled_apart(g).each(|tripled| tripled.div_int(THREE))
    }
}

impl Field for Interval {}

#[cfg(test)]
mod tests {
    use alloc::format;
    use alloc::string::ToString;

    use super::*;

    const ENDS: [f64; 11] = [
        f64::NEG_INFINITY,
        f64::MIN,
        -1.0,
        -5e-324,
        0.0,
        5e-324,
        1e-323,
        0.1,
        1.0,
        f64::MAX,
        f64::INFINITY,
    ];

    fn intervals() -> impl Iterator<Item = Interval> {
        let pairs = ENDS.into_iter().flat_map(|x| ENDS.map(|y| (x, y)));
        pairs.filter_map(|(x, y)| Interval::new(x, y))
    }

    #[test]
    fn the_order_is_certain_and_agrees_with_equality() {
        for x in intervals() {
            for y in intervals() {
                let order = x.partial_cmp(&y);
                assert_eq!(order == Some(Ordering::Equal), x == y);
                assert_eq!(order, y.partial_cmp(&x).map(Ordering::reverse));
                if let Some(Ordering::Less | Ordering::Greater) = order {
                    assert_eq!(x < y, (y - x).lower() > 0.0, "{x} {y}");
                    assert_eq!(y < x, (x - y).lower() > 0.0, "{x} {y}");
                }
            }
        }
    }

    #[test]
    fn midpoints_lie_inside_and_widths_are_upper_bounds() {
        for x in intervals() {
            assert!(x.contains_f64(x.midpoint()), "{x}");
            let [lower, upper] = [x.lower(), x.upper()].map(BigRational::from_float);
            if let (Some(lower), Some(upper)) = (lower, upper) {
                assert_eq!(Some(x.width()) == Some(0.0), lower == upper, "{x}");
                let width = BigRational::from_float(x.width());
                assert!(width.is_none_or(|width| width >= upper - lower), "{x}");
            } else {
                assert!(x.width().is_infinite(), "{x}");
            }
        }
        for value in ENDS {
            let inside = Interval::WHOLE.contains_f64(value);
            assert_eq!(inside, value.is_finite());
        }
    }

    #[test]
    fn both_ends_are_printed() {
        let x = Interval::new(-0.25, 1e300).unwrap();
        assert_eq!(x.to_string(), "[-0.25, 1e300]");
        assert_eq!(format!("{x:>16}"), "  [-0.25, 1e300]");
        assert_eq!(format!("{x:*^+18.1}"), "*[-0.25, +1e300]**");
        assert_eq!(Interval::WHOLE.to_string(), "[-inf, inf]");
    }
}
