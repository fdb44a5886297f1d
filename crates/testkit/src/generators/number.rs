//! Numbers at the limits: degenerate formulas, ties of rounding, the ends of an integer width.

use arbitrary::{Result, Unstructured};
use cannonpile::arbitrary::number::nudge;
pub use cannonpile::arbitrary::number::{
    exactly, float, integer, machine_integer, rational, real_sin_phi, sin_phi,
};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, Zero};

pub use crate::rational::ratio;

/// base^exponent.
pub fn power(base: u32, exponent: i32) -> BigRational {
    BigRational::from_integer(base.into()).pow(exponent)
}

/// A radius, mass or gravity: 1, a measured value, the magnitude of any float, or a value outside the range of floats.
pub fn quantity(u: &mut Unstructured<'_>) -> Result<BigRational> {
    let x = match u.int_in_range(0..=3)? {
        0 => BigRational::one(),
        1 => ratio(981, 100),
        2 => power(10, u.int_in_range(-330..=330)?),
        _ => exactly(float(u)?).abs(),
    };
    Ok(if x.is_zero() { BigRational::one() } else { x })
}

/// A value to round, c·√r, as c and r ≥ 0.
///
/// It is any two rationals, the midpoint of two floats (a tie), the close neighbourhood of a midpoint (where a lost bit
/// matters), or the overflow threshold.
pub fn root(u: &mut Unstructured<'_>) -> Result<(BigRational, BigRational)> {
    if u.arbitrary()? {
        return Ok((rational(u)?, rational(u)?.abs()));
    }
    let tie = if u.arbitrary()? {
        tie_of_f64(float(u)?)
    } else {
        tie_of_f32(u)?
    };
    let square = &tie * &tie;
    Ok(match u.int_in_range(0..=2)? {
        0 => (tie, BigRational::one()),
        1 => (BigRational::one(), square),
        _ => {
            let off = BigRational::one() + power(2, -300) * BigInt::from(nudge(u)?);
            (BigRational::one(), square * off)
        }
    })
}

/// A fraction of an interval: 0, 1, next to either, or between.
pub fn fraction(u: &mut Unstructured<'_>) -> Result<BigRational> {
    Ok(match u.int_in_range(0..=3)? {
        0 => ratio(u.int_in_range(0..=1)?, 1),
        1 => power(2, u.int_in_range(-100..=-1)?),
        2 => BigRational::one() - power(2, u.int_in_range(-100..=-1)?),
        _ => BigRational::new(u.arbitrary::<u32>()?.into(), u32::MAX.into()),
    })
}

/// The midpoint of |x| and the next float above. Above the largest float it uses the value that would follow.
fn tie_of_f64(x: f64) -> BigRational {
    let x = x.abs();
    let below = x.next_down().max(0.0);
    let step = if x.next_up().is_finite() {
        exactly(x.next_up()) - exactly(x)
    } else {
        exactly(x) - exactly(below)
    };
    exactly(x) + step / BigInt::from(2)
}

/// The midpoint of two neighbouring `f32`.
fn tie_of_f32(u: &mut Unstructured<'_>) -> Result<BigRational> {
    let x = f32::from_bits(u.int_in_range(0..=f32::MAX.to_bits())?);
    let above = f64::from(x.next_up());
    // 2^128, the value that would follow the largest float.
    let above = if above.is_finite() {
        above
    } else {
        2.0_f64.powi(128)
    };
    Ok(exactly(f64::from(x).midpoint(above)))
}
