//! Sums and products of floats together with their rounding errors, which are floats again.
//!
//! Without a fused multiply-add, which `core` does not have: Knuth's sum and Dekker's product.

/// (s, e) with s = fl(a + b) and s + e = a + b exactly, unless s overflows.
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let from_b = s - a;
    let from_a = s - from_b;
    (s, (a - from_a) + (b - from_b))
}

/// As [`two_sum`], for |a| ≥ |b| or a = 0.
pub(super) fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// (p, e) with p = fl(a b) and p + e = a b exactly, for factors below [`SPLIT_LIMIT`] in magnitude and
/// |p| ≥ [`PRODUCT_FLOOR`].
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    (p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2)
}

/// 2^960: multiplied by the splitting constant it is still finite.
pub(super) const SPLIT_LIMIT: f64 = f64::from_bits((960 + 1023) << 52);

/// 2^−900: all partial products of larger products are clear of underflow.
pub(super) const PRODUCT_FLOOR: f64 = f64::from_bits((1023 - 900) << 52);

/// Whether [`two_product`] is exact.
pub(super) fn splits(a: f64, b: f64) -> bool {
    a.abs() < SPLIT_LIMIT && b.abs() < SPLIT_LIMIT && (a * b).abs() >= PRODUCT_FLOOR
}

/// Veltkamp's splitting into two halves of at most 26 bits.
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a; // 2^27 + 1
    let high = c - (c - a);
    (high, a - high)
}
