//! The float nearest to an exact value: decided in integers, never guessed.
//!
//! A rational n/d, and a root √(n/d), are scaled by a power of two until their integer part has a
//! few bits more than the float. What lies below that integer part is summed up in one *sticky* bit:
//! is it zero or not? Together they decide every rounding, ties to even, through the subnormals
//! down to zero. In front of that is a screen of double-doubles, which decides most of them at once.

use num_bigint::BigUint;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

mod sealed {
    pub trait Assemble: Sized {
        /// Returns the float ±`significand` · 2^`exponent`, for a significand of at most one bit more than the float
        /// has, and an exponent not below the least: `None` when it is too large.
        fn assemble(negative: bool, significand: u64, exponent: i64) -> Option<Self>;

        /// Returns the float that all numbers between these, times 2^`exponent`, are nearest to, if there is one.
        fn between(negative: bool, ends: [f64; 2], exponent: i32) -> Option<Self>;
    }
}

use crate::error_free::power_of_two;
use crate::screen::enclose;
use sealed::Assemble;

/// A binary floating-point format to round to: `f32` or `f64`. Sealed.
///
/// `f32` is reached directly, never by way of `f64`: rounding twice can miss the nearest.
pub trait NearestFloat: Assemble + Copy + Send + Sync {
    /// Bits of the significand, the leading one included.
    const PRECISION: u32;

    /// The exponent of the last bit of the smallest subnormal.
    const LEAST_EXPONENT: i64;

    /// Returns the float nearest to `r`, ties to even; `None` when it would be infinite.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::NearestFloat;
    /// use num_rational::BigRational;
    ///
    /// let third = BigRational::new(1.into(), 3.into());
    /// assert_eq!(f64::nearest_to_rational(&third), Some(1.0 / 3.0));
    /// assert_eq!(f32::nearest_to_rational(&third), Some(1.0 / 3.0));
    /// ```
    #[must_use]
    fn nearest_to_rational(r: &BigRational) -> Option<Self> {
        let negative = r.is_negative();
        let (n, d) = (r.numer().magnitude(), r.denom().magnitude());
        screened(negative, n, d, None).or_else(|| nearest_ratio(negative, n, d))
    }
}

/// Returns the float nearest to ±n/d; `None` when it would be infinite. d is not zero.
pub(crate) fn nearest_ratio<F: NearestFloat>(
    negative: bool,
    n: &BigUint,
    d: &BigUint,
) -> Option<F> {
    let scale = guard_bits::<F>() - (bits(n) - bits(d));
    let (quotient, remainder) = shifted_quotient(n, d, scale);
    round(negative, &quotient, !remainder.is_zero(), -scale)
}

/// Returns the float nearest to ±√(n/d), which must be irrational, so that there are no ties; `None` when it would be
/// infinite. d is not zero.
pub(crate) fn nearest_root<F: NearestFloat>(negative: bool, n: &BigUint, d: &BigUint) -> Option<F> {
    // ⌊√(2^(2s) n/d)⌋ = ⌊√⌊2^(2s) n/d⌋⌋: one integer division, one integer root.
    let scale = guard_bits::<F>() - (bits(n) - bits(d)).div_euclid(2);
    let (quotient, _) = shifted_quotient(n, d, 2 * scale);
    let sticky = true;
    round(negative, &quotient.sqrt(), sticky, -scale)
}

/// Returns the float nearest to ±(n/d)·√r, where the screen decides it; d is not zero.
pub(crate) fn screened<F: NearestFloat>(
    negative: bool,
    n: &BigUint,
    d: &BigUint,
    r: Option<&BigUint>,
) -> Option<F> {
    let (ends, exponent) = enclose(n, d, r)?;
    F::between(negative, ends, exponent)
}

/// Returns the float that both ends round to once they are multiplied by 2^exponent, if it is one; they lie between 2^−20 and
/// 2^20. `None` where a f64 or its neighbours would not be normal.
#[doc(hidden)]
#[must_use]
pub fn float_between<F: NearestFloat>(negative: bool, ends: [f64; 2], exponent: i64) -> Option<F> {
    let exponent = i32::try_from(exponent).ok()?;
    let normal = (-1000..1000).contains(&exponent);
    normal
        .then(|| F::between(negative, ends, exponent))
        .flatten()
}

macro_rules! nearest_float {
    ($float:ident, $bits:ident, $ends:expr) => {
        impl NearestFloat for $float {
            const PRECISION: u32 = $float::MANTISSA_DIGITS;
            const LEAST_EXPONENT: i64 = $float::MIN_EXP as i64 - $float::MANTISSA_DIGITS as i64;
        }

        impl Assemble for $float {
            fn assemble(negative: bool, significand: u64, exponent: i64) -> Option<Self> {
                let hidden = 1_u64 << (Self::PRECISION - 1);
                // Rounding up may have carried into one bit more than there are.
                let (significand, exponent) = if significand == 2 * hidden {
                    (hidden, exponent.saturating_add(1))
                } else {
                    (significand, exponent)
                };
                // Without the hidden bit the value is subnormal, and its exponent the least.
                let biased = if significand < hidden {
                    0
                } else {
                    exponent
                        .saturating_sub(Self::LEAST_EXPONENT)
                        .saturating_add(1)
                };
                let largest = i64::from($float::MAX_EXP) - i64::from($float::MIN_EXP) + 1;
                if biased > largest {
                    return None;
                }
                let field = $bits::try_from(biased).ok()? << (Self::PRECISION - 1);
                let magnitude = field | $bits::try_from(significand & (hidden - 1)).ok()?;
                let float = $float::from_bits(magnitude);
                Some(if negative { -float } else { float })
            }

            #[expect(clippy::float_cmp, reason = "one and the same float is meant")]
            fn between(negative: bool, ends: [f64; 2], exponent: i32) -> Option<Self> {
                let [down, up] = $ends(ends, exponent);
                (down == up && up.is_finite()).then(|| if negative { -down } else { down })
            }
        }
    };
}

nearest_float!(f32, u32, ends_in_f32);
nearest_float!(f64, u64, ends_in_f64);

/// Returns the ends times a power of two: both are rounded to f64 already, and the power is exact.
fn ends_in_f64(ends: [f64; 2], exponent: i32) -> [f64; 2] {
    ends.map(|end| end * power_of_two(exponent))
}

/// Returns the ends times a power of two, in `f32`. Never rounded twice: those in f64 are taken one float further out.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounded, and compared with the other end"
)]
fn ends_in_f32([down, up]: [f64; 2], exponent: i32) -> [f32; 2] {
    [down.next_down(), up.next_up()].map(|end| (end * power_of_two(exponent)) as f32)
}

/// Returns how many bits of a value are computed: enough for the significand, the half and some more.
fn guard_bits<F: NearestFloat>() -> i64 {
    i64::from(F::PRECISION) + 3
}

/// Returns the bit length as a signed number.
#[expect(
    clippy::cast_possible_wrap,
    reason = "2^63 bits are more than any memory holds"
)]
fn bits(n: &BigUint) -> i64 {
    n.bits() as i64
}

/// Returns quotient and remainder of 2^`shift` · n / d, with d scaled instead where the shift is negative.
fn shifted_quotient(n: &BigUint, d: &BigUint, shift: i64) -> (BigUint, BigUint) {
    if shift >= 0 {
        (n << shift).div_rem(d)
    } else {
        n.div_rem(&(d << -shift))
    }
}

/// Rounds ±(m + ε) · 2^exponent, where 0 ≤ ε < 1 and `sticky` says whether ε > 0.
///
/// A sticky value must come with at least two bits more than the significand has.
fn round<F: NearestFloat>(negative: bool, m: &BigUint, sticky: bool, exponent: i64) -> Option<F> {
    if m.is_zero() && !sticky {
        return F::assemble(false, 0, F::LEAST_EXPONENT);
    }
    let last_bit = (bits(m) + exponent - i64::from(F::PRECISION)).max(F::LEAST_EXPONENT);
    let dropped = last_bit - exponent;
    let Ok(dropped @ 1..) = u64::try_from(dropped) else {
        // All bits are kept, and some zeros appended.
        let significand = (m << -dropped).to_u64()?;
        return F::assemble(negative, significand, last_bit);
    };
    let kept = (m >> dropped).to_u64()?;
    let half = m.bit(dropped - 1);
    let below_half = sticky || m.trailing_zeros().is_some_and(|zeros| zeros < dropped - 1);
    let up = half && (below_half || kept % 2 == 1);
    F::assemble(negative, kept + u64::from(up), last_bit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_fewer_bits_than_a_float_is_kept_whole() {
        let rounded = |n: u32, exponent| round::<f64>(false, &n.into(), false, exponent);
        assert_eq!(
            [rounded(5, 0), rounded(5, -1), rounded(1, 1023)],
            [5.0, 2.5, power_of_two(1023)].map(Some)
        );
        assert_eq!(rounded(1, 1024), None);
        let zero = round::<f64>(true, &BigUint::ZERO, false, 0);
        assert_eq!(zero.map(f64::to_bits), Some(0));
    }

    /// A half and two bits more.
    #[test]
    fn three_bits_guard_a_significand() {
        assert_eq!((guard_bits::<f64>(), guard_bits::<f32>()), (56, 27));
    }

    /// Not at the ends of the exponents, where floats are not normal.
    #[test]
    fn ends_that_round_to_one_float_decide_it() {
        let between = |ends, exponent| float_between::<f64>(false, ends, exponent);
        assert_eq!(between([1.0, 1.0], 0), Some(1.0));
        assert_eq!(between([1.5, 1.5], -3), Some(0.1875));
        assert_eq!(between([1.0, 1.0_f64.next_up()], 0), None);
        assert_eq!(
            float_between(true, [1.0, 1.0_f64.next_up()], 0),
            Some(-1.0_f32)
        );
        for exponent in [-1001, 1000, i64::MIN, i64::MAX] {
            assert_eq!(between([1.0, 1.0], exponent), None);
        }
    }
}
