//! The bottom spheres at which functions of the force on the floor take their extremes.

use alloc::vec::Vec;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

use super::Forces;
use crate::Error;
use crate::engine::{
    Engine, LineSelection, MAX_NODES, Meter, Planes, Quantity, SphereForces, Sweep,
    check_interrupt, shortest_exact_sweep, size_of_tree, trees_are_cheaper,
};
use crate::error::refuse_beyond;
use crate::geometry::Vector;
use crate::lattice::Site;
use crate::shape::Selection;

impl Forces<'_, BigRational> {
    /// Calls `visit` with the forces of some bottom spheres on the floor, as integers (shear_x, shear_y, normal).
    /// Returns their common denominator.
    ///
    /// The extremes over the base are among these spheres. In a straight pile under one sphere they are the corners. In
    /// other piles they are the spheres between which the forces are linear, if these are far fewer than all. Otherwise
    /// they are all bottom spheres, up to symmetry.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more than 10⁸ spheres.
    pub(crate) fn ends_of_base(
        &self,
        mut visit: impl FnMut(&Vector<BigInt>),
    ) -> Result<BigInt, Error> {
        const MOST: u64 = 100_000_000;
        let (lines, floor) = (&self.lines, self.bottom());
        let shape = lines.shape;
        let unit = lines.floor_unit(shape.changes_above(floor));
        let mut visit = |site, above: &SphereForces<BigRational>| {
            visit(&lines.floor_numerators(site, above).0);
        };
        let rows = self.pile.rows(Selection::Base)?;
        if self.pile.is_paper_pile() {
            for corner in rows.corners() {
                visit(corner, &self.received(corner, LineSelection::All)?);
            }
            return Ok(unit);
        }
        let (sites, ends) = (rows.site_count(), lines.most_ends_of_pieces(floor)?);
        refuse_beyond(
            "the extremes over this base",
            sites.clone().min(ends.clone()),
            MOST,
            "ask for single spheres",
        )?;
        // The bound of the number of ends is not sharp.
        let are_few = &ends * 2_u32 < sites;
        let by_trees =
            |row: &[[i128; 2]]| lines.forces_above(floor, row, LineSelection::All, Meter::NONE);
        if are_few && trees_are_cheaper(&(ends + self.trees_of_base()?), &sites) {
            self.visit_ends(by_trees, &mut visit)?;
            return Ok(unit);
        }
        let sweep = if shape.stacking().is_straight() {
            None
        } else {
            match shortest_exact_sweep(lines, floor) {
                Err(Error::TooLarge { .. }) => None,
                sweep => Some(sweep?),
            }
        };
        match sweep {
            Some(mut sweep) => {
                sweep.advance(floor, Meter::NONE)?;
                if are_few {
                    let received = |[i, j]: &[i128; 2]| {
                        let (i, j, k) = (*i, *j, floor);
                        sweep.received(Site { i, j, k })
                    };
                    let by_sweep = |row: &[[i128; 2]]| row.iter().map(received).collect();
                    self.visit_ends(by_sweep, &mut visit)?;
                } else {
                    self.visit_all(&sweep, &mut visit)?;
                }
            }
            None if are_few => self.visit_ends(by_trees, &mut visit)?,
            None => {
                let plan = lines.plan(&rows, Quantity::Floor, self.method)?;
                let engine = Engine::new(&plan, &rows, lines)?;
                let most = engine.sites_at_once(lines);
                for row in rows.flat_map(|row| row.pieces(most)) {
                    check_interrupt()?;
                    let received = engine.received_in(lines, &row, Meter::NONE);
                    for (site, above) in row.into_iter().zip(received) {
                        visit(site, &above?);
                    }
                }
            }
        }
        Ok(unit)
    }

    /// Estimates the number of spheres in all trees, one for each row of the base. Most rows have a sphere below one at the
    /// last sign change, so the tree of the middle sphere there stands for all of them.
    fn trees_of_base(&self) -> Result<BigUint, Error> {
        let shape = self.lines.shape;
        let floor = self.bottom();
        let Some(run) = shape.run_to(floor) else {
            return Ok(BigUint::ZERO);
        };
        let region = shape.layer(run.from)?;
        let j = region.y().start().midpoint(*region.y().end());
        let row = region.row(j);
        let middle = [row.start.midpoint(row.end - 1), j];
        let nodes = match size_of_tree(shape, run.from, &[middle]) {
            // It counts as the largest possible tree.
            Err(Error::TooLarge { .. }) => MAX_NODES,
            nodes => nodes?,
        };
        let rows = shape.layer(floor)?.widths()[1].unsigned_abs();
        Ok(BigUint::from(rows) * nodes)
    }

    /// Visits the spheres between which the forces are linear. The function `above` returns the forces from above on spheres
    /// of a row.
    fn visit_ends(
        &self,
        above: impl Fn(&[[i128; 2]]) -> Result<Vec<SphereForces<BigRational>>, Error>,
        visit: &mut impl FnMut(Site, &SphereForces<BigRational>),
    ) -> Result<(), Error> {
        let k = self.bottom();
        for (_, row) in self.lines.ends_of_pieces(k)? {
            check_interrupt()?;
            for ([i, j], above) in row.iter().zip(above(&row)?) {
                visit(Site { i: *i, j: *j, k }, &above);
            }
        }
        Ok(())
    }

    /// Visits the bottom spheres up to symmetry, with a sweep that has reached the base.
    fn visit_all(
        &self,
        sweep: &Sweep<'_, BigRational, Planes>,
        visit: &mut impl FnMut(Site, &SphereForces<BigRational>),
    ) -> Result<(), Error> {
        // Symmetric images have the same normal force and the same magnitude of shear, so one part is enough.
        let mut last = None;
        for site in sweep.part().rows(self.bottom()).flatten() {
            check_interrupt()?;
            // On a uniform base most spheres are extreme, so repeated values are skipped.
            let is_repeated = match last {
                Some(last) => sweep.are_alike([last, site])?,
                None => false,
            };
            if !is_repeated {
                visit(site, &sweep.received(site)?);
                last = Some(site);
            }
        }
        Ok(())
    }
}
