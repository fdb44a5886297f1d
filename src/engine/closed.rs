//! The method *closed*: forces without a sign change above them, by (8) and (9) of the paper, plus the loads on the
//! line.
//!
//! Within the first run, the force on a line is the increment of its direction times the number of spheres above on the
//! line. So a force takes O(1) operations, whatever the height. Each load on the line adds one term. Below a sign
//! change the lines mix, and no such formula exists.

use num_traits::Zero;

use super::lines::{Line, LineForces, start_of};
use super::meter::Meter;
use super::question::Method;
use super::tree::LineSelection;
use crate::each::Each;
use crate::formula;
use crate::lattice::{Direction, Site};
use crate::scalar::{Algebra, Ring};
use crate::shape::RunLayers;

/// Returns the force that a sphere of a straight stacking transmits along one line.
///
/// The force is the sum of the increments of this sphere and of the spheres above it on the line. The caller has
/// checked the site. Returns `None` if the stacking has a sign change, or if another method is requested.
pub(crate) fn closed_contact<T: Algebra>(
    lines: &LineForces<'_, T>,
    (site, direction): (Site, Direction),
    method: Option<Method>,
    meter: Meter<'_>,
) -> Option<T::Numerator> {
    let shape = lines.shape;
    if !matches!(method, None | Some(Method::Closed)) || !shape.stacking().is_straight() {
        return None;
    }
    let Site { i, j, k } = site;
    let run = shape.stretch_to(k + 1)?;
    let above = shape.spheres_above(&run, k, [i, j])[direction.index()];
    let below = start_of([i, j], direction, run.sign, -1);
    let force = lines.counted(run, k + 1, below, direction, above + 1);
    meter.visit(1);
    Some(force)
}

impl<T: Algebra> LineForces<'_, T> {
    /// Returns the forces from above on a sphere without a sign change above it, and zero on lines outside `wanted`.
    ///
    /// The caller has checked the site. Returns `None` below a sign change.
    pub(crate) fn closed(&self, site: Site, wanted: LineSelection) -> Option<[T::Numerator; 3]> {
        let Site { i, j, k } = site;
        let Some(run) = self.shape.stretch_to(k) else {
            return Some([(); 3].each(|()| T::Numerator::zero()));
        };
        if run.index > 0 {
            return None;
        }
        let counts = self.shape.spheres_above(&run, k, [i, j]);
        Some(Direction::ALL.each(|direction| {
            if wanted.includes(direction) {
                self.counted(run, k, [i, j], direction, counts[direction.index()])
            } else {
                T::Numerator::zero()
            }
        }))
    }

    /// Returns the sum of the increments of the `n` spheres above a site on a line of the run, loads included. It is a
    /// numerator over the denominator before any sign change.
    pub(super) fn counted(
        &self,
        run: RunLayers,
        k: i128,
        site: [i128; 2],
        direction: Direction,
        n: i128,
    ) -> T::Numerator {
        let ordinary = self.ordinary_in(run.index, T::Numerator::from_i128(n), direction.index());
        if self.extras.is_empty() {
            return ordinary;
        }
        let [i, j] = site;
        let line = Line::through(Site { i, j, k }, direction, run);
        let extras = self.extras.range(&((line, k - n)..(line, k)));
        let add = |sum, (_, extra): &(_, T::Numerator)| formula::transmitted(sum, extra);
        extras.iter().fold(ordinary, add)
    }
}
