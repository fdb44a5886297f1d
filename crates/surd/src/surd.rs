//! Exact numbers c·√n.

use alloc::format;
use alloc::string::ToString;
use core::cmp::Ordering;
use core::fmt;
use core::hash::{Hash, Hasher};
use core::ops::{Mul, Neg};

use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::nearest::{nearest_ratio, nearest_root, screened};
use crate::rational::{ByValue, product, reduced};
use crate::{CorrectlyRounded, Error};

/// An exact number c·√n, with c rational and n a positive integer.
///
/// Example: a contact force is n·mg/(3 cosθ) with cos²θ rational. Heights contain the factor cosθ,
/// horizontal positions sinθ and √3. All these numbers are surds.
///
/// The product of two surds is a surd. Surds are compared exactly, through their squares. The sum of two
/// surds is in general not a surd, so `Surd` is not a scalar type.
///
/// √(a/b) is stored as √(ab)/b, after extraction of square factors from a and from b: the squares of all
/// primes below 1000, and the cofactor if it is a perfect square. In particular √(a/b²) has the radicand of √a,
/// for all coprime a and b. Equality and order do not depend on the stored form.
///
/// # Examples
/// ```
/// use exact_surd::Surd;
/// use num_rational::BigRational;
///
/// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
/// let x = Surd::new(ratio(7, 3), ratio(8, 17))?;
/// assert_eq!(x.to_string(), "14/51*sqrt(34)");
/// assert_eq!(x.square(), ratio(7 * 7 * 8, 3 * 3 * 17));
/// // The correctly rounded value. Rounding after each operation gives the next float above it.
/// assert_eq!(x.nearest::<f64>(), Some(1.6006534613300825));
/// assert_eq!(7.0 / 3.0 * (8.0 / 17.0_f64).sqrt(), 1.6006534613300827);
/// # Ok::<(), exact_surd::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Surd {
    coefficient: BigRational,
    /// A positive integer. It is 1 if the value is rational, and not a perfect square otherwise.
    radicand: BigUint,
}

impl Surd {
    /// Returns the number `coefficient`·√`radicand`.
    ///
    /// # Errors
    /// Returns [`Error::NegativeRadicand`] if the radicand is negative.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Error;
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    /// // √(8/9) = (2/3)√2
    /// assert_eq!(Surd::new(ratio(1, 2), ratio(8, 9))?.to_string(), "1/3*sqrt(2)");
    /// let refused = Surd::new(ratio(1, 2), ratio(-8, 9));
    /// assert!(matches!(refused, Err(Error::NegativeRadicand { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn new(coefficient: BigRational, radicand: BigRational) -> Result<Self, Error> {
        if radicand.is_negative() {
            return Err(Error::NegativeRadicand { given: radicand });
        }
        Ok(Self::of_valid(coefficient, radicand))
    }

    /// Returns √`square`. The argument must not be negative.
    #[doc(hidden)]
    #[must_use]
    pub fn root_of(square: BigRational) -> Self {
        debug_assert!(!square.is_negative(), "the root of {square} is not real");
        Self::of_valid(BigRational::one(), square)
    }

    fn of_valid(coefficient: BigRational, radicand: BigRational) -> Self {
        // Numerator and denominator are coprime, so their square factors can be extracted separately.
        let (numer, denom) = radicand.into_raw();
        let [(p, a), (q, b)] = [numer, denom].map(|n| extract_squares(n.into_parts().1));
        // √(p²a/q²b) = p/(qb)·√(ab)
        let root = BigRational::new(p.into(), (q * &b).into());
        Self::normal(coefficient * root, a * b)
    }

    /// Returns √`radicand`.
    ///
    /// # Errors
    /// Returns [`Error::NegativeRadicand`] if the radicand is negative.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let root = Surd::sqrt(BigRational::new(4.into(), 9.into()))?;
    /// assert_eq!(root.to_rational().unwrap().to_string(), "2/3");
    /// // The square of a denominator is extracted, whatever its prime factors are.
    /// let root = Surd::sqrt(BigRational::new(2.into(), (1_000_003_i64 * 1_000_003).into()))?;
    /// assert_eq!(root.to_string(), "1/1000003*sqrt(2)");
    /// assert!(Surd::sqrt(BigRational::from_integer((-1).into())).is_err());
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    pub fn sqrt(radicand: BigRational) -> Result<Self, Error> {
        Self::new(BigRational::one(), radicand)
    }

    /// Returns zero.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let root = Surd::sqrt(BigRational::from_integer(3.into()))?;
    /// assert_eq!(root.scaled(&BigRational::from_integer(0.into())), Surd::zero());
    /// assert_eq!(root.checked_add(&Surd::zero()), Some(root));
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn zero() -> Self {
        BigRational::zero().into()
    }

    /// Returns `coefficient`·√`radicand`; zero has the unique form 0·√1.
    fn normal(coefficient: BigRational, radicand: BigUint) -> Self {
        if coefficient.is_zero() || radicand.is_zero() {
            return Self {
                coefficient: BigRational::zero(),
                radicand: BigUint::one(),
            };
        }
        Self {
            coefficient,
            radicand,
        }
    }

    /// Returns the rational factor c of c·√n.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    /// assert_eq!(Surd::sqrt(ratio(8, 9))?.coefficient(), &ratio(2, 3));
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn coefficient(&self) -> &BigRational {
        &self.coefficient
    }

    /// Returns the integer n ≥ 1 of c·√n.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    /// assert_eq!(Surd::sqrt(ratio(8, 9))?.radicand().to_string(), "2");
    /// // The radicand of a rational is 1.
    /// assert_eq!(Surd::sqrt(ratio(4, 9))?.radicand().to_string(), "1");
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn radicand(&self) -> &BigUint {
        &self.radicand
    }

    /// Returns the square c²·n, which is always rational.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    /// assert_eq!(Surd::new(ratio(-1, 2), ratio(3, 1))?.square(), ratio(3, 4));
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn square(&self) -> BigRational {
        let (p, q) = (self.coefficient.numer(), self.coefficient.denom());
        let (n, denom) = (BigInt::from(self.radicand.clone()), q * q);
        // p and q are coprime, so only n and q² can have a common factor. The remainder modulo n is short in most
        // cases.
        let common = (&denom % &n).gcd(&n);
        BigRational::new_raw(p * p * (n / &common), denom / common)
    }

    /// Returns the sign.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_bigint::Sign;
    /// use num_rational::BigRational;
    ///
    /// let root = Surd::sqrt(BigRational::from_integer(3.into()))?;
    /// assert_eq!(root.sign(), Sign::Plus);
    /// assert_eq!((-root).sign(), Sign::Minus);
    /// assert_eq!(Surd::zero().sign(), Sign::NoSign);
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn sign(&self) -> Sign {
        self.coefficient.numer().sign()
    }

    /// Returns the value as a rational, or `None` if it is irrational.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    /// assert_eq!(Surd::sqrt(ratio(4, 9))?.to_rational(), Some(ratio(2, 3)));
    /// assert_eq!(Surd::sqrt(ratio(2, 9))?.to_rational(), None);
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn to_rational(&self) -> Option<BigRational> {
        self.radicand.is_one().then(|| self.coefficient.clone())
    }

    /// Returns the product with a rational, exactly. The radicand does not change.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let root = Surd::sqrt(BigRational::from_integer(3.into()))?;
    /// assert_eq!(root.scaled(&BigRational::new(5.into(), 2.into())).to_string(), "5/2*sqrt(3)");
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn scaled(&self, factor: &BigRational) -> Self {
        Self::normal(product(&self.coefficient, factor), self.radicand.clone())
    }

    /// Returns the sum, or `None` if it is not a surd.
    ///
    /// The sum is a surd if the ratio of both numbers is rational, or if one is zero.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let root = |n: i64| Surd::sqrt(BigRational::from_integer(n.into()));
    /// assert_eq!(root(3)?.checked_add(&root(12)?).unwrap().to_string(), "3*sqrt(3)");
    /// assert_eq!(root(3)?.checked_add(&root(2)?), None);
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn checked_add(&self, other: &Self) -> Option<Self> {
        if self.coefficient.is_zero() {
            return Some(other.clone());
        }
        if other.coefficient.is_zero() {
            return Some(self.clone());
        }
        let coefficient = if self.radicand == other.radicand {
            other.coefficient.clone()
        } else {
            // b√n = b·√(mn)/m·√m
            let product = &self.radicand * &other.radicand;
            let (root, rest) = whole_square(product);
            let factor = BigRational::new(root.into(), self.radicand.clone().into());
            rest.is_one().then(|| &other.coefficient * factor)?
        };
        let coefficient = &self.coefficient + coefficient;
        Some(Self::normal(coefficient, self.radicand.clone()))
    }

    /// Returns 1 / `self`, or `None` for zero.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let root = Surd::sqrt(BigRational::from_integer(3.into()))?;
    /// assert_eq!(root.checked_recip().unwrap().to_string(), "1/3*sqrt(3)");
    /// assert_eq!(Surd::zero().checked_recip(), None);
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn checked_recip(&self) -> Option<Self> {
        // 1/(c√n) = √n/(cn)
        let radicand = BigRational::from_integer(self.radicand.clone().into());
        (!self.coefficient.is_zero()).then(|| Self {
            coefficient: (&self.coefficient * radicand).recip(),
            radicand: self.radicand.clone(),
        })
    }

    /// Returns the nearest `f64`, ties to even, or an infinity if the value overflows.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let root = Surd::sqrt(BigRational::from_integer(2.into()))?;
    /// assert_eq!(root.to_f64(), 2_f64.sqrt());
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        // `None` means overflow, so the result is an infinity with the sign of the number.
        self.nearest().unwrap_or(if self.coefficient.is_negative() {
            f64::NEG_INFINITY
        } else {
            f64::INFINITY
        })
    }

    /// Returns the correctly rounded value, ties to even, also among the subnormals. `None` if the value
    /// overflows.
    ///
    /// The rounding is always correct. A double-double enclosure decides most cases. If the enclosure
    /// contains more than one candidate, one integer square root and a sticky bit decide.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::Surd;
    /// use num_rational::BigRational;
    ///
    /// let root = Surd::sqrt(BigRational::from_integer(2.into()))?;
    /// assert_eq!(root.nearest::<f64>(), Some(core::f64::consts::SQRT_2));
    /// assert_eq!(root.nearest::<f32>(), Some(core::f32::consts::SQRT_2));
    /// # Ok::<(), exact_surd::Error>(())
    /// ```
    #[must_use]
    pub fn nearest<F: CorrectlyRounded>(&self) -> Option<F> {
        let (negative, [n, d], root) = self.parts();
        self.screened().or_else(|| match root {
            None => nearest_ratio(negative, n, d),
            // The fraction is not reduced, because a common factor costs less here than its search.
            Some(radicand) => nearest_root(negative, &(n * n * radicand), &(d * d)),
        })
    }

    /// Returns the correctly rounded value if the double-double enclosure decides it.
    fn screened<F: CorrectlyRounded>(&self) -> Option<F> {
        let (negative, [n, d], root) = self.parts();
        screened(negative, n, d, root)
    }

    /// Returns the sign, the magnitudes of numerator and denominator, and the radicand of an irrational
    /// number.
    fn parts(&self) -> (bool, [&BigUint; 2], Option<&BigUint>) {
        let (n, d) = (self.coefficient.numer(), self.coefficient.denom());
        let root = Some(&self.radicand).filter(|radicand| !radicand.is_one());
        (n.is_negative(), [n.magnitude(), d.magnitude()], root)
    }

    /// Returns the square times the sign of the number. The map is monotone, so it orders surds.
    fn signed_square(&self) -> BigRational {
        if self.coefficient.is_negative() {
            -self.square()
        } else {
            self.square()
        }
    }
}

/// Returns (root, rest) with `n` = root²·rest. All squares of primes below 1000 are in `root²`, and so is
/// the remaining cofactor if it is a perfect square.
fn extract_squares(mut n: BigUint) -> (BigUint, BigUint) {
    let (mut root, mut rest) = (BigUint::one(), BigUint::one());
    if n.is_zero() {
        return (root, n);
    }
    for p in (2_u32..1000).filter(|p| *p == 2 || p % 2 == 1) {
        if n < BigUint::from(p * p) {
            break;
        }
        let mut odd = false;
        loop {
            let (quotient, remainder) = n.div_rem(&p.into());
            if !remainder.is_zero() {
                break;
            }
            n = quotient;
            root *= if odd { p } else { 1 };
            odd = !odd;
        }
        rest *= if odd { p } else { 1 };
    }
    let (others, n) = whole_square(n);
    (root * others, rest * n)
}

/// Returns (√n, 1) for a perfect square, (1, n) otherwise.
fn whole_square(n: BigUint) -> (BigUint, BigUint) {
    let root = n.sqrt();
    if &root * &root == n {
        (root, BigUint::one())
    } else {
        (BigUint::one(), n)
    }
}

impl Surd {
    /// Returns a fraction that is in lowest terms and has a positive denominator, without a greatest common divisor.
    #[doc(hidden)]
    #[must_use]
    pub fn from_reduced(value: BigRational) -> Self {
        debug_assert!(
            value.denom().is_positive() && value.numer().gcd(value.denom()).is_one(),
            "{value} is not in lowest terms"
        );
        Self::normal(value, BigUint::one())
    }
}

impl From<BigRational> for Surd {
    /// The fraction need not be in lowest terms.
    fn from(value: BigRational) -> Self {
        Self::normal(reduced(value), BigUint::one())
    }
}

impl Neg for Surd {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            coefficient: -self.coefficient,
            radicand: self.radicand,
        }
    }
}

impl Mul<&Self> for Surd {
    type Output = Self;

    fn mul(self, rhs: &Self) -> Self {
        // √(g·a)·√(g·b) = g·√(a·b): the common factor g of the radicands is extracted.
        let g = self.radicand.gcd(&rhs.radicand);
        let radicand = (&self.radicand / &g) * (&rhs.radicand / &g);
        // Two radicands can contain large squares that were not found. Their product can still be a perfect
        // square.
        let (root, radicand) = whole_square(radicand);
        let factor = BigRational::from_integer((g * root).into());
        Self::normal(self.coefficient * &rhs.coefficient * factor, radicand)
    }
}

impl Mul for Surd {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        self * &rhs
    }
}

impl Hash for Surd {
    /// Equal numbers have equal hashes, also if their stored radicands differ.
    fn hash<H: Hasher>(&self, state: &mut H) {
        ByValue(&self.signed_square()).hash(state);
    }
}

impl PartialEq for Surd {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Surd {}

impl PartialOrd for Surd {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Surd {
    fn cmp(&self, other: &Self) -> Ordering {
        if self.radicand == other.radicand {
            return ByValue(&self.coefficient).cmp(&ByValue(&other.coefficient));
        }
        ByValue(&self.signed_square()).cmp(&ByValue(&other.signed_square()))
    }
}

macro_rules! compare_with_float {
    ($($float:ident)*) => {$(
        /// Compares exactly, with the rational value of the float.
        impl PartialEq<$float> for Surd {
            fn eq(&self, other: &$float) -> bool {
                self.partial_cmp(other).is_some_and(Ordering::is_eq)
            }
        }

        /// Compares exactly, with the rational value of the float; `None` for not-a-number.
        impl PartialOrd<$float> for Surd {
            fn partial_cmp(&self, other: &$float) -> Option<Ordering> {
                match BigRational::from_float(*other) {
                    Some(value) => Some(self.cmp(&value.into())),
                    None if other.is_nan() => None,
                    None if *other > 0.0 => Some(Ordering::Less),
                    None => Some(Ordering::Greater),
                }
            }
        }
    )*};
}

compare_with_float!(f32 f64);

impl fmt::Display for Surd {
    /// Writes `7/3*sqrt(2)`, with the width, fill, alignment and sign of the formatter.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let magnitude = self.coefficient.abs();
        let text = if self.radicand.is_one() {
            magnitude.to_string()
        } else if magnitude.is_one() {
            format!("sqrt({})", self.radicand)
        } else {
            format!("{magnitude}*sqrt({})", self.radicand)
        };
        f.pad_integral(!self.coefficient.is_negative(), "", &text)
    }
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;

    use super::*;

    fn two_to(power: u32) -> BigRational {
        BigRational::from_integer(BigInt::from(1) << power)
    }

    /// Yields (2^p + 1)·(1 ± ε)·2^e for small ε, near the midpoint of two floats of p bits. A double-double
    /// cannot decide the rounding of these numbers.
    fn near_ties(bits: u32) -> impl Iterator<Item = Surd> {
        let middle = two_to(bits) + BigRational::one();
        let offsets = [100, 150, 200, 1000].map(|k| two_to(k).recip());
        let factors = offsets
            .into_iter()
            .flat_map(|offset| [BigRational::one() - &offset, BigRational::one() + offset]);
        let roots = factors.map(move |factor| Surd::sqrt(&middle * &middle * factor).unwrap());
        let scales = [two_to(80).recip(), two_to(1).recip(), two_to(0), two_to(60)];
        roots.flat_map(move |root| scales.clone().map(|scale| root.scaled(&scale)))
    }

    #[cfg(feature = "std")]
    #[test]
    fn enclosure_decides_away_from_ties() {
        let long = BigRational::new(two_to(300).to_integer() + 1, two_to(200).to_integer() + 7);
        for value in [Surd::from(long.clone()), Surd::sqrt(long).unwrap()] {
            assert!(value.screened::<f64>().is_some() && value.screened::<f32>().is_some());
            assert_eq!(value.screened::<f64>(), value.nearest::<f64>());
        }
    }

    #[test]
    fn integers_decide_near_ties_only() {
        // Without `std` roots have no double-double enclosure.
        let with_screen = cfg!(feature = "std");
        for (double, single) in near_ties(53).zip(near_ties(24)) {
            assert!(double.screened::<f64>().is_none() && single.screened::<f32>().is_none());
            assert_eq!(double.screened::<f32>().is_some(), with_screen);
            assert_eq!(single.screened::<f64>().is_some(), with_screen);
        }
        // The probability of a near tie is below one in a hundred thousand.
        for n in (2..5000).filter(|n: &i32| n.isqrt().pow(2) != *n) {
            let root = Surd::sqrt(BigRational::from_integer(n.into())).unwrap();
            assert_eq!(root.screened::<f64>().is_some(), with_screen);
            assert_eq!(root.screened::<f32>().is_some(), with_screen);
        }
    }
}
