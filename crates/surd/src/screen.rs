//! A double-double enclosure of an exact value, which decides most roundings without big integers.
//!
//! The value lies between two double-doubles whose relative distance is about 2⁻⁸⁹. Rounding is monotone:
//! if both ends round to the same float, so does the value. The ends round differently for about one value
//! in 2³⁷, and at every tie. Then integer arithmetic decides (see `nearest`).

use num_bigint::BigUint;

use crate::DoubleDouble;
use crate::error_free::power_of_two;
#[cfg(feature = "std")]
use crate::error_free::two_product;

/// A double-double between 1/2 and 4, and the exponent of a power of two by which it is multiplied.
type Scaled = (DoubleDouble, i64);

/// Returns two floats and an exponent e: (n/d)·√r lies between the floats times 2^e. n, d and r must not be
/// zero.
///
/// The result is `None` if an `f64` near the value is not normal, and for every root without the feature
/// `std`.
pub(crate) fn enclose(n: &BigUint, d: &BigUint, r: Option<&BigUint>) -> Option<([f64; 2], i32)> {
    /// The enclosure extends to 2^−90 of the value on each side. The rounding errors of all steps together are below
    /// 2^−98 of it.
    const SLACK: i32 = -90;
    let ((n, of_n), (d, of_d)) = (leading(n)?, leading(d)?);
    let (quotient, of_quotient) = (n.ordinary_quotient(&d), of_n - of_d);
    let (value, exponent) = match r {
        None => (quotient, of_quotient),
        Some(r) => {
            let (root, of_root) = root(leading(r)?)?;
            (quotient.ordinary_product(&root), of_quotient + of_root)
        }
    };
    let slack = value.high() * power_of_two(SLACK);
    let ends = [value.low() - slack, value.low() + slack].map(|low| value.high() + low);
    // The exponent is far from the limits of `f64`, so the multiplication by the power of two is exact.
    let exponent = i32::try_from(exponent).ok();
    Some((ends, exponent.filter(|e| (-1000..1000).contains(e))?))
}

/// Returns the first 106 bits. The dropped part is below 2^−105 of the number.
fn leading(n: &BigUint) -> Option<Scaled> {
    const PART: u128 = (1 << 53) - 1;
    let mut top_down = n.iter_u64_digits().rev();
    let first = top_down.next()?;
    // The missing digits of a short number are zeros, so 0 is exact.
    let mut digit = || u128::from(top_down.next().unwrap_or(0));
    let (second, third) = (digit(), digit());
    let zeros = first.leading_zeros();
    let two = u128::from(first) << 64 | second;
    // `zeros` is at most 63.
    let bits = two << zeros | third >> (64 - zeros);
    let high = float(bits >> 75) * power_of_two(-52);
    let low = float(bits >> 22 & PART) * power_of_two(-105);
    let exponent = i64::try_from(n.bits()).ok()? - 1;
    Some((DoubleDouble::from_sum(high, low), exponent))
}

/// Returns an integer of at most 53 bits as a float, exactly.
#[expect(
    clippy::cast_precision_loss,
    reason = "an f64 holds every integer of 53 bits"
)]
fn float(bits: u128) -> f64 {
    bits as f64
}

/// Returns the square root, by one Newton step from the root of the high part.
#[cfg(feature = "std")]
#[expect(
    clippy::unnecessary_wraps,
    reason = "the variant without std returns None"
)]
fn root((x, exponent): Scaled) -> Option<Scaled> {
    // The exponent is made even and then halved.
    let factor = if exponent % 2 == 0 { 1.0 } else { 2.0 };
    let (high, low) = (x.high() * factor, x.low() * factor);
    let root = high.sqrt();
    let (p, e) = two_product(root, root);
    let rest = ((high - p) - e) + low;
    let root = DoubleDouble::from_sum(root, rest / (2.0 * root));
    Some((root, exponent.div_euclid(2)))
}

/// Returns `None`: `core` has no square root.
#[cfg(not(feature = "std"))]
fn root(_: Scaled) -> Option<Scaled> {
    None
}
