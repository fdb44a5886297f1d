//! The float nearest to an exact value where a double-double decides it: nearly always.
//!
//! The value is enclosed between two double-doubles, 2⁻⁹⁰ apart. Rounding is monotone: if both ends round to one float,
//! so does the value, and nothing is left to decide. Else, once in 2³⁷ or at a tie, integers decide (`nearest`).

use num_bigint::BigUint;

use crate::DoubleDouble;
use crate::error_free::power_of_two;
#[cfg(feature = "std")]
use crate::error_free::two_product;

/// A double-double between 1/2 and 4, and the exponent of the power of two that it is multiplied by.
type Scaled = (DoubleDouble, i64);

/// Returns two floats that n/d·√r lies between, once they are multiplied by 2^e, and e; n, d and r are not zero. `None`
/// where a f64 or its neighbours would not be normal, and for a root without `std`.
pub(crate) fn enclose(n: &BigUint, d: &BigUint, r: Option<&BigUint>) -> Option<([f64; 2], i32)> {
    /// The errors of all steps together are below 2^−98.
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
    // Far from the ends of f64: what is rounded is not moved again by the power of two.
    let exponent = i32::try_from(exponent).ok();
    Some((ends, exponent.filter(|e| (-1000..1000).contains(e))?))
}

/// Returns the first 106 bits: what is dropped is below 2^−105 of the number.
fn leading(n: &BigUint) -> Option<Scaled> {
    const PART: u128 = (1 << 53) - 1;
    let mut top_down = n.iter_u64_digits().rev();
    let first = top_down.next()?;
    // Not a default: below the last digit of a number there are only zeros.
    let mut digit = || u128::from(top_down.next().unwrap_or(0));
    let (second, third) = (digit(), digit());
    let zeros = first.leading_zeros();
    let two = u128::from(first) << 64 | second;
    // At most 63 zeros.
    let bits = two << zeros | third >> (64 - zeros);
    let high = float(bits >> 75) * power_of_two(-52);
    let low = float(bits >> 22 & PART) * power_of_two(-105);
    let exponent = i64::try_from(n.bits()).ok()? - 1;
    Some((DoubleDouble::from_sum(high, low), exponent))
}

/// Returns at most 53 bits as a float: exact.
#[expect(
    clippy::cast_precision_loss,
    reason = "an f64 holds every integer of 53 bits, and what is given is cut to as many"
)]
fn float(bits: u128) -> f64 {
    bits as f64
}

/// Returns the root, by one step of Newton's method from that of the high part.
#[cfg(feature = "std")]
#[expect(clippy::unnecessary_wraps, reason = "there is none without std")]
fn root((x, exponent): Scaled) -> Option<Scaled> {
    // An even exponent, halved.
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
