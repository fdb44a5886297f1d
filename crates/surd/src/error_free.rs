//! Error-free transformations: sums and products of floats together with their rounding errors, which are
//! floats again.
//!
//! `core` has no fused multiply-add, so the algorithms are Knuth's sum and Dekker's product.

/// Returns (s, e) with s = fl(a + b) and s + e = a + b exactly, unless s overflows or |b| is [`f64::MAX`].
#[must_use]
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let from_b = s - a;
    let from_a = s - from_b;
    (s, (a - from_a) + (b - from_b))
}

/// Returns the same as [`two_sum`], at half the cost, for |a| ≥ |b|, for a = 0, or if a is a multiple of the last bit of b.
#[must_use]
#[inline]
pub fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// Returns (p, e) with p = fl(a·b) and p + e = a·b exactly, for factors of moderate size ([`is_ordinary`]).
#[must_use]
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    (p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2)
}

/// Returns a as a sum of two halves of at most 26 bits each, by Veltkamp's splitting.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a; // 2^27 + 1
    let high = c - (c - a);
    (high, a - high)
}

/// Returns whether 2^−400 ≤ |a| < 2^400.
///
/// Products and quotients of two such numbers neither overflow nor underflow, and neither do their rounding
/// errors. So [`two_product`] is exact for them without scaling.
#[must_use]
#[inline]
pub fn is_ordinary(a: f64) -> bool {
    (power_of_two(-400)..power_of_two(400)).contains(&a.abs())
}

/// Returns (m, e) with a = m·2^e and 1 ≤ |m| < 2. Zero and values that are not finite are returned
/// unchanged, with e = 0.
#[must_use]
#[inline]
pub fn significand(a: f64) -> (f64, i32) {
    if a == 0.0 || !a.is_finite() {
        return (a, 0);
    }
    if a.abs() < f64::MIN_POSITIVE {
        let (m, e) = significand(a * power_of_two(64));
        return (m, e - 64);
    }
    let [first, second, ..] = a.to_be_bytes();
    let field = u16::from_be_bytes([first, second]) >> 4 & 0x7ff;
    let significand = a.to_bits() & !(0x7ff << 52) | (1023 << 52);
    (f64::from_bits(significand), i32::from(field) - 1023)
}

/// Returns 2^e for −1022 ≤ e ≤ 1023. An exponent outside this range is clamped to it.
#[must_use]
#[inline]
pub fn power_of_two(e: i32) -> f64 {
    // The documentation promises the clamping.
    let field = e.clamp(-1022, 1023) + 1023;
    f64::from_bits(u64::from(field.unsigned_abs()) << 52)
}

/// Returns a·2^e, with further roundings if the result is subnormal.
#[must_use]
#[inline]
pub fn scale(a: f64, e: i32) -> f64 {
    // One power of two cannot span the range from the smallest subnormal to the largest float. Three
    // factors can, and no intermediate result overflows before the final one.
    let (third, rest) = (e / 3, e - 2 * (e / 3));
    a * power_of_two(third) * power_of_two(third) * power_of_two(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Covers normal floats and the smallest and largest subnormals.
    #[test]
    fn significand_times_power_restores_float() {
        let least = f64::from_bits(1);
        let subnormal = f64::MIN_POSITIVE.next_down();
        for (a, parts) in [
            (1.0, (1.0, 0)),
            (-12.0, (-1.5, 3)),
            (f64::MAX, (2.0_f64.next_down(), 1023)),
            (f64::MIN_POSITIVE, (1.0, -1022)),
            (-3.0 * least, (-1.5, -1073)),
            (least, (1.0, -1074)),
            (0.0, (0.0, 0)),
            (f64::INFINITY, (f64::INFINITY, 0)),
        ] {
            assert_eq!(significand(a), parts, "{a:e}");
        }
        let (m, e) = significand(subnormal);
        assert!((1.0..2.0).contains(&m));
        assert_eq!((scale(m, e), e), (subnormal, -1023));
    }
}
