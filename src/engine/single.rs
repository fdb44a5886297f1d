//! The forces on one sphere, by a given method or by the cheapest one.

use num_traits::Zero;

use super::cells::Cells;
use super::grid::Grid;
use super::lines::{LineForces, SphereForces};
use super::meter::Meter;
use super::plan::{Storage, unless_too_large};
use super::question::Method;
use super::sweep::Sweep;
use super::tree::{Above, LineSelection};
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
    (lines, system): (&LineForces<'_, T>, &System<'_>),
    (site, wanted): (Site, LineSelection),
    method: Option<Method>,
    meter: Meter<'_>,
) -> Result<SphereForces<T>, Error> {
    match method {
        Some(Method::Sweep) => return by_sweep(lines, system, site, meter),
        None | Some(Method::Closed) => {
            if let Some(forces) = lines.closed(site, wanted) {
                meter.visit(1);
                return Ok(SphereForces { forces, changes: 0 });
            }
        }
        Some(Method::Tree) => {}
    }
    let by_tree = || {
        let above = by_tree(lines, site.k, &[[site.i, site.j]], wanted, meter)?;
        let forces = above.forces.into_iter().next();
        Ok(SphereForces {
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
    lines: &LineForces<'_, T>,
    k: i128,
    sites: &[[i128; 2]],
    wanted: LineSelection,
    meter: Meter<'_>,
) -> Result<Above<T>, Error> {
    let above = lines.forces_above(k, sites, wanted)?;
    meter.visit(above.nodes + sites.len());
    meter.turn(above.nodes);
    Ok(above)
}

/// Returns the forces from above on one sphere, by a sweep of all layers down to it.
fn by_sweep<T: Algebra>(
    lines: &LineForces<'_, T>,
    system: &System<'_>,
    site: Site,
    meter: Meter<'_>,
) -> Result<SphereForces<T>, Error> {
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
    lines: &LineForces<'p, T>,
    system: &System<'_>,
    last: i128,
) -> Result<Sweep<'p, T, Cells<T::Numerator>>, Error> {
    let mut words = match Storage::of::<T>(system) {
        Storage::Words(words) => words,
        Storage::Limbs => size_of::<T::Numerator>().div_ceil(size_of::<i64>()),
    };
    if T::EXACTNESS == Exactness::Exact {
        // The digits of a big integer are stored on the heap.
        words += system.size_of_sweep(last).planes;
    }
    let grid = Grid::new(lines.shape, last, words)?;
    let layer = Cells::new(&grid, &T::Numerator::zero());
    Sweep::new(lines.clone(), grid, layer)
}
