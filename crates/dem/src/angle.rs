//! The angle of a tilt, in degrees.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::Error;
use crate::weights::nearest_rational;
use cannonpile::Packing;

/// Returns the angle of a tilt in degrees, correctly rounded: atan(|t|·tanθ), from |t|².
///
/// # Errors
/// [`Error::Overflow`](cannonpile::Error::Overflow) for an angle that is too small for `f64`.
pub fn of_tilt(packing: &Packing<'_>, squared: &BigRational) -> Result<f64, Error> {
    let inclination = packing.inclination();
    let tan2 = squared * inclination.sin2() / inclination.cos2();
    nearest_rational(&degrees(&tan2), "an angle")
}

/// Returns atan √`square` in degrees, with a relative error below 2⁻¹⁵⁰.
fn degrees(square: &BigRational) -> BigRational {
    if square.is_zero() {
        return BigRational::zero();
    }
    let is_steep = *square > BigRational::one();
    let square = if is_steep {
        square.recip()
    } else {
        square.clone()
    };
    let (numer, denom) = (square.numer(), square.denom());
    // The root of a small square needs further bits.
    let bits = 180 + denom.bits().saturating_sub(numer.bits()) / 2;
    let root = ((numer << (2 * bits)) / denom).sqrt();
    let (angle, pi) = (atan(root, bits), pi(bits));
    // atan x = π/2 − atan(1/x).
    let angle = if is_steep { &pi / 2 - angle } else { angle };
    BigRational::new(angle * 180, pi)
}

/// Returns atan x for 0 ≤ x ≤ 1. Numbers have the factor 2^`bits`.
fn atan(x: BigInt, bits: u64) -> BigInt {
    const HALVINGS: u32 = 4;
    let one = BigInt::one() << bits;
    let mut x = x;
    for _ in 0..HALVINGS {
        // tan(α/2) = tan α/(1 + √(1 + tan²α)).
        let root = (&one * &one + &x * &x).sqrt();
        x = (x << bits) / (&one + root);
    }
    series(&x, &one) << HALVINGS
}

/// Returns π from Machin's formula, 16 atan(1/5) − 4 atan(1/239).
fn pi(bits: u64) -> BigInt {
    let one = BigInt::one() << bits;
    series(&(&one / 5), &one) * 16 - series(&(&one / 239), &one) * 4
}

/// Returns the sum of the series x − x³/3 + x⁵/5 − …. Numbers have the factor `one`.
fn series(x: &BigInt, one: &BigInt) -> BigInt {
    let square = x * x / one;
    let (mut power, mut sum, mut n) = (x.clone(), BigInt::zero(), 1_u32);
    while power.sign() != Sign::NoSign {
        let term = &power / n;
        if n % 4 == 1 {
            sum += term;
        } else {
            sum -= term;
        }
        power = power * &square / one;
        n += 2;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    #[test]
    fn angles_are_correctly_rounded() {
        let of = |n, d| nearest_rational(&degrees(&ratio(n, d)), "an angle").unwrap();
        for (n, d, angle) in [
            (0, 1, 0.0),
            (1, 1, 45.0),
            (3, 1, 60.0),
            (1, 3, 30.0),
            // Half the tan of tetrahedra: asin(1/3).
            (1, 8, 19.471_220_634_490_69),
        ] {
            assert_eq!(of(n, d).to_bits(), f64::to_bits(angle), "{n}/{d}");
        }
    }

    #[test]
    fn angles_agree_with_the_float_function() {
        for n in 1..200_i32 {
            for d in [1, 7, 1000, 1_000_000_007] {
                let square = f64::from(n) / f64::from(d);
                let expected = square.sqrt().atan().to_degrees();
                let found = degrees(&ratio(n.into(), d.into()));
                let found = nearest_rational(&found, "an angle").unwrap();
                assert!((found / expected - 1.0).abs() < 1e-15, "{n}/{d}: {found}");
            }
        }
    }
}
