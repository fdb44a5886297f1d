//! The drawing area of a figure, with the same scale in both directions.

use super::glyph::Point;

/// The width of the page, in pixels.
pub(super) const WIDTH: f64 = 800.0;

/// The largest height of a panel, in pixels.
const HIGHEST: f64 = 640.0;

/// The margins of a panel: left, right and below, in pixels.
pub(super) type Margins = [f64; 3];

/// The margins with axes on the left and below.
pub(super) const AXES: Margins = [74.0, 30.0, 60.0];

/// The margins with these axes, and a colour bar on the right.
pub(super) const BAR: Margins = [74.0, 142.0, 60.0];

/// A box on the page. Its upper edge has y = 0; the title is above it, at negative y.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    pub(super) left: f64,
    /// Width and height, in pixels.
    pub(super) size: Point,
    least: Point,
    /// The number of pixels in a unit of length.
    scale: f64,
    /// The lower end of the page, in pixels.
    pub(super) page: f64,
}

impl Panel {
    /// Returns a box around circles of one radius, as large as fits on the page.
    ///
    /// The box is at least as large as `at_least`, so that a few spheres are not drawn too large.
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
        // An empty box may be anywhere. Only its size counts.
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

    /// Returns the same box on a page whose lower end is at least `page`.
    pub(super) fn with_page_end(self, page: f64) -> Self {
        let page = self.page.max(page);
        Self { page, ..self }
    }

    /// Returns the x of the right edge on the page.
    pub(super) fn right(&self) -> f64 {
        self.left + self.size[0]
    }

    /// Returns the y of the lower edge on the page.
    pub(super) fn bottom(&self) -> f64 {
        self.size[1]
    }

    /// Returns the position of a point on the page.
    pub(super) fn at(&self, [u, v]: Point) -> Point {
        [
            self.left + (u - self.least[0]) * self.scale,
            self.size[1] - (v - self.least[1]) * self.scale,
        ]
    }

    /// Converts a length to pixels.
    pub(super) fn length(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// Returns the ends of the panel in units of length: left and right, lower and upper.
    pub(super) fn ends(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|n| [self.least[n], self.least[n] + self.size[n] / self.scale])
    }
}
