//! Correct rounding of rationals and square roots to binary floats (to nearest, ties to even).
//!
//! A rational n/d, or a root √(n/d), is scaled by a power of two until its integer part has a few bits more
//! than the significand of the float. One *sticky* bit records whether the fractional part is zero. The
//! integer part and the sticky bit determine the rounding, also for subnormals and for zero.
//!
//! Example: 1/3 in a format of 2 bits. Scaled by 2^6 it is 21 + 1/3, so the integer part is 10101 in binary
//! and the sticky bit is 1. The first dropped bit is 1 and the rest is not zero, so the result is 11·2^−3 =
//! 3/8.
//!
//! A faster test comes first: a double-double enclosure decides most roundings without big integers (see
//! `screen`).

use num_bigint::BigUint;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use crate::DoubleDouble;
use crate::error_free::{fast_two_sum, power_of_two};
use crate::screen::enclose;

/// A binary floating-point format to round to: `f32`, `f64`, with the feature `half` also `half::f16` and `half::bf16`, or a
/// format of your own.
///
/// Rounding is to nearest, ties to even, in one step. Rounding to `f64` first and then to a shorter format can give
/// another float.
///
/// # Examples
/// The eight-bit format E4M3, whose greatest float is 448 and which has no infinity:
/// ```
/// use exact_surd::{CorrectlyRounded, Surd};
///
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// struct E4M3(u8);
///
/// impl CorrectlyRounded for E4M3 {
///     const PRECISION: u32 = 4;
///     const MIN_EXPONENT: i64 = -9;
///
///     fn from_parts(negative: bool, significand: u64, exponent: i64) -> Option<Self> {
///         let biased = if significand < 8 { 0 } else { exponent + 10 };
///         let bits = (u8::try_from(biased).ok()?.checked_mul(8)?) + u8::try_from(significand % 8).ok()?;
///         (bits < 0x7f).then_some(Self(bits | u8::from(negative) << 7))
///     }
/// }
///
/// // 4/3·√2 = 1.886 is between 1.875 and 2.
/// let root: Surd = "4/3*sqrt(2)".parse()?;
/// assert_eq!(root.nearest(), Some(E4M3(0b0_0111_111)));
/// assert_eq!("465".parse::<Surd>()?.nearest::<E4M3>(), None);
/// # Ok::<(), exact_surd::Error>(())
/// ```
pub trait CorrectlyRounded: Copy + Send + Sync {
    /// The number of bits of the significand, including the leading bit: 2 to 63.
    const PRECISION: u32;

    /// The exponent of the last bit of a subnormal: the smallest positive float is 2 to this power.
    const MIN_EXPONENT: i64;

    /// Returns the float ±`significand`·2^`exponent`, or `None` if it overflows. Other parts than these may give `None` too.
    ///
    /// The significand is below 2^[`PRECISION`](Self::PRECISION). The exponent is at least
    /// [`MIN_EXPONENT`](Self::MIN_EXPONENT), and equal to it if the significand has fewer bits than `PRECISION`.
    fn from_parts(negative: bool, significand: u64, exponent: i64) -> Option<Self>;

    /// Returns the common rounding of all numbers between `ends[0]`·2^`exponent` and `ends[1]`·2^`exponent`, or `None` if it
    /// is not known whether both ends round to the same float.
    #[doc(hidden)]
    #[must_use]
    fn between(negative: bool, ends: [f64; 2], exponent: i32) -> Option<Self> {
        let _ = (negative, ends, exponent);
        None
    }

    /// Returns the float nearest to `r`, ties to even, or `None` if it overflows.
    ///
    /// # Examples
    /// ```
    /// use exact_surd::CorrectlyRounded;
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

impl DoubleDouble {
    /// Returns `r` rounded to a double-double, or not-a-number if `r` overflows an `f64`. The relative error is at most
    /// 2^−106 for 2^−900 ≤ |r| ≤ [`f64::MAX`].
    ///
    /// # Examples
    /// ```
    /// use exact_surd::DoubleDouble;
    /// use num_rational::BigRational;
    ///
    /// let tenth = DoubleDouble::from_rational(&BigRational::new(1.into(), 10.into()));
    /// assert_eq!((tenth.high(), tenth.low()), (0.1, -5.551115123125783e-18));
    /// ```
    #[must_use]
    pub fn from_rational(r: &BigRational) -> Self {
        let parts = || {
            let high = f64::nearest_to_rational(r)?;
            let rest = r - BigRational::from_float(high)?;
            let low = f64::nearest_to_rational(&rest)?;
            Some(Self::finite(fast_two_sum(high, low), high))
        };
        // The value overflows an `f64`.
        parts().unwrap_or_else(|| Self::new(f64::NAN))
    }
}

/// Returns the float nearest to ±n/d, or `None` if it overflows. d must not be zero.
pub(crate) fn nearest_ratio<F: CorrectlyRounded>(
    negative: bool,
    n: &BigUint,
    d: &BigUint,
) -> Option<F> {
    let scale = guard_bits::<F>() - (bits(n) - bits(d));
    let (quotient, remainder) = shifted_quotient(n, d, scale);
    round(negative, &quotient, !remainder.is_zero(), -scale)
}

/// Returns the float nearest to ±√(n/d), or `None` if it overflows. d must not be zero.
///
/// The root must be irrational, so that no tie can occur.
pub(crate) fn nearest_root<F: CorrectlyRounded>(
    negative: bool,
    n: &BigUint,
    d: &BigUint,
) -> Option<F> {
    // ⌊√(2^(2s) n/d)⌋ = ⌊√⌊2^(2s) n/d⌋⌋, so one integer division and one integer square root suffice.
    let scale = guard_bits::<F>() - (bits(n) - bits(d)).div_euclid(2);
    let (quotient, _) = shifted_quotient(n, d, 2 * scale);
    let sticky = true;
    round(negative, &quotient.sqrt(), sticky, -scale)
}

/// Returns the float nearest to ±(n/d)·√r if the double-double enclosure decides it. d must not be zero.
pub(crate) fn screened<F: CorrectlyRounded>(
    negative: bool,
    n: &BigUint,
    d: &BigUint,
    r: Option<&BigUint>,
) -> Option<F> {
    let (ends, exponent) = enclose(n, d, r)?;
    F::between(negative, ends, exponent)
}

/// Returns the common rounding of both `ends` times 2^`exponent`, or `None` if they round differently.
///
/// Both ends must lie between 2^−20 and 2^20. The result is also `None` if an `f64` near the ends is not
/// normal.
#[doc(hidden)]
#[must_use]
pub fn float_between<F: CorrectlyRounded>(
    negative: bool,
    ends: [f64; 2],
    exponent: i64,
) -> Option<F> {
    let exponent = i32::try_from(exponent).ok()?;
    let normal = (-1000..1000).contains(&exponent);
    normal
        .then(|| F::between(negative, ends, exponent))
        .flatten()
}

macro_rules! correctly_rounded {
    ($float:ty, $bits:ty $(, $ends:expr)?) => {
        impl CorrectlyRounded for $float {
            const PRECISION: u32 = <$float>::MANTISSA_DIGITS;
            const MIN_EXPONENT: i64 = <$float>::MIN_EXP as i64 - <$float>::MANTISSA_DIGITS as i64;

            fn from_parts(negative: bool, significand: u64, exponent: i64) -> Option<Self> {
                let hidden = 1_u64 << (Self::PRECISION - 1);
                let above_least = exponent.checked_sub(Self::MIN_EXPONENT)?;
                if significand >= 2 * hidden || above_least < 0 || (significand < hidden && above_least > 0) {
                    return None;
                }
                // Without the hidden bit the value is subnormal, and its biased exponent is 0.
                let biased = if significand < hidden { 0 } else { above_least.checked_add(1)? };
                let largest = i64::from(<$float>::MAX_EXP) - i64::from(<$float>::MIN_EXP) + 1;
                if biased > largest {
                    return None;
                }
                let field = <$bits>::try_from(biased).ok()? << (Self::PRECISION - 1);
                let magnitude = field | <$bits>::try_from(significand & (hidden - 1)).ok()?;
                let float = <$float>::from_bits(magnitude);
                Some(if negative { -float } else { float })
            }

            $(
                #[expect(clippy::float_cmp, reason = "the test is for identical floats")]
                fn between(negative: bool, ends: [f64; 2], exponent: i32) -> Option<Self> {
                    let [down, up] = $ends(ends, exponent);
                    (down == up && up.is_finite()).then(|| if negative { -down } else { down })
                }
            )?
        }
    };
}

correctly_rounded!(f32, u32, ends_in_f32);
correctly_rounded!(f64, u64, ends_in_f64);
#[cfg(feature = "half")]
correctly_rounded!(half::f16, u16);
#[cfg(feature = "half")]
correctly_rounded!(half::bf16, u16);

/// Returns the ends times a power of two. The ends are `f64` already, and the multiplication is exact.
fn ends_in_f64(ends: [f64; 2], exponent: i32) -> [f64; 2] {
    ends.map(|end| end * power_of_two(exponent))
}

/// Returns the ends times a power of two, rounded to `f32`. Each `f64` end is first moved outwards by one
/// float, which makes double rounding harmless.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the rounded value is compared with that of the other end"
)]
fn ends_in_f32([down, up]: [f64; 2], exponent: i32) -> [f32; 2] {
    [down.next_down(), up.next_up()].map(|end| (end * power_of_two(exponent)) as f32)
}

/// Returns the number of bits to compute: those of the significand and three guard bits.
fn guard_bits<F: CorrectlyRounded>() -> i64 {
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

/// Returns quotient and remainder of 2^`shift` · n / d. For a negative shift, d is scaled instead.
fn shifted_quotient(n: &BigUint, d: &BigUint, shift: i64) -> (BigUint, BigUint) {
    if shift >= 0 {
        (n << shift).div_rem(d)
    } else {
        n.div_rem(&(d << -shift))
    }
}

/// Rounds ±(m + ε) · 2^exponent, where 0 ≤ ε < 1, and `sticky` is true if ε > 0.
///
/// If `sticky` is true, m must have at least two bits more than the significand.
fn round<F: CorrectlyRounded>(
    negative: bool,
    m: &BigUint,
    sticky: bool,
    exponent: i64,
) -> Option<F> {
    const { assert!(F::PRECISION >= 2 && F::PRECISION <= 63) };
    if m.is_zero() && !sticky {
        return F::from_parts(false, 0, F::MIN_EXPONENT);
    }
    let last_bit = (bits(m) + exponent - i64::from(F::PRECISION)).max(F::MIN_EXPONENT);
    let dropped = last_bit - exponent;
    let Ok(dropped @ 1..) = u64::try_from(dropped) else {
        // All bits are kept, with zeros appended.
        let significand = (m << -dropped).to_u64()?;
        return F::from_parts(negative, significand, last_bit);
    };
    let kept = (m >> dropped).to_u64()?;
    let half = m.bit(dropped - 1);
    let below_half = sticky || m.trailing_zeros().is_some_and(|zeros| zeros < dropped - 1);
    let up = half && (below_half || kept % 2 == 1);
    let (significand, carried) = (kept + u64::from(up), 1 << F::PRECISION);
    if significand == carried {
        return F::from_parts(negative, carried / 2, last_bit + 1);
    }
    F::from_parts(negative, significand, last_bit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_integers_are_exact() {
        let rounded = |n: u32, exponent| round::<f64>(false, &n.into(), false, exponent);
        assert_eq!(
            [rounded(5, 0), rounded(5, -1), rounded(1, 1023)],
            [5.0, 2.5, power_of_two(1023)].map(Some)
        );
        assert_eq!(rounded(1, 1024), None);
        let zero = round::<f64>(true, &BigUint::ZERO, false, 0);
        assert_eq!(zero.map(f64::to_bits), Some(0));
    }

    /// The significands have 53 and 24 bits.
    #[test]
    fn significand_has_three_guard_bits() {
        assert_eq!((guard_bits::<f64>(), guard_bits::<f32>()), (56, 27));
    }

    /// Exponents near the ends of the range give `None`, because the floats there are not normal.
    #[test]
    fn equal_roundings_of_ends_decide() {
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
