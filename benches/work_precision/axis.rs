//! A linear axis with ticks where they are wanted.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};

/// An axis from one end to the other, in either direction.
pub(crate) struct Axis {
    pub(crate) ends: [f64; 2],
    pub(crate) ticks: Vec<f64>,
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    #[expect(clippy::cast_possible_truncation, reason = "a pixel of the page")]
    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let [first, last] = self.ends;
        let part = (value - first) / (last - first);
        limit.0 + (f64::from(limit.1 - limit.0) * part).round() as i32
    }

    /// All of them; there is no finer mesh.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.clone()
        }
    }

    fn range(&self) -> Range<f64> {
        self.ends[0]..self.ends[1]
    }
}
