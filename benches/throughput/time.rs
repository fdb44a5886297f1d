//! Times and ratios of times.

use std::time::Instant;

/// Returns the time of a call in seconds.
pub(crate) fn seconds(run: impl FnOnce()) -> f64 {
    let begun = Instant::now();
    run();
    begun.elapsed().as_secs_f64()
}

/// Returns the median of `pairs` ratios of two times, measured alternately.
pub(crate) fn ratio(
    pairs: usize,
    mut one: impl FnMut() -> f64,
    mut other: impl FnMut() -> f64,
) -> f64 {
    median((0..pairs).map(|_| one() / other()))
}

/// Returns the median, or the upper one of two middle values.
pub(crate) fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
