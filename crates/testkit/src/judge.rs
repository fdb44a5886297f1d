//! Decides whether a float is correctly rounded, without a root and without the library's rounding.
//!
//! The reference is a sign and a square. The float x = m·2^e is correct if the square lies between the squares of the
//! midpoints to its neighbours, which are (2m ± 1)·2^(e−1). Below a power of two the floats are twice as dense. All these
//! values are integers over powers of two, so a comparison costs one product and one shift.
//!
//! The exhaustive tests, the random ones, fuzzing and the bench of roundings share this check. The tests of
//! `claims::nearest` show that it detects faults.

use core::cmp::Ordering;
use core::fmt::Debug;

use cannonpile::scalar::{CorrectlyRounded, Surd};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::float::FloatCore;
use num_traits::{Signed, Zero};

/// `Ok`, or the wrong float and the exact value.
pub type Verdict = Result<(), String>;

/// The operations that the check needs of `f32` and `f64`.
pub trait Float: CorrectlyRounded + FloatCore + Debug {
    /// The next greater float.
    #[must_use]
    fn up(self) -> Self;
    /// The next smaller float.
    #[must_use]
    fn down(self) -> Self;
    /// True if the last bit of the significand is 0.
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

/// A real number by its sign and its square. The fraction is not reduced.
#[derive(Clone, Debug)]
pub struct Value {
    negative: bool,
    /// The numerator of the square.
    numer: BigUint,
    /// The denominator of the square, not zero.
    denom: BigUint,
}

impl Value {
    /// `coefficient`·√`radicand`, for a nonnegative radicand.
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

    /// The value of a surd.
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

    /// True if it is less than zero.
    pub fn is_negative(&self) -> bool {
        self.negative && !self.numer.is_zero()
    }

    /// Compares |value| with m·2^e.
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

/// Checks that `got` is the value correctly rounded, with ties to even. `None` stands for infinity.
pub fn is_nearest<F: Float>(got: Option<F>, value: &Value) -> Verdict {
    let holds = match got {
        // The significand of the greatest float is odd, so the midpoint above it rounds to infinity.
        None => against_half_above(F::max_value(), value).is_ge(),
        Some(x) => {
            let sign_agrees = x.is_zero() || (x < F::zero()) == value.is_negative();
            x.is_finite() && sign_agrees && is_between_halves(x.abs(), value)
        }
    };
    if holds {
        Ok(())
    } else {
        Err(format!("{got:?} is not the float nearest to {value:?}"))
    }
}

/// Tells whether |value| rounds to x ≥ 0.
fn is_between_halves<F: Float>(x: F, value: &Value) -> bool {
    let to_even = |order: Ordering| order.is_eq() && x.is_even();
    let above = against_half_above(x, value);
    let (m, e) = significand(x);
    let (least, least_exponent) = significand(F::min_positive_value());
    let below = if x.is_zero() {
        // Zero has no lower neighbour here.
        Ordering::Greater
    } else if m == least && e > least_exponent {
        value.cmp_magnitude(4 * m - 1, e - 2)
    } else {
        value.cmp_magnitude(2 * m - 1, e - 1)
    };
    (above.is_lt() || to_even(above)) && (below.is_gt() || to_even(below))
}

/// Compares |value| with the midpoint of x ≥ 0 and its successor, for unbounded exponents.
fn against_half_above<F: Float>(x: F, value: &Value) -> Ordering {
    let (m, e) = significand(x);
    value.cmp_magnitude(2 * m + 1, e - 1)
}

/// m and e of |x| = m·2^e, as the format stores them.
pub fn significand<F: FloatCore>(x: F) -> (u64, i64) {
    let (m, e, _) = x.integer_decode();
    let (_, least_exponent, _) = F::min_positive_value().integer_decode();
    // Decoding adds a zero bit to subnormals.
    if e < least_exponent {
        (m / 2, i64::from(e) + 1)
    } else {
        (m, i64::from(e))
    }
}

/// The exact value of a float.
pub fn exact<F: FloatCore>(x: F) -> BigRational {
    BigRational::from_float(x).expect("a finite float")
}

/// The successor of the greatest float, if exponents were unbounded.
pub fn beyond_greatest<F: Float>() -> BigRational {
    let greatest = exact(F::max_value());
    let before = exact(F::max_value().down());
    &greatest + (&greatest - before)
}

/// The midpoint of two numbers.
pub fn midpoint(a: &BigRational, b: &BigRational) -> BigRational {
    (a + b) / BigRational::from_integer(2.into())
}
