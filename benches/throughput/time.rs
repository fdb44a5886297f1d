//! Time, and ratios of times.

use std::time::Instant;

/// The seconds that something takes.
pub(crate) fn seconds(run: impl FnOnce()) -> f64 {
    let begun = Instant::now();
    run();
    begun.elapsed().as_secs_f64()
}

/// The median of `pairs` ratios of two times, measured in turn.
pub(crate) fn ratio(
    pairs: usize,
    mut one: impl FnMut() -> f64,
    mut other: impl FnMut() -> f64,
) -> f64 {
    median((0..pairs).map(|_| one() / other()))
}

/// The one in the middle, or the upper of two.
pub(crate) fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
