//! A part of the page with one scale in both directions.

use super::glyph::Point;

/// The width of the page, in pixels.
pub(super) const WIDTH: f64 = 800.0;

/// The greatest height of a panel, in pixels.
const HIGHEST: f64 = 640.0;

/// The room to the left of a panel, to the right and below, in pixels.
pub(super) type Margins = [f64; 3];

/// For axes on the left and below.
pub(super) const AXES: Margins = [74.0, 30.0, 60.0];

/// For these axes, and a bar of colours on the right.
pub(super) const BAR: Margins = [74.0, 142.0, 60.0];

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
    /// Returns a box around discs of one radius, as large as fits the page.
    ///
    /// It is at least so wide and high, about the same middle: few spheres are not drawn huge.
    pub(super) fn around(
        centres: impl IntoIterator<Item = Point>,
        radius: f64,
        at_least: Point,
        [left, right, below]: Margins,
    ) -> Self {
        let centres = centres.into_iter().map(|at| (at, at));
        let ends = centres.reduce(|(least, most), (at, _)| {
            let end = |n: usize| (least[n].min(at[n]), most[n].max(at[n]));
            let (u, v) = (end(0), end(1));
            ([u.0, v.0], [u.1, v.1])
        });
        // Not a default: of a box around nothing only the size counts, wherever it is.
        let (least, most) = ends.unwrap_or_default();
        let lengths = [0, 1].map(|n| (most[n] - least[n] + 2.0 * radius).max(at_least[n]));
        let least = [0, 1].map(|n| (least[n] + most[n] - lengths[n]) / 2.0);
        let room = WIDTH - left - right;
        let scale = (room / lengths[0]).min(HIGHEST / lengths[1]);
        let size = lengths.map(|length| length * scale);
        Self {
            left: left + (room - size[0]) / 2.0,
            size,
            least,
            scale,
            page: size[1] + below,
        }
    }

    /// Returns the same box on a page that goes down at least so far.
    pub(super) fn lowest(self, page: f64) -> Self {
        let page = self.page.max(page);
        Self { page, ..self }
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
