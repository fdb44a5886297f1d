//! Numbers: where formulas degenerate, where rounding ties, where a width ends.

use arbitrary::{Result, Unstructured};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, Zero};

/// n/d.
pub fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

/// base^exponent.
pub fn power(base: u32, exponent: i32) -> BigRational {
    BigRational::from_integer(base.into()).pow(exponent)
}

/// An integer of either sign: small, about a power of two or of ten, where a machine integer ends, or any of
/// 128 bits.
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

/// An `i128`: about the ends of the machine integers and of what floats hold exactly, or any.
pub fn machine_integer(u: &mut Unstructured<'_>) -> Result<i128> {
    let n = match u.int_in_range(0..=3)? {
        0 => u.int_in_range(0..=12)?,
        1 => (1_i128 << u.int_in_range(0..=126)?) + i128::from(nudge(u)?),
        2 => [i128::MIN, i128::MIN + 1, i128::MAX][u.choose_index(3)?],
        _ => u.arbitrary()?,
    };
    Ok(if u.arbitrary()? { n.wrapping_neg() } else { n })
}

/// A rational of either sign, zero included.
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

/// A finite float: any pattern of bits, a power of two or its neighbour, a subnormal, the largest.
pub fn float(u: &mut Unstructured<'_>) -> Result<f64> {
    let x = match u.int_in_range(0..=4)? {
        0 => f64::from(u.arbitrary::<i16>()?),
        1 => 2.0_f64.powi(u.int_in_range(-1022..=1023)?).next_up(),
        2 => 2.0_f64.powi(u.int_in_range(-1022..=1023)?).next_down(),
        3 => f64::from_bits(u.int_in_range(0..=1 << 52)?),
        _ => u.arbitrary()?,
    };
    // Infinities and not-a-numbers have a sign too: it goes to the largest float.
    Ok(if x.is_finite() {
        x
    } else {
        f64::MAX.copysign(x)
    })
}

/// sin φ of a pile of spheres, 0 < s < 1: about ½, where the base is equilateral, about 5/6, beyond which
/// no spacing fits three layers, next to the ends, and floats as the rationals they are.
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

/// sin φ as a float strictly between 0 and 1: any of them, subnormals included, or evenly spread.
pub fn real_sin_phi(u: &mut Unstructured<'_>) -> Result<f64> {
    let largest = 1.0_f64.next_down();
    Ok(if u.arbitrary()? {
        f64::from_bits(u.int_in_range(1..=largest.to_bits())?)
    } else {
        let s = f64::from(u.arbitrary::<u32>()?) / f64::from(u32::MAX);
        s.clamp(f64::MIN_POSITIVE, largest)
    })
}

/// A radius, mass or gravity: 1, as measured, any float's magnitude, or beyond what floats hold.
pub fn quantity(u: &mut Unstructured<'_>) -> Result<BigRational> {
    let x = match u.int_in_range(0..=3)? {
        0 => BigRational::one(),
        1 => ratio(981, 100),
        2 => power(10, u.int_in_range(-330..=330)?),
        _ => exactly(float(u)?).abs(),
    };
    Ok(if x.is_zero() { BigRational::one() } else { x })
}

/// A number for rounding, c·√r, as c and r ≥ 0.
///
/// Besides any two rationals: the point halfway between two floats, where rounding ties; its next
/// neighbourhood, where a lost bit decides; and the edge to infinity.
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

/// A fraction of a way: 0, 1, next to either, or between.
pub fn fraction(u: &mut Unstructured<'_>) -> Result<BigRational> {
    Ok(match u.int_in_range(0..=3)? {
        0 => ratio(u.int_in_range(0..=1)?, 1),
        1 => power(2, u.int_in_range(-100..=-1)?),
        2 => BigRational::one() - power(2, u.int_in_range(-100..=-1)?),
        _ => BigRational::new(u.arbitrary::<u32>()?.into(), u32::MAX.into()),
    })
}

/// The rational that a finite float is.
pub fn exactly(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap_or_default()
}

/// `centre` itself, or so close to it that floats may not tell; within 1/16.
fn about(u: &mut Unstructured<'_>, centre: &BigRational) -> Result<BigRational> {
    let off = power(2, u.int_in_range(-120..=-4)?);
    Ok(centre + off * BigInt::from(nudge(u)?))
}

/// −1, 0 or 1.
fn nudge(u: &mut Unstructured<'_>) -> Result<i32> {
    u.int_in_range(-1..=1)
}

/// Halfway from |x| to the next float up; beyond the largest, to where that float would be.
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

/// The middle between two neighbours among the `f32`.
fn tie_of_f32(u: &mut Unstructured<'_>) -> Result<BigRational> {
    let x = f32::from_bits(u.int_in_range(0..=f32::MAX.to_bits())?);
    let above = f64::from(x.next_up());
    // 2^128, where the float above the largest would be.
    let above = if above.is_finite() {
        above
    } else {
        2.0_f64.powi(128)
    };
    Ok(exactly(f64::from(x).midpoint(above)))
}
