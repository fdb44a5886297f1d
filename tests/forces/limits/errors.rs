//! Errors in units in the last place. They are rationals, so a table of them is the same on every machine.

use core::fmt;

use cannonpile::scalar::Surd;
use cannonpile_testkit::real::Bounded;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use cannonpile_testkit::judge::{Float, exact, significand};
use cannonpile_testkit::rounding::random::power;

/// The spacing of the floats of a format near a number: that of its binade, and at least that of subnormals.
pub(crate) fn unit<F: Float>(about: &BigRational) -> BigRational {
    let (n, d) = (about.numer().magnitude(), about.denom().magnitude());
    let precision = i64::from(F::PRECISION);
    let (_, least) = significand(F::min_positive_value());
    if about.is_zero() {
        return power(least);
    }
    // 2^e ≤ |about| < 2^(e+1), or one more.
    let e = n.bits().cast_signed() - d.bits().cast_signed();
    let e = if about.abs() < power(e) { e - 1 } else { e };
    power((e + 1 - precision).max(least))
}

/// The greatest distance from `exact` to any number that the answer may represent. `None` if it is unbounded.
pub(crate) fn distance<T: Bounded>(got: &T, exact: &BigRational) -> Option<BigRational> {
    let bounds = got.enclosure()?;
    Some(
        (bounds.upper - exact)
            .abs()
            .max((bounds.lower - exact).abs()),
    )
}

/// The difference of a float and its exact value, in units in the last place. It is only for printing: `judge` decides
/// whether the float is correct.
pub(crate) fn rounding<F: Float>(got: F, surd: &Surd) -> BigRational {
    let value = surd.to_rational().unwrap_or_else(|| approximately(surd));
    let off = (exact(got) - &value).abs();
    off / unit::<F>(&value)
}

/// The surd to 200 bits.
fn approximately(surd: &Surd) -> BigRational {
    let root = surd.radicand() << 400_u32;
    surd.coefficient() * BigRational::new(BigInt::from(root.sqrt()), BigInt::one() << 200)
}

/// The worst of several errors.
#[derive(Clone, Debug)]
pub(crate) struct Worst(Option<BigRational>);

impl Worst {
    /// Adds an error. `None` stands for an unbounded one.
    pub(crate) fn add(&mut self, error: Option<BigRational>) {
        // An unbounded error remains unbounded.
        let worst = self.0.take().zip(error);
        self.0 = worst.map(|(worst, error)| worst.max(error));
    }

    /// An empty set of errors.
    pub(crate) fn none() -> Self {
        Self(Some(BigRational::zero()))
    }

    /// Tells whether no error exceeds a limit.
    pub(crate) fn is_at_most(&self, limit: &BigRational) -> bool {
        self.0.as_ref().is_some_and(|worst| worst <= limit)
    }

    /// The exponent of the least power of two that is not smaller. `None` for 0.
    fn exponent(worst: &BigRational) -> Option<i64> {
        let e = worst.numer().bits().cast_signed() - worst.denom().bits().cast_signed();
        let exponents = (e - 1..=e + 1).find(|e| *worst <= power(*e));
        exponents.filter(|_| !worst.is_zero())
    }

    /// As a power of two.
    pub(crate) fn as_power(&self) -> String {
        match &self.0 {
            None => "unbounded".into(),
            Some(worst) => Self::exponent(worst).map_or_else(|| "0".into(), |e| format!("2^{e}")),
        }
    }
}

impl fmt::Display for Worst {
    /// Prints two decimals, or a power of two as an upper bound for a large error.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Some(worst) if *worst < BigRational::from_integer(10_000.into()) => {
                let hundredths = (worst * BigInt::from(100)).round().to_integer();
                let (whole, rest) = hundredths.div_rem(&100.into());
                write!(f, "{whole}.{:02}", rest.to_u8().unwrap_or(0))
            }
            _ => f.write_str(&self.as_power()),
        }
    }
}
