//! Rationals from machine integers.

use num_rational::BigRational;

/// Returns n/d.
pub fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}
