//! A layer seen from above: x points to the right and y upwards. Discs lie along x.

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;

use super::caption::readable;
use super::glyph::Point;
use super::page::Axes;
use super::panel::{Margins, Panel};
use super::subject::Subject;
use crate::Error;

/// The positions of the spheres of a layer, in R, relative to the first one.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    /// The sites and positions, in row order.
    pub(super) spheres: Vec<(Site, Point)>,
    /// The steps i → i+1 and j → j+1.
    pub(super) steps: [Point; 2],
    discs: bool,
}

impl Layer {
    /// Returns layer `k`, if it has at most `limit` spheres.
    pub(super) fn new(
        subject: &Subject<'_>,
        k: i128,
        limit: u32,
        remedy: &'static str,
    ) -> Result<Self, Error> {
        let pile = subject.pile();
        let count = pile.shape().layer(k)?.site_count();
        if k == pile.layers() - 1 {
            readable(&count, limit, "bottom spheres", remedy)?;
        } else {
            readable(&count, limit, "spheres of a layer", remedy)?;
        }
        let mut layer = Self {
            spheres: Vec::new(),
            steps: subject.steps()?,
            discs: subject.is_of_discs(),
        };
        for site in pile.rows(Selection::Layer(k))?.flatten() {
            let at = layer.place(subject, site)?;
            layer.spheres.push((site, at));
        }
        Ok(layer)
    }

    /// Returns the position of a sphere of any layer, seen from above.
    pub(super) fn place(&self, subject: &Subject<'_>, site: Site) -> Result<Point, Error> {
        let origin = self.spheres.first().map_or(site, |(first, _)| *first);
        let [x, y, _] = subject.from(origin, site)?;
        Ok([x, y])
    }

    /// Returns the distance between neighbours in a row, in R.
    pub(super) fn apart(&self) -> f64 {
        let [[u, v], _] = self.steps;
        u.hypot(v)
    }

    /// Returns a panel of a minimum size around the spheres, with a margin in R.
    pub(super) fn panel(&self, margin: f64, margins: Margins) -> Panel {
        let centres = self.spheres.iter().map(|(_, at)| *at);
        let height = if self.discs { 4.0 } else { 8.0 };
        Panel::around(centres, margin, [10.0, height], margins)
    }

    /// Returns the axes x and y. Discs have no axis y.
    pub(super) fn axes(&self, subject: &Subject<'_>) -> Result<Axes, Error> {
        let mut origin = [0.0; 2];
        if let Some((first, _)) = self.spheres.first() {
            let [x, y, _] = subject.position(*first)?;
            origin = [x, y];
        }
        let unit = subject.length_unit();
        let y = if self.discs {
            String::new()
        } else {
            format!("y in {unit}")
        };
        Ok(Axes {
            names: [format!("x in {unit}"), y],
            origin,
            unit: [subject.radius()?; 2],
        })
    }

    /// Returns the corners of the cell around a position. The cells tile the plane.
    ///
    /// On an equilateral base the cell is a regular hexagon. The cell of a disc is a rectangle.
    pub(super) fn cell(&self, panel: &Panel, [u, v]: Point) -> Vec<Point> {
        const HEXAGON: [Point; 6] = [
            [1.0, 1.0],
            [-1.0, 2.0],
            [-2.0, 1.0],
            [-1.0, -1.0],
            [1.0, -2.0],
            [2.0, -1.0],
        ];
        if self.discs {
            let half = self.apart() / 2.0;
            let strip = [[-half, -1.0], [half, -1.0], [half, 1.0], [-half, 1.0]];
            return strip.map(|[a, b]| panel.at([u + a, v + b])).to_vec();
        }
        let [i, j] = self.steps;
        let corner = |[a, b]: Point| {
            let [x, y] = [0, 1].map(|n| (a * i[n] + b * j[n]) / 3.0);
            panel.at([u + x, v + y])
        };
        HEXAGON.map(corner).to_vec()
    }

    /// Returns the corners of the upper and of the lower half of the cell of a sphere.
    pub(super) fn halves(&self, panel: &Panel, at: Point) -> [Vec<Point>; 2] {
        let corners = self.cell(panel, at);
        let of = |corners_of_half: &[usize]| {
            let corners = corners_of_half.iter().filter_map(|n| corners.get(*n));
            corners.copied().collect::<Vec<_>>()
        };
        if self.discs {
            let [left, right] = [0, 1].map(|n| {
                let [[x, low], [_, high]] = [corners[n], corners[3 - n]];
                [x, low.midpoint(high)]
            });
            let [mut upper, mut lower] = [of(&[2, 3]), of(&[0, 1])];
            upper.extend([left, right]);
            lower.extend([right, left]);
            return [upper, lower];
        }
        // The halves meet in a line along x between two opposite corners.
        [of(&[4, 5, 0, 1]), of(&[1, 2, 3, 4])]
    }
}
