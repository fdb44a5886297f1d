//! Colour scales that are safe for colour-blind readers and for print.
//!
//! The maps are those of d3, from the crate `colorous`. *Viridis* by van der Walt, Smith and Firing is for values of one
//! sign. ColorBrewer's *RdBu* by Brewer is for values of both signs.

use colorous::{Color, RED_BLUE, VIRIDIS};

use super::ticks;

pub(super) const BLACK: &str = "#1a1a1a";
pub(super) const WHITE: &str = "#ffffff";
/// The colour of secondary text. It is legible on white.
pub(super) const DIM: &str = "#555555";
/// The colour of guide lines and frames.
pub(super) const GREY: &str = "#8a8a8a";
/// The colour of outlines of spheres.
pub(super) const PALE: &str = "#b9b9b9";
/// The colour of contacts, and of forces without a sign.
pub(super) const BLUE: &str = "#0b579f";
/// The colour of weights and loads.
pub(super) const ORANGE: &str = "#b84a00";
/// The colour of tensile forces, on the blue side of [`Scale`].
pub(super) const TENSION: &str = "#2166ac";
/// The colour of compressive forces, on the red side of [`Scale`].
pub(super) const COMPRESSION: &str = "#b2182b";

/// A colour scale for a range of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) least: f64,
    pub(super) most: f64,
    map: Map,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Map {
    /// From dark to bright.
    Rising,
    /// From near-white to dark on both sides of zero: blue below, red above.
    Diverging,
    /// As [`Diverging`](Self::Diverging), but without the palest colours, so that thin lines on white show their sign.
    Signed,
}

/// The fraction of the map on each side of zero that [`Map::Signed`] leaves out.
const PALEST: f64 = 0.3;

impl Scale {
    /// Returns a scale from the smallest to the largest value, or around zero if a value is negative.
    pub(super) fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let (least, most) = ends(values);
        let map = if least < 0.0 {
            Map::Diverging
        } else {
            Map::Rising
        };
        Self { least, most, map }
    }

    /// Returns a diverging scale that contains zero. It has a single side if no value lies on the other.
    pub(super) fn around_zero(values: impl IntoIterator<Item = f64>) -> Self {
        let (least, most) = ends(values);
        let (least, most, map) = (least.min(0.0), most.max(0.0), Map::Diverging);
        Self { least, most, map }
    }

    /// Returns a scale around zero for thin lines on white.
    pub(super) fn of_lines(values: impl IntoIterator<Item = f64>) -> Self {
        let map = Map::Signed;
        Self {
            map,
            ..Self::around_zero(values)
        }
    }

    /// Returns whether the colours distinguish negative from positive values.
    pub(super) fn is_around_zero(&self) -> bool {
        self.map != Map::Rising
    }

    /// Returns whether all values are equal, up to rounding.
    pub(super) fn is_uniform(&self) -> bool {
        !ticks::is_range(self.least, self.most)
    }

    /// Returns a value divided by the largest magnitude, or 0 if all values are 0.
    pub(super) fn part(&self, value: f64) -> f64 {
        let part = value / self.most.abs().max(self.least.abs());
        if part.is_finite() { part } else { 0.0 }
    }

    /// Returns the colour of a value, as `#rrggbb`.
    pub(super) fn colour(&self, value: f64) -> String {
        format!("#{:x}", self.mix(value))
    }

    /// Returns the text colour on the colour of a value: black or white, whichever has more contrast.
    pub(super) fn text_colour(&self, value: f64) -> &'static str {
        if luminance(self.mix(value)) > 0.18 {
            BLACK
        } else {
            WHITE
        }
    }

    fn mix(&self, value: f64) -> Color {
        if self.map == Map::Rising {
            // The difference of halves does not overflow.
            let part = (value / 2.0 - self.least / 2.0) / (self.most / 2.0 - self.least / 2.0);
            return VIRIDIS.eval_continuous(if self.is_uniform() {
                0.5
            } else {
                part.clamp(0.0, 1.0)
            });
        }
        let mut part = self.part(value).clamp(-1.0, 1.0);
        if self.map == Map::Signed && part != 0.0 {
            part = (PALEST + (1.0 - PALEST) * part.abs()).copysign(part);
        }
        RED_BLUE.eval_continuous(0.5 - part / 2.0)
    }
}

/// Returns the relative luminance of a colour, from 0 (black) to 1 (white): 0.2126 R + 0.7152 G + 0.0722 B in linear RGB.
fn luminance(Color { r, g, b }: Color) -> f64 {
    let [red, green, blue] = [r, g, b].map(|part| {
        let part = f64::from(part) / 255.0;
        if part <= 0.04045 {
            part / 12.92
        } else {
            ((part + 0.055) / 1.055).powf(2.4)
        }
    });
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// Returns the smallest and the largest value, or 0 and 0 if there are no values.
fn ends(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let ends = values.into_iter().map(|value| (value, value));
    let ends = ends.reduce(|(least, most), (value, _)| (least.min(value), most.max(value)));
    ends.unwrap_or((0.0, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(least: f64, most: f64) -> Vec<f64> {
        let step = |n| least + (most - least) * f64::from(n) / 100.0;
        (0..=100).map(step).collect()
    }

    fn brightness(scale: Scale, values: &[f64]) -> Vec<f64> {
        values.iter().map(|x| luminance(scale.mix(*x))).collect()
    }

    #[test]
    fn scales_are_monotone_and_even_about_zero() {
        // Near white a step of the scale is less than one byte, so rounding may reverse the order by this much.
        const BYTE: f64 = 0.002;
        let bright = brightness(Scale::of([2.0, 5.0]), &steps(2.0, 5.0));
        assert!(bright.is_sorted() && bright[0] < 0.1 && bright[100] > 0.7);
        for scale in [
            Scale::around_zero([-3.0, 3.0]),
            Scale::of_lines([-3.0, 3.0]),
        ] {
            assert!(brightness(scale, &steps(0.0, 3.0)).is_sorted_by(|a, b| a + BYTE >= *b));
            assert!(brightness(scale, &steps(-3.0, 0.0)).is_sorted_by(|a, b| *a <= b + BYTE));
            // The hue differs too: red for positive values, blue for negative ones.
            let (positive, negative) = (scale.mix(2.0), scale.mix(-2.0));
            assert!(positive.r > positive.b && negative.b > negative.r);
        }
    }

    #[test]
    fn ends_of_scales() {
        let ends = |scale: Scale| (scale.least, scale.most, scale.is_around_zero());
        assert_eq!(ends(Scale::of([3.0, -1.0, 2.0])), (-1.0, 3.0, true));
        assert_eq!(ends(Scale::of([5.0, 2.0])), (2.0, 5.0, false));
        assert_eq!(ends(Scale::of([])), (0.0, 0.0, false));
        assert_eq!(ends(Scale::around_zero([2.0, 5.0])), (0.0, 5.0, true));
        assert_eq!(ends(Scale::around_zero([-3.0, -1.0])), (-3.0, 0.0, true));
        assert_eq!(ends(Scale::of_lines([1.0, 2.0])), (0.0, 2.0, true));
        // Values that differ by rounding only count as equal.
        assert!(Scale::of([0.3, 0.1 + 0.2]).is_uniform());
        assert!(!Scale::of([0.3, 0.31]).is_uniform());
    }

    #[test]
    fn colours_of_scales() {
        let scale = Scale::of([0.0, 1.0]);
        assert_eq!([0.0, 1.0].map(|x| scale.colour(x)), ["#440154", "#fde725"]);
        // A single value has the middle colour.
        assert_eq!(Scale::of([4.0, 4.0]).colour(4.0), "#20908c");
        let scale = Scale::around_zero([-1.0, 3.0]);
        assert_eq!([-3.0, 3.0].map(|x| scale.colour(x)), ["#042f60", "#67001f"]);
        let (lines, areas) = (
            Scale::of_lines([-1.0, 2.0]),
            Scale::around_zero([-1.0, 2.0]),
        );
        assert!(luminance(lines.mix(0.1)) < luminance(areas.mix(0.1)));
        assert_eq!(lines.colour(2.0), areas.colour(2.0));
        // The extremes of f64, and empty lists.
        for values in [
            vec![],
            vec![0.0],
            vec![7.0; 3],
            vec![-f64::MAX, f64::MAX],
            vec![5e-324, 0.0],
        ] {
            let scale = Scale::of(values.clone());
            assert!(values.iter().all(|x| luminance(scale.mix(*x)).is_finite()));
        }
    }
}
