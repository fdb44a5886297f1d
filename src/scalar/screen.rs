//! The float nearest to an exact value where a double-double tells it: nearly always.
//!
//! The value is enclosed between two double-doubles, 2⁻⁹⁰ apart. Rounding is monotone: if both ends round to one float,
//! so does the value, and nothing is left to decide. Else, once in 2³⁷ or at a tie, integers decide ([`nearest`](super::nearest)).

use num_bigint::BigUint;

use super::error_free::{fast_two_sum, power_of_two, two_product};

/// hi + lo, times 2^exponent; 1/2 < hi < 4, lo at most an ulp of it.
#[derive(Clone, Copy)]
struct Scaled {
    hi: f64,
    lo: f64,
    exponent: i64,
}

/// Two floats that n/d·√r lies between, once they are multiplied by 2^e, and e; n, d and r are not zero. `None` where a
/// f64 or its neighbours would not be normal, and for a root without `std`.
pub(super) fn enclose(n: &BigUint, d: &BigUint, r: Option<&BigUint>) -> Option<([f64; 2], i32)> {
    /// The errors of all steps together are below 2^−98.
    const SLACK: i32 = -90;
    let quotient = leading(n)?.over(leading(d)?);
    let value = match r {
        None => quotient,
        Some(r) => quotient.times(root(leading(r)?)?),
    };
    let slack = value.hi * power_of_two(SLACK);
    let ends = [value.lo - slack, value.lo + slack].map(|lo| value.hi + lo);
    // Far from the ends of f64: what is rounded is not moved again by the power of two.
    let exponent = i32::try_from(value.exponent).ok();
    Some((ends, exponent.filter(|e| (-1000..1000).contains(e))?))
}

/// The first 106 bits: what is dropped is below 2^−105 of the number.
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
    Some(Scaled {
        hi: float(bits >> 75) * power_of_two(-52),
        lo: float(bits >> 22 & PART) * power_of_two(-105),
        exponent: i64::try_from(n.bits()).ok()? - 1,
    })
}

/// At most 53 bits: exact.
#[expect(clippy::cast_precision_loss, reason = "there are no more bits")]
fn float(bits: u128) -> f64 {
    bits as f64
}

impl Scaled {
    fn normal((hi, lo): (f64, f64), exponent: i64) -> Self {
        let (hi, lo) = fast_two_sum(hi, lo);
        Self { hi, lo, exponent }
    }

    fn over(self, d: Self) -> Self {
        let quotient = self.hi / d.hi;
        let (p, e) = two_product(quotient, d.hi);
        let rest = ((self.hi - p) - e) + self.lo - quotient * d.lo;
        Self::normal((quotient, rest / d.hi), self.exponent - d.exponent)
    }

    fn times(self, other: Self) -> Self {
        let (p, e) = two_product(self.hi, other.hi);
        let lo = e + (self.hi * other.lo + self.lo * other.hi);
        Self::normal((p, lo), self.exponent + other.exponent)
    }
}

#[cfg(feature = "std")]
#[expect(clippy::unnecessary_wraps, reason = "there is none without std")]
fn root(x: Scaled) -> Option<Scaled> {
    // An even exponent, halved.
    let factor = if x.exponent % 2 == 0 { 1.0 } else { 2.0 };
    let (hi, lo) = (x.hi * factor, x.lo * factor);
    let root = hi.sqrt();
    let (p, e) = two_product(root, root);
    let rest = ((hi - p) - e) + lo;
    let exponent = x.exponent.div_euclid(2);
    Some(Scaled::normal((root, rest / (2.0 * root)), exponent))
}

/// `core` has no square root.
#[cfg(not(feature = "std"))]
fn root(_: Scaled) -> Option<Scaled> {
    None
}
