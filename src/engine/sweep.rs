//! The method *sweep*: from the top down, layer by layer, with one layer in memory.
//!
//! In numerical terms a sweep applies a transfer matrix, without assembling it. The state is three forces from above
//! for each sphere of a layer. One step maps it linearly to the state of the next layer:
//!
//! 1. At a sign change, each sphere replaces its three forces g by G g, with G = (2/3)J − I.
//! 2. Each sphere adds its own weight, one increment to each line.
//! 3. Each line continues to the sphere below. This permutes the state. The layout of a [`Grid`] makes the permutation
//!    free.
//!
//! For example, let the stacking "+−" begin with one sphere. This sphere transmits (1, 0, 0), (0, 1, 0) and (0, 0, 1)
//! to its three supports. The sign changes there, so the first of them transmits G(1, 0, 0) + (1, 1, 1) = (2/3, 5/3,
//! 5/3), in f₀.
//!
//! Between two sign changes only the second step remains. So a whole run is one *pass*: it adds to each line the
//! increments of all spheres of the run that lie on it.
//!
//! The step is the same for every type of number. A [`Cells`] of the numerators of a scalar gives the generic sweep.
//! [`Planes`] of `i64`, one for each limb, give the exact engine. The memory is that of one layer, and no call recurses
//! over layers.

use alloc::vec::Vec;
use core::ops::Range;

use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::cells::Cells;
use super::grid::{Grid, Layer, Pass, Stored};
use super::interrupt::check as check_interrupt;
use super::limbs::{Least, Planes};
use super::lines::{LineForces, SphereForces};
use super::meter::Meter;
use super::nearest::{Readout, Unit};
use super::slices::split_front;
use super::thirds::turned;
use crate::Error;
use crate::each::Each;
use crate::error::bug;
use crate::formula::half_turn;
use crate::lattice::{Region, Row, Site};
use crate::scalar::{Algebra, CorrectlyRounded};

/// The state of a sweep: the forces on all lines of one layer.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<'p, T: Algebra, S> {
    pub(super) lines: LineForces<'p, T>,
    grid: Grid<'p>,
    layer: S,
    /// The last pass, or `None` at the top.
    pass: Option<Pass>,
    k: i128,
    /// The stored spheres of layer `k`.
    stored: Stored,
    /// Whether the lines already contain the extra weights and loads of layer `k`.
    extras_added: bool,
}

impl<'p, T: Algebra, S: Layer<T>> Sweep<'p, T, S> {
    /// Returns a sweep that starts at the top.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(crate) fn new(lines: LineForces<'p, T>, grid: Grid<'p>, layer: S) -> Result<Self, Error> {
        Ok(Self {
            lines,
            stored: grid.stored(0)?,
            grid,
            layer,
            pass: None,
            k: 0,
            extras_added: false,
        })
    }

    /// Returns the current layer.
    pub(crate) fn k(&self) -> i128 {
        self.k
    }

    /// Returns the stored spheres of the current layer: all of them, or a third whose images are the rest.
    pub(crate) fn part(&self) -> Region {
        self.stored.part
    }

    /// Advances to layer `k`. Does nothing if the sweep is already at this layer or below.
    ///
    /// # Errors
    /// [`Error::Bug`], [`Error::Interrupted`].
    pub(crate) fn advance(&mut self, k: i128, meter: Meter<'_>) -> Result<(), Error> {
        while k > self.k {
            check_interrupt()?;
            if self.k == self.grid.last {
                self.layer.catch_up(&self.grid)?;
                let (next, moves) = self.grid.next_window()?;
                self.layer.move_to(&next, &moves);
                self.grid = next;
                self.stored = self.grid.stored(self.k)?;
            }
            let pass = self.grid.pass(self.k, k)?;
            let pass = pass.ok_or_else(|| bug("a pass leads further down"))?;
            self.add_extras_here()?;
            self.add_extras(pass.from + 1..pass.k)?;
            let increments = self.lines.increments_after(pass.run.index);
            self.layer.pass(&self.grid, &pass, &increments)?;
            meter.pass();
            if meter.counts() && pass.turns {
                let sites = pass.stored.part.site_count().to_usize();
                // A count beyond `usize` is reported as its maximum.
                meter.turn(sites.unwrap_or(usize::MAX));
            }
            (self.k, self.stored) = (pass.k, pass.stored);
            (self.pass, self.extras_added) = (Some(pass), false);
        }
        self.layer.catch_up(&self.grid)
    }

    /// Adds the extra weights and loads of the current layer to its lines.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(crate) fn add_extras_here(&mut self) -> Result<(), Error> {
        if !self.extras_added {
            self.add_extras(self.k..self.k + 1)?;
            self.extras_added = true;
        }
        Ok(())
    }

    fn add_extras(&mut self, layers: Range<i128>) -> Result<(), Error> {
        let sites: Vec<Site> = self.lines.extras_in(layers).collect();
        if !sites.is_empty() {
            self.layer.catch_up(&self.grid)?;
        }
        for site in sites {
            let cells = self.grid.site([site.i, site.j], self.grid.shift(site.k))?;
            self.layer.add_at(cells, &self.lines.extra(site))?;
        }
        Ok(())
    }

    /// Returns the forces from above on a sphere of the current layer.
    ///
    /// # Errors
    /// [`Error::Bug`] if the sphere belongs to another layer.
    pub(crate) fn received(&self, site: Site) -> Result<SphereForces<T>, Error> {
        if site.k != self.k {
            return Err(bug("a sweep is queried only at its current layer"));
        }
        let (image, turns) = self.stored.kept([site.i, site.j])?;
        let mut forces = self.layer.at(self.grid.site(image, self.stored.shift)?);
        // After the rotations, the force along each direction is on the line of the rotated direction.
        forces.rotate_left(turned(0, turns));
        Ok(SphereForces {
            forces,
            changes: self.changes(),
        })
    }

    /// Returns [`received`](Self::received) at any layer. At a sign change, the numbers on the lines are already turned. The
    /// half-turn is its own inverse.
    ///
    /// Only stresses are asked for at a sign change: forces on the floor are not turned. Exact numbers stay exact, floats
    /// round once more, and the two half-turns may widen intervals by 25/9.
    ///
    /// # Errors
    /// [`Error::Bug`] if the sphere belongs to another layer.
    pub(crate) fn received_before_turn(&self, site: Site) -> Result<SphereForces<T>, Error> {
        let SphereForces { forces, changes } = self.received(site)?;
        Ok(match self.pass {
            Some(pass) if pass.turns => SphereForces {
                forces: half_turn::<T>(&forces),
                changes: changes + 2,
            },
            _ => SphereForces { forces, changes },
        })
    }

    /// Returns the number of sign changes that the numbers on the lines already include.
    pub(crate) fn turned_already(&self) -> usize {
        let turns = self.pass.is_some_and(|pass| pass.turns);
        self.changes() + usize::from(turns)
    }

    /// Returns the number of sign changes above the current layer.
    fn changes(&self) -> usize {
        match self.pass {
            Some(pass) => pass.run.index,
            None => 0,
        }
    }

    /// Returns the forces that a sphere of the current layer transmits to its supports. `increments` are those
    /// [below](LineForces::increments_below) the layer.
    ///
    /// # Errors
    /// [`Error::Bug`] if the sphere belongs to another layer.
    pub(crate) fn transmitted(
        &self,
        increments: &[T::Numerator; 3],
        site: Site,
        meter: Meter<'_>,
    ) -> Result<SphereForces<T>, Error> {
        let SphereForces { forces, changes } = self.received(site)?;
        Ok(match self.pass {
            Some(pass) if pass.turns => self.lines.with_own(increments, site, forces, changes + 1),
            _ => {
                let above = SphereForces { forces, changes };
                self.lines.below_layer(increments, site, above, meter)
            }
        })
    }
}

impl<T: Algebra> Sweep<'_, T, Cells<T::Numerator>> {
    /// Returns the forces on the lines of a row of the current layer, by direction.
    ///
    /// # Errors
    /// [`Error::Bug`] for a row of another layer.
    pub(crate) fn carried(&self, row: &Row) -> Result<[&[T::Numerator]; 3], Error> {
        if row.k != self.k {
            return Err(bug("a sweep is queried only for rows of its layer"));
        }
        let cells = self.grid.row(row.j, &row.i, self.stored.shift)?;
        Ok(self.layer.slices(cells))
    }
}

impl Sweep<'_, BigRational, Planes> {
    /// Writes the correctly rounded values of a readout for a row of the current layer. Returns whether every value is
    /// a float.
    ///
    /// # Errors
    /// [`Error::Bug`] if the row belongs to another layer, or exceeds its layer.
    pub(crate) fn nearest_row<F: CorrectlyRounded>(
        &self,
        row: &Row,
        (readout, units): (&Readout, &[Unit; 3]),
        out: [&mut [F]; 3],
    ) -> Result<bool, Error> {
        if row.k != self.k {
            return Err(bug("a sweep is queried only for rows of its layer"));
        }
        if row.i.is_empty() {
            return Ok(true);
        }
        let kept = self.stored.part.row_within(row.j);
        if kept.start <= row.i.start && row.i.end <= kept.end {
            let cells = self.grid.row(row.j, &row.i, self.stored.shift)?;
            return readout.write(units, &self.layer.slices(&cells), out);
        }
        if self.grid.corner.is_none() {
            return Err(bug("a sweep is queried only for rows of its layer"));
        }
        let mut columns = [(); 3].each(|()| Vec::with_capacity(out[0].len()));
        for i in row.i.clone() {
            let (image, turns) = self.stored.kept([i, row.j])?;
            let cells = self.grid.site(image, self.stored.shift)?;
            for (line, column) in columns.iter_mut().enumerate() {
                let image = turned(line, turns);
                column.push((image, cells[image]));
            }
        }
        let limbs = self.layer.gathered(&columns);
        let limbs: Vec<_> = limbs
            .iter()
            .map(|limbs| limbs.each_ref().each(Vec::as_slice))
            .collect();
        readout.write(units, &limbs, out)
    }

    /// Returns the stored piece of a row of the current layer, and the values that belong to it.
    ///
    /// # Errors
    /// [`Error::Bug`] for a row of another length.
    pub(crate) fn stored_piece<'v, V>(
        &self,
        row: &Row,
        mut values: [&'v mut [V]; 3],
    ) -> Result<(Row, [&'v mut [V]; 3]), Error> {
        let kept = self.stored.part.row_within(row.j);
        // The piece is empty if nothing of the row is stored.
        let start = kept.start.clamp(row.i.start, row.i.end);
        let piece = |i| Row { i, ..row.clone() };
        // It ends with the row at the latest.
        let stored = piece(start..kept.end.clamp(start, row.i.end));
        split_front(&mut values, piece(row.i.start..start).length()?)?;
        let values = split_front(&mut values, stored.length()?)?;
        Ok((stored, values))
    }

    /// Copies values of the stored lines of the current layer to the lines of their images. The slices have one value for
    /// each sphere of the layer, by direction.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(crate) fn copy_to_images<V: Clone>(&self, slices: &mut [&mut [V]; 3]) -> Result<(), Error> {
        if self.grid.corner.is_none() {
            return Ok(());
        }
        self.stored.copy_to_images(self.grid.shape, self.k, slices)
    }

    /// Returns whether two stored spheres of the current layer have equal forces and equal weights.
    ///
    /// The limbs are compared, and equal numbers may have different limbs. So the answer may be `false` for equal
    /// forces.
    ///
    /// # Errors
    /// [`Error::Bug`] for a sphere that is not stored.
    pub(crate) fn are_alike(&self, [one, other]: [Site; 2]) -> Result<bool, Error> {
        let extra = |site| self.lines.extra_loads.get(&site).is_some();
        let cells = |Site { i, j, .. }| self.grid.site([i, j], self.stored.shift);
        let alike = self.layer.are_alike([cells(one)?, cells(other)?]);
        Ok(alike && !extra(one) && !extra(other))
    }

    /// Returns the smallest number on the lines of the current layer along each direction, and its position.
    ///
    /// # Errors
    /// [`Error::Bug`] at the top, where no line has begun.
    pub(crate) fn least(&mut self) -> Result<[Least; 3], Error> {
        let pass = self.pass.as_ref();
        let pass = pass.ok_or_else(|| bug("lines are compared below the top"))?;
        self.layer.least(&self.grid, pass)
    }
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;
    use num_traits::Zero;

    use super::*;
    use crate::Pile;
    use crate::engine::rows::exact_sweep;
    use crate::scalar::Surd;

    fn pile() -> Pile {
        Pile::under(Region::SITE, "+-+-+-".parse().unwrap()).unwrap()
    }

    /// Writes a row with a sweep that is at layer 4.
    fn write(row: &Row) -> Result<bool, Error> {
        let pile = pile();
        let lines = LineForces::<BigRational>::new(&pile);
        let mut sweep = exact_sweep(&lines, 6).unwrap();
        sweep.advance(4, crate::engine::Meter::NONE).unwrap();
        let readout = Readout {
            combination: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
            own: [(); 3].map(|()| BigInt::zero()),
        };
        let unit = || Unit::new(Surd::from(BigRational::from(BigInt::from(1))), 1.into());
        let mut out = [(); 3].map(|()| alloc::vec![0.0_f64; row.length().unwrap()]);
        let out = out.each_mut().map(Vec::as_mut_slice);
        sweep.nearest_row(row, (&readout, &[unit(), unit(), unit()]), out)
    }

    #[test]
    fn a_sweep_never_goes_back_up() {
        let pile = pile();
        let lines = LineForces::<BigRational>::new(&pile);
        let mut sweep = exact_sweep(&lines, 6).unwrap();
        for (requested, at) in [(4, 4), (1, 4), (4, 4), (5, 5)] {
            sweep
                .advance(requested, crate::engine::Meter::NONE)
                .unwrap();
            assert_eq!(sweep.k(), at);
        }
    }

    /// Returns the second row of layer 4 as a row of layer `k`, extended by `before` and `behind` sites at its ends.
    fn row(k: i128, [before, behind]: [i128; 2]) -> Row {
        let layer = pile().shape().layer(4).unwrap();
        let Row { j, i, .. } = layer.rows(4).nth(1).unwrap();
        let i = i.start - before..i.end + behind;
        Row { k, j, i }
    }

    #[test]
    fn a_row_of_its_layer_is_written() {
        assert_eq!(write(&row(4, [0, 0])), Ok(true));
    }

    #[test]
    #[cfg_attr(debug_assertions, should_panic(expected = "rows of its layer"))]
    fn a_row_of_another_layer_is_a_bug() {
        assert!(matches!(write(&row(3, [0, 0])), Err(Error::Bug { .. })));
    }

    #[test]
    #[cfg_attr(debug_assertions, should_panic(expected = "rows of its layer"))]
    fn a_row_that_begins_too_soon_is_a_bug() {
        assert!(matches!(write(&row(4, [1, 0])), Err(Error::Bug { .. })));
    }

    #[test]
    #[cfg_attr(debug_assertions, should_panic(expected = "rows of its layer"))]
    fn a_row_that_ends_too_late_is_a_bug() {
        assert!(matches!(write(&row(4, [0, 1])), Err(Error::Bug { .. })));
    }
}
