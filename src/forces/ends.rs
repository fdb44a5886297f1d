//! The bottom spheres at which functions of the force on the floor take their extremes.

use num_bigint::BigInt;
use num_rational::BigRational;

use super::Forces;
use super::screen::Screen;
use crate::Error;
use crate::engine::{
    Engine, Meter, Method, Quantity, Received, Wanted, shortest_exact_sweep, trees_are_cheaper,
};
use crate::error::refuse_beyond;
use crate::geometry::Vector;
use crate::lattice::Site;
use crate::shape::Selection;

impl Forces<'_, BigRational> {
    /// Calls `visit` with the forces of some bottom spheres on the floor, as integers (shear_x, shear_y, normal).
    /// Returns their common denominator. `across` is 4cos²φ.
    ///
    /// The extremes over the base are among these spheres. In a straight pile under one sphere they are the corners. In
    /// other piles they are the spheres between which the forces are linear, if these are far fewer than all. Otherwise
    /// they are all bottom spheres that correctly rounded floats do not exclude.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more than 10⁸ spheres.
    pub(crate) fn ends_of_base(
        &self,
        across: &BigRational,
        mut visit: impl FnMut(&Vector<BigInt>),
    ) -> Result<BigInt, Error> {
        const MOST: u64 = 100_000_000;
        let (terms, floor) = (&self.terms, self.floor());
        let (lines, shape) = (&terms.lines, terms.system.shape);
        let changes = shape.changes_above(floor);
        let mut visit = |site, above: &Received<BigRational>| {
            visit(&terms.floor_numerators(site, above).0);
        };
        let rows = self.pile.rows(Selection::Base)?;
        let (sites, ends) = (rows.site_count(), lines.most_ends_of_pieces(floor)?);
        if self.pile.is_paper_pile() {
            for corner in rows.corners() {
                visit(corner, &self.received(corner, Wanted::All)?);
            }
            return Ok(terms.floor_unit(changes));
        }
        refuse_beyond(
            "the extremes over this base",
            sites.clone().min(ends.clone()),
            MOST,
            "ask for single spheres",
        )?;
        if trees_are_cheaper(&ends, &sites) {
            for (_, row) in lines.ends_of_pieces(floor)? {
                let above = lines.forces_above(floor, &row, Wanted::All)?;
                let changes = above.changes;
                for ([i, j], forces) in row.into_iter().zip(above.forces) {
                    visit(Site { i, j, k: floor }, &Received { forces, changes });
                }
            }
        } else {
            let plan = self.plan(&rows, Quantity::FloorMultiples)?;
            if plan.method == Method::Sweep {
                let mut sweep = shortest_exact_sweep(lines, &terms.system, floor)?;
                sweep.advance(floor, Meter::NONE)?;
                // Symmetric images have the same normal force and the same magnitude of shear, so one part is enough.
                let part = sweep.part()?;
                let mut screen = Screen::new((terms, &sweep), across);
                if let Some(screen) = &mut screen {
                    // The extremes of a sample of rows come first. Then few spheres of the other rows are candidates.
                    for row in part.rows(floor).step_by(16) {
                        screen.candidates(row)?;
                    }
                }
                let mut last = None;
                for row in part.rows(floor) {
                    let sites = match &mut screen {
                        Some(screen) => screen.candidates(row)?,
                        None => row.into_iter().collect(),
                    };
                    for site in sites {
                        // On a uniform base most spheres are extreme, so repeated values are skipped.
                        let alike = match last {
                            Some(last) => sweep.are_alike([last, site])?,
                            None => false,
                        };
                        if !alike {
                            visit(site, &sweep.received(site)?);
                            last = Some(site);
                        }
                    }
                }
            } else {
                let engine = Engine::exact(&plan, &rows, (lines, &terms.system))?;
                for row in rows {
                    let received = engine.received_in((lines, &terms.system), &row, Meter::NONE);
                    for (site, above) in row.into_iter().zip(received) {
                        visit(site, &above?);
                    }
                }
            }
        }
        Ok(terms.floor_unit(changes))
    }
}
