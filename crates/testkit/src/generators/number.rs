//! Numbers at the limits: degenerate formulas, ties of rounding, the ends of an integer width.

use arbitrary::{Result, Unstructured};
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

/// Draws an integer of either sign: small, close to a power of two or of ten, close to the limit of a machine integer,
/// or any integer of 128 bits.
pub fn integer(u: &mut Unstructured<'_>) -> Result<BigInt> {
    let n = match u.int_in_range(0..=4)? {
        0 => u.int_in_range(0..=12)?.into(),
        3 => BigInt::from(2).pow(*u.choose(&[7_u32, 15, 31, 63, 127])?) + nudge(u)?,
        1 => BigInt::from(2).pow(u.int_in_range(0..=200_u32)?) + nudge(u)?,
        2 => BigInt::from(10).pow(u.int_in_range(0..=60_u32)?) + nudge(u)?,
        _ => BigInt::from(u.arbitrary::<i128>()?),
    };
    Ok(if u.arbitrary()? { -n } else { n })
}

/// Draws an `i128`: close to a power of two, at an end of the range, small, or any.
pub fn machine_integer(u: &mut Unstructured<'_>) -> Result<i128> {
    let n = match u.int_in_range(0..=3)? {
        0 => u.int_in_range(0..=12)?,
        1 => (1_i128 << u.int_in_range(0..=126)?) + i128::from(nudge(u)?),
        2 => [i128::MIN, i128::MIN + 1, i128::MAX][u.choose_index(3)?],
        _ => u.arbitrary()?,
    };
    Ok(if u.arbitrary()? { n.wrapping_neg() } else { n })
}

/// Draws a rational of either sign, zero included: a simple fraction, an integer, a quotient of integers, a float,
/// close to ⅓, ½, 5/6 or 1, or a power of ten, possibly outside the range of floats.
pub fn rational(u: &mut Unstructured<'_>) -> Result<BigRational> {
    let r = match u.int_in_range(0..=5)? {
        0 => ratio(u.int_in_range(0..=12)?, u.int_in_range(1..=12)?),
        1 => integer(u)?.into(),
        2 => {
            let denom = integer(u)?;
            let denom = if denom.is_zero() { One::one() } else { denom };
            BigRational::new(integer(u)?, denom)
        }
        3 => exactly(float(u)?),
        4 => {
            let simple = [ratio(1, 1), ratio(1, 2), ratio(5, 6), ratio(1, 3)];
            let centre = u.choose(&simple)?;
            about(u, centre)?
        }
        _ => power(10, u.int_in_range(-400..=400)?),
    };
    Ok(if u.arbitrary()? { -r } else { r })
}

/// Draws a finite float: any bit pattern, next to a power of two, a subnormal, or ±[`f64::MAX`].
pub fn float(u: &mut Unstructured<'_>) -> Result<f64> {
    let x = match u.int_in_range(0..=4)? {
        0 => f64::from(u.arbitrary::<i16>()?),
        1 => power_of_two(u)?.next_up(),
        2 => power_of_two(u)?.next_down(),
        3 => f64::from_bits(u.int_in_range(0..=1 << 52)?),
        _ => u.arbitrary()?,
    };
    // The greatest float gets the sign of the infinity or NaN.
    Ok(if x.is_finite() {
        x
    } else {
        f64::MAX.copysign(x)
    })
}

/// Draws 2^n for −1022 ≤ n ≤ 1023, from its biased exponent, because `powi` needs the standard library.
fn power_of_two(u: &mut Unstructured<'_>) -> Result<f64> {
    Ok(f64::from_bits(u.int_in_range(1..=2046_u64)? << 52))
}

/// Draws sin φ of a pile of spheres, 0 < s < 1: close to ½, where the base is equilateral; close to 5/6, above which
/// three layers overlap at every spacing; close to 0 or 1; a simple fraction; or a float.
pub fn sin_phi(u: &mut Unstructured<'_>) -> Result<BigRational> {
    match u.int_in_range(0..=6)? {
        0 => Ok(ratio(1, 2)),
        1 => about(u, &ratio(1, 2)),
        2 => about(u, &ratio(5, 6)),
        3 => Ok(power(2, u.int_in_range(-200..=-1)?)),
        4 => Ok(BigRational::one() - power(2, u.int_in_range(-200..=-1)?)),
        5 => {
            let d = u.int_in_range(2..=12)?;
            Ok(ratio(u.int_in_range(1..=d - 1)?, d))
        }
        _ => real_sin_phi(u).map(exactly),
    }
}

/// Draws sin φ as a float with 0 < s < 1: any such float, subnormals included, or one from a uniform distribution.
pub fn real_sin_phi(u: &mut Unstructured<'_>) -> Result<f64> {
    let largest = 1.0_f64.next_down();
    Ok(if u.arbitrary()? {
        f64::from_bits(u.int_in_range(1..=largest.to_bits())?)
    } else {
        let s = f64::from(u.arbitrary::<u32>()?) / f64::from(u32::MAX);
        // The values must lie strictly between 0 and 1.
        s.clamp(f64::MIN_POSITIVE, largest)
    })
}

/// Returns the rational that equals a finite float, and 0 for other values.
pub fn exactly(x: f64) -> BigRational {
    // The generators draw finite floats only.
    BigRational::from_float(x).unwrap_or_default()
}

/// Draws `centre`, or a number that differs from it by 2^−120 to 1/16. Floats may be unable to distinguish the two.
fn about(u: &mut Unstructured<'_>, centre: &BigRational) -> Result<BigRational> {
    let off = power(2, u.int_in_range(-120..=-4)?);
    Ok(centre + off * BigInt::from(nudge(u)?))
}

/// Draws −1, 0 or 1.
fn nudge(u: &mut Unstructured<'_>) -> Result<i32> {
    u.int_in_range(-1..=1)
}
