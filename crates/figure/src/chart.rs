//! Curves over an axis of numbers, each axis with its own scale.

use super::colour::{BLACK, Scale};
use super::glyph::{Glyph, Point, line, px, text};
use super::page::Axes;
use super::panel::{AXES, Panel};

/// The size of a chart, in units of its panel.
const SIZE: Point = [8.0, 5.0];

/// A frame in which curves are drawn.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    pub(super) panel: Panel,
    /// The least and the greatest number on each axis.
    ends: [[f64; 2]; 2],
}

impl Chart {
    pub(super) fn new(across: [f64; 2], upwards: [f64; 2]) -> Self {
        Self {
            panel: Panel::around([[0.0; 2], SIZE], 0.0, SIZE, AXES),
            ends: [across, upwards],
        }
    }

    /// Where a point of the chart is on the page.
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

    /// What curves mean: a line of its colour before each name, below each other in the upper right corner.
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

/// Colours for some curves in their order, from dark to bright, without the brightest, which is not seen on white.
pub(super) fn colours(count: usize) -> Vec<String> {
    const BRIGHTEST: f64 = 0.85;
    let scale = Scale::of([0.0, 1.0]);
    #[expect(clippy::cast_precision_loss, reason = "a few curves")]
    let part = |n: usize| n as f64 / (count.max(2) - 1) as f64;
    (0..count)
        .map(|n| scale.colour(part(n) * BRIGHTEST))
        .collect()
}
