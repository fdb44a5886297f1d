//! The forces on one sphere, by a given method or by the cheapest one.

use num_traits::Zero;

use super::cells::Cells;
use super::grid::Grid;
use super::lines::{Lines, Received};
use super::meter::Meter;
use super::plan::{Keeping, unless_too_large};
use super::question::Method;
use super::sweep::Descent;
use super::tree::{Above, Wanted};
use crate::Error;
use crate::error::bug;
use crate::lattice::Site;
use crate::pile::System;
use crate::scalar::{Algebra, Exactness};

/// Returns the forces from above on a sphere of the pile, and zero on lines outside `wanted`.
///
/// # Errors
/// [`Error::TooLarge`] if the method does not fit in memory.
pub(crate) fn received<T: Algebra>(
    (lines, system): (&Lines<'_, T>, &System<'_>),
    (site, wanted): (Site, Wanted),
    method: Option<Method>,
    meter: Meter<'_>,
) -> Result<Received<T>, Error> {
    match method {
        Some(Method::Sweep) => return by_sweep(lines, system, site, meter),
        None | Some(Method::Closed) => {
            if let Some(forces) = lines.closed(site, wanted) {
                meter.visit(1);
                return Ok(Received { forces, changes: 0 });
            }
        }
        Some(Method::Tree) => {}
    }
    let by_tree = || {
        let above = by_tree(lines, site.k, &[[site.i, site.j]], wanted, meter)?;
        let forces = above.forces.into_iter().next();
        Ok(Received {
            forces: forces.ok_or_else(|| bug("a tree above one sphere has its forces"))?,
            changes: above.changes,
        })
    };
    if method.is_some() {
        return by_tree();
    }
    // If many sign changes make the tree too large, the layers may still be small enough for a sweep.
    unless_too_large(by_tree, || by_sweep(lines, system, site, meter))
}

/// Returns the forces from above on spheres of one layer, by one tree.
pub(super) fn by_tree<T: Algebra>(
    lines: &Lines<'_, T>,
    k: i128,
    sites: &[[i128; 2]],
    wanted: Wanted,
    meter: Meter<'_>,
) -> Result<Above<T>, Error> {
    let above = lines.forces_above(k, sites, wanted)?;
    meter.visit(above.nodes + sites.len());
    meter.turn(above.nodes);
    Ok(above)
}

/// Returns the forces from above on one sphere, by a sweep of all layers down to it.
fn by_sweep<T: Algebra>(
    lines: &Lines<'_, T>,
    system: &System<'_>,
    site: Site,
    meter: Meter<'_>,
) -> Result<Received<T>, Error> {
    let mut sweep = plain_sweep(lines, system, site.k)?;
    sweep.advance(site.k, meter)?;
    meter.visit(1);
    sweep.received(site)
}

/// Returns a sweep down to layer `last` in the numerators of the scalar. It starts at the top.
///
/// # Errors
/// [`Error::TooLarge`] if a layer does not fit in memory.
pub(crate) fn plain_sweep<'p, T: Algebra>(
    lines: &Lines<'p, T>,
    system: &System<'_>,
    last: i128,
) -> Result<Descent<'p, T, Cells<T::Numerator>>, Error> {
    let mut words = match Keeping::of::<T>(system) {
        Keeping::Words(words) => words,
        Keeping::Limbs => size_of::<T::Numerator>().div_ceil(size_of::<i64>()),
    };
    if T::EXACTNESS == Exactness::Exact {
        // The digits of a big integer are stored on the heap.
        words += system.size_of_sweep(last).planes;
    }
    let grid = Grid::new(lines.shape, last, words)?;
    let layer = Cells::new(&grid, &T::Numerator::zero());
    Descent::new(lines.clone(), grid, layer)
}
