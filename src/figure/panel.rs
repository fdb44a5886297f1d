//! A part of the page with one scale in both directions.

use super::mark::Point;

/// The width of the page, in pixels.
pub(super) const WIDTH: f64 = 800.0;

/// The greatest height of a panel, in pixels.
const HIGHEST: f64 = 640.0;

/// A box around points, u to the right and v upwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    least: Point,
    most: Point,
}

impl Bounds {
    /// Returns the box around discs of one radius; around the origin, if there is no disc.
    pub(super) fn around(centres: impl IntoIterator<Item = Point>, radius: f64) -> Self {
        let centres = centres.into_iter().map(|at| (at, at));
        let ends = centres.reduce(|(least, most), (at, _)| {
            (
                [0, 1].map(|n| least[n].min(at[n])),
                [0, 1].map(|n| most[n].max(at[n])),
            )
        });
        let (least, most) = ends.unwrap_or_default();
        Self {
            least: least.map(|end| end - radius),
            most: most.map(|end| end + radius),
        }
    }

    /// Returns a box about the same middle that is at least so wide and high: few spheres are not drawn huge.
    pub(super) fn at_least(self, width: f64, height: f64) -> Self {
        let [u, v] = self.size();
        let [u, v] = [width - u, height - v].map(|lacking| lacking.max(0.0) / 2.0);
        Self {
            least: [self.least[0] - u, self.least[1] - v],
            most: [self.most[0] + u, self.most[1] + v],
        }
    }

    fn size(&self) -> Point {
        [0, 1].map(|n| self.most[n] - self.least[n])
    }
}

/// The room around a panel, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Margins {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) below: f64,
}

impl Margins {
    /// For axes on the left and below.
    pub(super) const AXES: Self = Self {
        left: 74.0,
        right: 30.0,
        below: 60.0,
    };
    /// For these axes, and a bar of colours on the right.
    pub(super) const BAR: Self = Self {
        left: 74.0,
        right: 142.0,
        below: 60.0,
    };
}

/// A box on the page. The page begins at its upper edge, above which are the title and its like.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    pub(super) left: f64,
    /// Width and height, in pixels.
    pub(super) size: Point,
    least: Point,
    /// Pixels to a unit of length.
    scale: f64,
    /// How far down the page goes, in pixels.
    pub(super) page: f64,
}

impl Panel {
    /// Returns the box as large as fits the page, which is at least `lowest` pixels high.
    pub(super) fn new(bounds: Bounds, margins: Margins, lowest: f64) -> Self {
        let [width, height] = bounds.size();
        let room = WIDTH - margins.left - margins.right;
        let scale = (room / width).min(HIGHEST / height);
        let size = [width * scale, height * scale];
        Self {
            left: margins.left + (room - size[0]) / 2.0,
            size,
            least: bounds.least,
            scale,
            page: (size[1] + margins.below).max(lowest),
        }
    }

    /// Returns where the right edge is on the page.
    pub(super) fn right(&self) -> f64 {
        self.left + self.size[0]
    }

    /// Returns where the lower edge is on the page.
    pub(super) fn bottom(&self) -> f64 {
        self.size[1]
    }

    /// Returns where a point is on the page.
    pub(super) fn at(&self, [u, v]: Point) -> Point {
        [
            self.left + (u - self.least[0]) * self.scale,
            self.size[1] - (v - self.least[1]) * self.scale,
        ]
    }

    /// Returns how long a length is on the page.
    pub(super) fn length(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// Returns the ends of the panel, from left to right and from below to above.
    pub(super) fn ends(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|n| [self.least[n], self.least[n] + self.size[n] / self.scale])
    }
}
