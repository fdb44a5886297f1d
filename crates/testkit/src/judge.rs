//! Which float is nearest to a number, decided without a root and without the library's way of rounding.
//!
//! The number is known by its sign and its square. x = m·2^e is nearest to it if the square lies between those of the
//! points halfway to the neighbours of x, which are (2m ± 1)·2^(e−1); below a power of two the floats are twice as dense.
//! All of these are integers over powers of two, so that a comparison takes one product and one shift.
//!
//! The exhaustive tests, the random ones, fuzzing and the bench of roundings share this judge; `scalar/nearest` plants
//! its faults.

use core::cmp::Ordering;
use core::fmt::Debug;

use cannonpile::scalar::{NearestFloat, Surd};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::float::FloatCore;
use num_traits::{Signed, Zero};

/// Nothing, or which float is not the nearest to what.
pub type Verdict = Result<(), String>;

/// A float format: what the judge needs of `f32` and `f64`.
pub trait Float: NearestFloat + FloatCore + Debug {
    /// The next float on the real line.
    #[must_use]
    fn up(self) -> Self;
    /// The one before.
    #[must_use]
    fn down(self) -> Self;
    /// Whether the last bit of the significand is 0.
    fn is_even(self) -> bool {
        significand(self).0.is_multiple_of(2)
    }
}

macro_rules! float {
    ($($float:ident)*) => {$(
        impl Float for $float {
            fn up(self) -> Self {
                self.next_up()
            }

            fn down(self) -> Self {
                self.next_down()
            }
        }
    )*};
}

float!(f32 f64);

/// A real number by its sign and its square, a fraction that nobody reduces.
#[derive(Clone, Debug)]
pub struct Value {
    negative: bool,
    /// Of the square.
    numer: BigUint,
    /// Of the square, not zero.
    denom: BigUint,
}

impl Value {
    /// `coefficient`·√`radicand`, for a radicand that is not negative.
    pub fn root(coefficient: &BigRational, radicand: &BigRational) -> Self {
        let (n, d) = (
            coefficient.numer().magnitude(),
            coefficient.denom().magnitude(),
        );
        Self {
            negative: coefficient.is_negative(),
            numer: n * n * radicand.numer().magnitude(),
            denom: d * d * radicand.denom().magnitude(),
        }
    }

    /// The number that a surd is.
    pub fn of(surd: &Surd) -> Self {
        let (c, radicand) = (surd.coefficient(), surd.radicand());
        let (n, d) = (c.numer().magnitude(), c.denom().magnitude());
        Self {
            negative: c.is_negative(),
            numer: n * n * radicand,
            denom: d * d,
        }
    }

    /// The number with this sign and this square.
    pub fn with_square(negative: bool, square: &BigRational) -> Self {
        Self {
            negative,
            numer: square.numer().magnitude().clone(),
            denom: square.denom().magnitude().clone(),
        }
    }

    /// The square.
    pub fn square(&self) -> BigRational {
        BigRational::new(self.numer.clone().into(), self.denom.clone().into())
    }

    /// Whether it is less than zero.
    pub fn is_negative(&self) -> bool {
        self.negative && !self.numer.is_zero()
    }

    /// The order of |value| and m·2^e.
    fn cmp_magnitude(&self, m: u64, e: i64) -> Ordering {
        // n/d against m²·4^e
        let product = &self.denom * (u128::from(m) * u128::from(m));
        let shift = 2 * e.unsigned_abs();
        if e < 0 {
            (&self.numer << shift).cmp(&product)
        } else {
            self.numer.cmp(&(product << shift))
        }
    }
}

/// `got` is the float nearest to the value, ties to even; `None` stands for an infinite one.
pub fn is_nearest<F: Float>(got: Option<F>, value: &Value) -> Verdict {
    let holds = match got {
        // The greatest float is odd: halfway to what would follow it belongs to the infinity.
        None => against_half_above(F::max_value(), value).is_ge(),
        Some(x) => {
            let sign_agrees = x.is_zero() || (x < F::zero()) == value.is_negative();
            x.is_finite() && sign_agrees && is_between_halves(x.abs(), value)
        }
    };
    if holds {
        Ok(())
    } else {
        Err(format!("{got:?} is not nearest to {value:?}"))
    }
}

/// Whether |value| rounds to x ≥ 0.
fn is_between_halves<F: Float>(x: F, value: &Value) -> bool {
    let to_even = |order: Ordering| order.is_eq() && x.is_even();
    let above = against_half_above(x, value);
    let (m, e) = significand(x);
    let (least, least_exponent) = significand(F::min_positive_value());
    let below = if x.is_zero() {
        // Nothing lies below zero.
        Ordering::Greater
    } else if m == least && e > least_exponent {
        value.cmp_magnitude(4 * m - 1, e - 2)
    } else {
        value.cmp_magnitude(2 * m - 1, e - 1)
    };
    (above.is_lt() || to_even(above)) && (below.is_gt() || to_even(below))
}

/// The order of |value| and the point halfway from x ≥ 0 to what follows it, were exponents not limited.
fn against_half_above<F: Float>(x: F, value: &Value) -> Ordering {
    let (m, e) = significand(x);
    value.cmp_magnitude(2 * m + 1, e - 1)
}

/// m and e of |x| = m·2^e, as the format stores them.
pub fn significand<F: FloatCore>(x: F) -> (u64, i64) {
    let (m, e, _) = x.integer_decode();
    let (_, least_exponent, _) = F::min_positive_value().integer_decode();
    // Subnormals are decoded with a zero more.
    if e < least_exponent {
        (m / 2, i64::from(e) + 1)
    } else {
        (m, i64::from(e))
    }
}

/// The float as the rational it is.
pub fn exact<F: FloatCore>(x: F) -> BigRational {
    BigRational::from_float(x).expect("a finite float")
}

/// The number that would follow the greatest float, were exponents not limited.
pub fn beyond_greatest<F: Float>() -> BigRational {
    let greatest = exact(F::max_value());
    let before = exact(F::max_value().down());
    &greatest + (&greatest - before)
}

/// Halfway between two numbers.
pub fn midpoint(a: &BigRational, b: &BigRational) -> BigRational {
    (a + b) / BigRational::from_integer(2.into())
}
