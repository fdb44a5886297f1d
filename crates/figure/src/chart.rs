//! A chart of curves, with its own scale on each axis.

use super::colour::{BLACK, Scale};
use super::glyph::{Glyph, Point, line, px, text};
use super::page::Axes;
use super::panel::{AXES, Panel};

/// The size of a chart, in units of its panel.
const SIZE: Point = [8.0, 5.0];

/// The frame of a chart.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    pub(super) panel: Panel,
    /// The values at both ends of each axis.
    ends: [[f64; 2]; 2],
}

impl Chart {
    pub(super) fn new(across: [f64; 2], upwards: [f64; 2]) -> Self {
        Self {
            panel: Panel::around([[0.0; 2], SIZE], 0.0, SIZE, AXES),
            ends: [across, upwards],
        }
    }

    /// Returns the position on the page of a point of the chart.
    pub(super) fn at(&self, point: Point) -> Point {
        self.panel.at([0, 1].map(|n| {
            let [least, most] = self.ends[n];
            (point[n] - least) / (most - least) * SIZE[n]
        }))
    }

    pub(super) fn axes(&self, names: [String; 2]) -> Axes {
        Axes {
            names,
            origin: self.ends.map(|[least, _]| least),
            unit: [0, 1].map(|n| (self.ends[n][1] - self.ends[n][0]) / SIZE[n]),
        }
    }

    pub(super) fn curve(&self, points: impl IntoIterator<Item = Point>, colour: &str) -> Glyph {
        let points = points.into_iter().map(|point| {
            let [x, y] = self.at(point);
            format!("{},{}", px(x), px(y))
        });
        let points: Vec<String> = points.collect();
        let curve = Glyph::new("polyline").class("curve").fill("none");
        let curve = curve.set("points", points.join(" "));
        curve.stroke(colour, 2.0).set("stroke-linejoin", "round")
    }

    /// Returns the legend, in the upper right corner: a coloured line and a name for each curve.
    pub(super) fn legend(&self, names: impl IntoIterator<Item = (String, String)>) -> Vec<Glyph> {
        let right = self.panel.right();
        let mut y = 20.0;
        let mut glyphs = Vec::new();
        for (name, colour) in names {
            glyphs.push(line([right - 190.0, y], [right - 160.0, y], colour, 2.0));
            glyphs.push(text([right - 152.0, y], 14.0, name).start().fill(BLACK));
            y += 20.0;
        }
        glyphs
    }
}

/// Returns the ends of a range that contains 0 and all values.
pub(super) fn around_zero(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let ends = |[least, most]: [f64; 2], value: f64| [least.min(value), most.max(value)];
    values.into_iter().fold([0.0; 2], ends)
}

/// Returns colours for a number of curves, from dark to bright. The brightest ones are left out, for contrast with white.
pub(super) fn colours(count: usize) -> Vec<String> {
    const BRIGHTEST: f64 = 0.85;
    let scale = Scale::of([0.0, 1.0]);
    #[expect(clippy::cast_precision_loss, reason = "a few curves")]
    let part = |n: usize| n as f64 / (count.max(2) - 1) as f64;
    (0..count)
        .map(|n| scale.colour(part(n) * BRIGHTEST))
        .collect()
}
