//! The forces on many spheres, in row order.

use alloc::boxed::Box;
use alloc::vec::Vec;

use num_rational::BigRational;

use super::cells::Cells;
use super::grid::{Grid, Layer};
use super::limbs::Planes;
use super::lines::{LineForces, SphereForces};
use super::meter::Meter;
use super::plan::{CHUNK, Plan, last_of};
use super::question::Method;
use super::single::{by_tree, plain_sweep, received};
use super::sweep::Sweep;
use super::thirds::has_threefold_symmetry;
use super::tree::LineSelection;
use crate::Error;
use crate::lattice::Row;
use crate::pile::System;
use crate::scalar::Algebra;
use crate::shape::Rows;

/// The method that a plan has chosen for many spheres.
#[derive(Clone, Debug)]
pub(crate) enum Engine<'p, T: Algebra, L> {
    /// Each sphere separately.
    Single(Option<Method>),
    /// A tree for each piece of a row.
    Tree,
    /// A sweep, with one layer in memory.
    Sweep(Box<Sweep<'p, T, L>>),
}

impl<'p, T: Algebra, L: Layer<T>> Engine<'p, T, L> {
    fn new(
        plan: &Plan,
        rows: &Rows<'_>,
        sweep: impl FnOnce(i128) -> Result<Sweep<'p, T, L>, Error>,
    ) -> Result<Self, Error> {
        Ok(match plan.method {
            Method::Tree if rows.one().is_none() => Self::Tree,
            // Each sphere uses this method, or a tree if *closed* does not apply to the sphere.
            method @ (Method::Closed | Method::Tree) => Self::Single(Some(method)),
            Method::Sweep => Self::Sweep(Box::new(sweep(last_of(rows))?)),
        })
    }

    pub(crate) const fn is_sweep(&self) -> bool {
        matches!(self, Self::Sweep(_))
    }

    /// Returns the best number of spheres for one request: those that share a tree, or a number that fits in the cache.
    pub(crate) const fn sites_at_once(&self) -> i128 {
        match self {
            Self::Tree => CHUNK,
            Self::Single(_) | Self::Sweep(_) => 64,
        }
    }

    /// Advances a sweep to layer `k`. Other methods do nothing.
    ///
    /// # Errors
    /// [`Error::Bug`], [`Error::Interrupted`].
    pub(crate) fn go_down_to(&mut self, k: i128, meter: Meter<'_>) -> Result<(), Error> {
        match self {
            Self::Sweep(sweep) => sweep.advance(k, meter),
            Self::Single(_) | Self::Tree => Ok(()),
        }
    }

    /// Returns the forces from above on each sphere of a piece of a row. A sweep must be at the layer of the row.
    pub(crate) fn received_in(
        &self,
        pile: (&LineForces<'p, T>, &System<'p>),
        piece: &Row,
        meter: Meter<'_>,
    ) -> Vec<Result<SphereForces<T>, Error>> {
        let sites = piece.clone().into_iter();
        let one = |method, site| received(pile, (site, LineSelection::All), method, meter);
        match self {
            Self::Single(method) => sites.map(|site| one(*method, site)).collect(),
            Self::Tree => match received_in(pile.0, piece, meter) {
                Ok(received) => received.into_iter().map(Ok).collect(),
                Err(error) => sites.map(|_| Err(error.clone())).collect(),
            },
            Self::Sweep(sweep) => {
                let one = |site| {
                    meter.visit(1);
                    sweep.received_before_turn(site)
                };
                sites.map(one).collect()
            }
        }
    }

    /// Returns the forces that each sphere of a piece of a row transmits. The row is above the floor, and a sweep must
    /// be at the layer of the row.
    pub(crate) fn transmitted_in(
        &self,
        pile: (&LineForces<'p, T>, &System<'p>),
        piece: &Row,
        meter: Meter<'_>,
    ) -> Vec<Result<SphereForces<T>, Error>> {
        let sites = piece.clone().into_iter();
        let lines = pile.0;
        let increments = lines.increments_below(piece.k);
        if let Self::Sweep(sweep) = self {
            let one = |site| {
                meter.visit(1);
                sweep.transmitted(&increments, site, meter)
            };
            return sites.map(one).collect();
        }
        let above = self.received_in(pile, piece, meter);
        let below = |(site, above): (_, Result<_, _>)| {
            Ok(lines.below_layer(&increments, site, above?, meter))
        };
        sites.zip(above).map(below).collect()
    }
}

impl<'p, T: Algebra> Engine<'p, T, Cells<T::Numerator>> {
    /// Returns the engine that a plan has chosen, in the numerators of the scalar.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if it does not fit in memory.
    pub(crate) fn plain(
        plan: &Plan,
        rows: &Rows<'_>,
        (lines, system): (&LineForces<'p, T>, &System<'p>),
    ) -> Result<Self, Error> {
        Self::new(plan, rows, |last| plain_sweep(lines, system, last))
    }
}

impl<'p> Engine<'p, BigRational, Planes> {
    /// Returns the engine that a plan has chosen. A sweep works in limbs.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if it does not fit in memory.
    pub(crate) fn exact(
        plan: &Plan,
        rows: &Rows<'_>,
        (lines, system): (&LineForces<'p, BigRational>, &System<'p>),
    ) -> Result<Self, Error> {
        Self::new(plan, rows, |last| shortest_exact_sweep(lines, system, last))
    }
}

/// Returns a sweep in limbs down to layer `last`. It starts at the top.
///
/// # Errors
/// [`Error::TooLarge`] if a layer does not fit in memory.
pub(crate) fn exact_sweep<'p>(
    lines: &LineForces<'p, BigRational>,
    system: &System<'_>,
    last: i128,
) -> Result<Sweep<'p, BigRational, Planes>, Error> {
    let size = system.size_of_sweep(last);
    let grid = Grid::new(lines.shape, last, size.planes)?;
    let layer = Planes::new(&grid, system.bound_of_sweep(last));
    Sweep::new(lines.clone(), grid, layer)
}

/// Returns the forces from above on consecutive spheres of a row, with one tree for each piece of it.
///
/// # Errors
/// [`Error::TooLarge`] if a tree has too many nodes.
fn received_in<T: Algebra>(
    lines: &LineForces<'_, T>,
    row: &Row,
    meter: Meter<'_>,
) -> Result<Vec<SphereForces<T>>, Error> {
    let mut received = Vec::new();
    for piece in row.pieces(CHUNK) {
        let sites: Vec<[i128; 2]> = piece.i.map(|i| [i, piece.j]).collect();
        let above = by_tree(lines, row.k, &sites, LineSelection::All, meter)?;
        let changes = above.changes;
        let forces = above.forces.into_iter();
        received.extend(forces.map(|forces| SphereForces { forces, changes }));
    }
    Ok(received)
}

/// Returns a sweep in limbs down to layer `last`. It stores a third of each layer if the pile has threefold symmetry,
/// and whole layers otherwise.
///
/// # Errors
/// As for [`exact_sweep`].
pub(crate) fn shortest_exact_sweep<'p>(
    lines: &LineForces<'p, BigRational>,
    system: &System<'_>,
    last: i128,
) -> Result<Sweep<'p, BigRational, Planes>, Error> {
    if !has_threefold_symmetry(system) {
        return exact_sweep(lines, system, last);
    }
    let grid = Grid::of_thirds(lines.shape, last, system.size_of_sweep(last).planes)?;
    let layer = Planes::new(&grid, system.bound_of_sweep(last));
    Sweep::new(lines.clone(), grid, layer)
}
