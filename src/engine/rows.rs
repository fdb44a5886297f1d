//! The forces on spheres, by lines or by layers.

use alloc::boxed::Box;
use alloc::vec::Vec;

use num_rational::BigRational;
use num_traits::Zero;

use super::cells::Cells;
use super::grid::Grid;
use super::limbs::Planes;
use super::lines::{LineForces, SphereForces};
use super::meter::Meter;
use super::plan::{CHUNK, Plan, last_of, unless_too_large};
use super::question::Method;
use super::sweep::Sweep;
use super::thirds::has_threefold_symmetry;
use super::tree::LineSelection;
use crate::Error;
use crate::lattice::{Row, Site};
use crate::scalar::{Algebra, Exactness, Numerators};
use crate::shape::{Rows, Shape};

/// The engine that a plan has chosen for many spheres.
#[derive(Clone, Debug)]
pub(crate) enum Engine<'p, T: Algebra> {
    /// By lines, with a tree for each piece of a row.
    Lines,
    /// By layers, in numerators of the scalar.
    Cells(Box<Sweep<'p, T, Cells<T::Numerator>>>),
    /// By layers, in limbs, for a scalar that is exact itself.
    Limbs(Box<Sweep<'p, BigRational, Planes>>),
}

impl<'p, T: Algebra> Engine<'p, T> {
    /// # Errors
    /// [`Error::TooLarge`] if it does not fit in memory.
    pub(crate) fn new(
        plan: &Plan,
        rows: &Rows<'_>,
        lines: &LineForces<'p, T>,
    ) -> Result<Self, Error> {
        let last = last_of(rows);
        Ok(match plan.method {
            Method::Closed | Method::Tree => Self::Lines,
            // Integers cannot represent loads in another exact scalar.
            Method::Sweep if T::EXACTNESS == Exactness::Exact && !lines.has_scalar_loads => {
                let lines = LineForces::of(lines.pile.clone(), lines.shape);
                Self::Limbs(Box::new(shortest_exact_sweep(&lines, last)?))
            }
            Method::Sweep => Self::Cells(Box::new(plain_sweep(lines, last)?)),
        })
    }

    pub(crate) const fn is_sweep(&self) -> bool {
        !matches!(self, Self::Lines)
    }

    /// Returns the best number of spheres for one request: those that share a tree, or a number that fits in the cache.
    pub(crate) fn sites_at_once(&self, lines: &LineForces<'_, T>) -> i128 {
        match self {
            Self::Lines if !lines.shape.stacking().is_straight() => CHUNK,
            _ => 64,
        }
    }

    /// Advances a sweep to layer `k`. The engine by lines does nothing.
    ///
    /// # Errors
    /// [`Error::Bug`], [`Error::Interrupted`].
    pub(crate) fn go_down_to(&mut self, k: i128, meter: Meter<'_>) -> Result<(), Error> {
        match self {
            Self::Lines => Ok(()),
            Self::Cells(sweep) => sweep.advance(k, meter),
            Self::Limbs(sweep) => sweep.advance(k, meter),
        }
    }

    /// Returns the forces from above on each sphere of a piece of a row. A sweep must be at the layer of the row.
    pub(crate) fn received_in(
        &self,
        lines: &LineForces<'p, T>,
        piece: &Row,
        meter: Meter<'_>,
    ) -> Vec<Result<SphereForces<T>, Error>> {
        match self {
            Self::Lines => by_lines(lines, piece, meter),
            Self::Cells(sweep) => of_row(piece, meter, |site| sweep.received_before_turn(site)),
            Self::Limbs(sweep) => of_row(piece, meter, |site| {
                sweep
                    .received_before_turn(site)
                    .map(|above| in_scalar(sweep, above))
            }),
        }
    }

    /// Returns the forces from above on each sphere of a piece of a row, and those that it transmits. The row is above
    /// the floor, and a sweep must be at the layer of the row.
    pub(crate) fn received_and_transmitted_in(
        &self,
        lines: &LineForces<'p, T>,
        piece: &Row,
        meter: Meter<'_>,
    ) -> [Vec<Result<SphereForces<T>, Error>>; 2] {
        let above = self.received_in(lines, piece, meter);
        let below = match self {
            Self::Lines => below_each(lines, piece, above.clone(), meter),
            // The spheres are counted already. A sweep has no other work to count here.
            Self::Cells(_) | Self::Limbs(_) => self.transmitted_in(lines, piece, Meter::NONE),
        };
        [above, below]
    }

    /// Returns the forces that each sphere of a piece of a row transmits. The row is above the floor, and a sweep must
    /// be at the layer of the row.
    pub(crate) fn transmitted_in(
        &self,
        lines: &LineForces<'p, T>,
        piece: &Row,
        meter: Meter<'_>,
    ) -> Vec<Result<SphereForces<T>, Error>> {
        match self {
            Self::Lines => below_each(lines, piece, by_lines(lines, piece, meter), meter),
            Self::Cells(sweep) => {
                let increments = sweep.lines.increments_below(piece.k);
                of_row(piece, meter, |site| {
                    sweep.transmitted(&increments, site, meter)
                })
            }
            Self::Limbs(sweep) => {
                let increments = sweep.lines.increments_below(piece.k);
                of_row(piece, meter, |site| {
                    let below = sweep.transmitted(&increments, site, meter);
                    below.map(|below| in_scalar(sweep, below))
                })
            }
        }
    }
}

/// Returns the forces that each sphere of a piece of a row transmits, from those that it receives.
fn below_each<T: Algebra>(
    lines: &LineForces<'_, T>,
    piece: &Row,
    above: Vec<Result<SphereForces<T>, Error>>,
    meter: Meter<'_>,
) -> Vec<Result<SphereForces<T>, Error>> {
    let increments = lines.increments_below(piece.k);
    let below =
        |(site, above): (_, Result<_, _>)| Ok(lines.below_layer(&increments, site, above?, meter));
    piece.clone().into_iter().zip(above).map(below).collect()
}

/// Returns the forces of each sphere of a piece of a row, from a sweep.
fn of_row<A>(
    piece: &Row,
    meter: Meter<'_>,
    one: impl Fn(Site) -> Result<A, Error>,
) -> Vec<Result<A, Error>> {
    let one = |site| {
        meter.visit(1);
        one(site)
    };
    piece.clone().into_iter().map(one).collect()
}

/// Converts the integers of a sweep in limbs into the numerators of an exact scalar.
fn in_scalar<T: Algebra>(
    sweep: &Sweep<'_, BigRational, Planes>,
    SphereForces { forces, changes }: SphereForces<BigRational>,
) -> SphereForces<T> {
    let forces = T::Numerator::of_integers(forces, || sweep.lines.scale(changes));
    SphereForces { forces, changes }
}

/// Returns the forces from above on each sphere of a piece of a row, with one tree for each [`CHUNK`].
fn by_lines<T: Algebra>(
    lines: &LineForces<'_, T>,
    piece: &Row,
    meter: Meter<'_>,
) -> Vec<Result<SphereForces<T>, Error>> {
    let changes = lines.shape.changes_above(piece.k);
    let sites = piece.clone().into_iter();
    if changes == 0 {
        let one = |site| lines.above(site, LineSelection::All, meter);
        return sites.map(one).collect();
    }
    let mut received = Vec::new();
    for Row { k, j, i } in piece.pieces(CHUNK) {
        let sites: Vec<[i128; 2]> = i.map(|i| [i, j]).collect();
        match lines.forces_above(k, &sites, LineSelection::All, meter) {
            Ok(forces) => received.extend(forces.into_iter().map(Ok)),
            Err(error) => received.extend(sites.iter().map(|_| Err(error.clone()))),
        }
    }
    received
}

impl<T: Algebra> LineForces<'_, T> {
    /// Returns the forces from above on a sphere of the pile, and zero on lines outside `wanted`.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the method does not fit in memory.
    pub(crate) fn received(
        &self,
        (site, wanted): (Site, LineSelection),
        method: Option<Method>,
        meter: Meter<'_>,
    ) -> Result<SphereForces<T>, Error> {
        let by_sweep = || {
            let mut sweep = plain_sweep(self, site.k)?;
            sweep.advance(site.k, meter)?;
            meter.visit(1);
            sweep.received(site)
        };
        match method {
            Some(Method::Sweep) => by_sweep(),
            Some(Method::Closed | Method::Tree) => self.above(site, wanted, meter),
            // If many sign changes make the tree too large, the layers may still be small enough for a sweep.
            None => unless_too_large(|| self.above(site, wanted, meter), by_sweep),
        }
    }
}

/// Returns a sweep down to layer `last` in the numerators of the scalar. It starts at the top.
///
/// # Errors
/// [`Error::TooLarge`] if a layer does not fit in memory.
pub(super) fn plain_sweep<'p, T: Algebra>(
    lines: &LineForces<'p, T>,
    last: i128,
) -> Result<Sweep<'p, T, Cells<T::Numerator>>, Error> {
    let limbs = match T::EXACTNESS {
        Exactness::Exact => lines.pile.size_of_sweep(last).planes,
        _ => 1,
    };
    let grid = Grid::new(lines.shape, last, lines.words(limbs, false))?;
    let layer = Cells::new(&grid, &T::Numerator::zero());
    Sweep::new(lines.clone(), grid, layer)
}

/// Returns a sweep in limbs down to layer `last`. It starts at the top.
///
/// # Errors
/// [`Error::TooLarge`] if a layer does not fit in memory.
#[cfg(test)]
pub(crate) fn exact_sweep<'p>(
    lines: &LineForces<'p, BigRational>,
    last: i128,
) -> Result<Sweep<'p, BigRational, Planes>, Error> {
    in_limbs(lines, last, Grid::new)
}

/// Returns a sweep in limbs down to layer `last`. It stores a third of each layer if the pile has threefold symmetry,
/// and whole layers otherwise.
///
/// # Errors
/// [`Error::TooLarge`] if a layer does not fit in memory.
pub(crate) fn shortest_exact_sweep<'p>(
    lines: &LineForces<'p, BigRational>,
    last: i128,
) -> Result<Sweep<'p, BigRational, Planes>, Error> {
    if has_threefold_symmetry(&lines.pile) {
        in_limbs(lines, last, Grid::of_thirds)
    } else {
        in_limbs(lines, last, Grid::new)
    }
}

fn in_limbs<'p>(
    lines: &LineForces<'p, BigRational>,
    last: i128,
    grid: impl FnOnce(&'p Shape, i128, usize) -> Result<Grid<'p>, Error>,
) -> Result<Sweep<'p, BigRational, Planes>, Error> {
    let grid = grid(lines.shape, last, lines.pile.size_of_sweep(last).planes)?;
    let layer = Planes::new(&grid, lines.pile.bound_of_sweep(last));
    Sweep::new(lines.clone(), grid, layer)
}
