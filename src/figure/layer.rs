//! A layer seen from above.

use super::canvas::Canvas;
use super::panel::{Bounds, Panel};
use super::subject::nearest;
use super::{Subject, canvas};
use crate::Error;
use crate::lattice::Site;
use crate::shape::Selection;

/// Where the spheres of a layer are, seen from above: u to the right, v upwards, in R.
///
/// Where z points down, as in the paper, x is upwards and y to the right. Discs lie along x, to the right.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    pub(super) places: Vec<Place>,
    pub(super) caption: String,
    /// i → i+1 and j → j+1.
    pub(super) steps: [[f64; 2]; 2],
    discs: bool,
    /// Of (u, v) = (0, 0), in the unit of lengths.
    origin: [f64; 2],
    /// R in the unit of lengths.
    radius: f64,
    unit: &'static str,
}

/// A sphere of a layer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) site: Site,
    /// In R.
    pub(super) at: [f64; 2],
}

impl Layer {
    /// All spheres of layer `k`, in row order. How many there are is for the caller to check.
    pub(super) fn new(subject: &Subject<'_>, k: i128) -> Result<Self, Error> {
        let discs = subject.is_of_discs();
        let mut places: Vec<Place> = Vec::new();
        let mut first = None;
        for site in subject.pile().rows(Selection::Layer(k))?.flatten() {
            let origin = *first.get_or_insert(site);
            let at = seen(discs, subject.from(origin, site)?);
            places.push(Place { site, at });
        }
        let mut origin = [0.0; 2];
        if let Some(site) = first {
            let [x, y, _] = subject.packing().position(site)?;
            let place = [nearest(&x, "a position")?, nearest(&y, "a position")?, 0.0];
            origin = seen(discs, place);
        }
        Ok(Self {
            places,
            caption: subject.caption(),
            steps: subject.steps()?.map(|step| seen(discs, step)),
            discs,
            origin,
            radius: subject.radius()?,
            unit: subject.length_unit(),
        })
    }

    /// Where a sphere of any layer is seen.
    pub(super) fn above(&self, subject: &Subject<'_>, site: Site) -> Result<[f64; 2], Error> {
        let first = self.places.first().map_or(site, |place| place.site);
        Ok(seen(self.discs, subject.from(first, site)?))
    }

    /// A horizontal vector as it is seen.
    pub(super) fn seen(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        seen(self.discs, [x, y, 0.0])
    }

    pub(super) fn is_of_discs(&self) -> bool {
        self.discs
    }

    /// The distance of neighbours in a row, in R.
    pub(super) fn apart(&self) -> f64 {
        let [[u, v], _] = self.steps;
        u.hypot(v)
    }

    /// Around its spheres with a margin in R, and wide enough to be a figure.
    pub(super) fn bounds(&self, margin: f64) -> Bounds {
        let centres = self.places.iter().map(|place| place.at);
        let height = if self.discs { 4.0 } else { 8.0 };
        Bounds::around(centres, margin).at_least(10.0, height)
    }

    /// The axes, with ticks in the unit of lengths; discs have none across.
    pub(super) fn axes(&self, panel: &Panel, canvas: &mut Canvas) {
        let named = |axis: &str| format!("{axis} in {}", self.unit);
        let names = if self.discs {
            [named("x"), String::new()]
        } else {
            [named("y"), named("x")]
        };
        let [across, up] = &names;
        panel.axes(canvas, [across, up], self.origin, self.radius);
    }

    /// The corners of the cell around a site: six cells meet where three spheres would be as far apart.
    ///
    /// On an equilateral base it is a regular hexagon. Discs have a strip of their plane.
    pub(super) fn cell(&self, panel: &Panel, [u, v]: [f64; 2]) -> Vec<canvas::Point> {
        let [i, j] = self.steps;
        let corner = |a: f64, b: f64| {
            panel.at([
                u + (a * i[0] + b * j[0]) / 3.0,
                v + (a * i[1] + b * j[1]) / 3.0,
            ])
        };
        if self.discs {
            let half = self.apart() / 2.0;
            let strip = [(-half, -1.0), (half, -1.0), (half, 1.0), (-half, 1.0)];
            return strip.map(|(a, b)| panel.at([u + a, v + b])).to_vec();
        }
        [
            (1.0, 1.0),
            (-1.0, 2.0),
            (-2.0, 1.0),
            (-1.0, -1.0),
            (1.0, -2.0),
            (2.0, -1.0),
        ]
        .map(|(a, b)| corner(a, b))
        .to_vec()
    }
}

/// From above, where z points down; discs from the side.
fn seen(discs: bool, [x, y, _]: [f64; 3]) -> [f64; 2] {
    if discs { [x, 0.0] } else { [y, x] }
}
