//! Where the forces of many spheres come from, sphere after sphere in row order.

use alloc::boxed::Box;
use alloc::vec::Vec;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use super::{FloorForce, Statics, edge_all};
use crate::Error;
use crate::geometry::Vector;
use crate::lattice::Site;
use crate::lines::{Lines, Wanted};
use crate::meter::Meter;
use crate::plan::{CHUNK, Route, last_of, trees_are_cheaper};
use crate::scalar::{Algebra, Exactness};
use crate::shape::{Rows, Selection};
use crate::sweep::{Cells, Descent, Grid, Planes};

/// The forces of the spheres of some rows.
pub(super) enum Source<'p, T: Algebra, M> {
    /// Each sphere by itself: of a straight stacking, or one alone.
    Each,
    /// A piece of a row at a time.
    Tree(Option<Piece<T>>),
    /// One layer in memory, in the numbers of the scalar.
    Sweep(Box<Descent<'p, T, Cells<T::Numerator>>>),
    /// One layer in memory, in the exact engine, for a scalar that is exact itself.
    Integers(Box<Integers<'p, M>>),
    /// The method asked for does not do.
    Refused(Error),
}

/// A sweep of the exact engine, and the questions put to it.
pub(super) struct Integers<'p, M> {
    statics: Statics<'p, BigRational, M>,
    sweep: Descent<'p, BigRational, Planes>,
}

/// Consecutive spheres of a row with the forces from above on them.
pub(super) struct Piece<T: Algebra> {
    first: Site,
    forces: Vec<[T::Numerator; 3]>,
    changes: usize,
}

impl<'p, T: Algebra, M: Meter> Source<'p, T, M> {
    pub(super) fn new(statics: &Statics<'p, T, M>, rows: &Rows<'p>) -> Self {
        // The rows of another pile are asked for site by site, and checked.
        if !core::ptr::eq(rows.shape(), statics.pile.shape()) {
            return Self::Each;
        }
        let route = statics.pile.route::<T>(rows, statics.method);
        let source = route.and_then(|route| Self::by(route, statics, rows));
        source.unwrap_or_else(Self::Refused)
    }

    fn by(route: Route, statics: &Statics<'p, T, M>, rows: &Rows<'p>) -> Result<Self, Error> {
        let (pile, last) = (statics.pile, last_of(rows));
        Ok(match route {
            Route::Closed => Self::Each,
            Route::Tree if rows.one().is_some() => Self::Each,
            Route::Tree => Self::Tree(None),
            Route::Sweep(size) if T::EXACTNESS == Exactness::Exact => {
                let grid = Grid::new(pile.shape(), last, size.planes)?;
                let layer = Planes::new(&grid, pile.bound_of_sweep(last));
                Self::Integers(Box::new(Integers {
                    statics: pile.statics().metered(statics.meter),
                    sweep: Descent::new(Lines::new(pile), grid, layer),
                }))
            }
            Route::Sweep(_) => Self::Sweep(Box::new(generic_sweep(statics, last)?)),
        })
    }

    /// The force of a bottom sphere on the floor.
    pub(super) fn on_floor(
        &mut self,
        statics: &Statics<'p, T, M>,
        site: Site,
    ) -> Result<FloorForce<T>, Error> {
        if site.k != statics.floor() {
            return statics.on_floor(site);
        }
        match self {
            Self::Each => statics.on_floor(site),
            Self::Tree(piece) => {
                let (above, changes) = Piece::at(piece, statics, site)?;
                statics.floor_force(site, &above, changes)
            }
            Self::Sweep(sweep) => {
                sweep.advance(site.k, statics.meter);
                statics.meter.visit(1);
                let (above, changes) = sweep.received(site);
                statics.floor_force(site, &above, changes)
            }
            Self::Refused(error) => Err(error.clone()),
            Self::Integers(integers) => {
                let Integers { statics, sweep } = &mut **integers;
                sweep.advance(site.k, statics.meter);
                statics.meter.visit(1);
                let (above, changes) = sweep.received(site);
                let force = statics.floor_force(site, &above, changes)?;
                Ok(FloorForce {
                    site,
                    normal: T::from_rational(&force.normal),
                    shear_x: T::from_rational(&force.shear_x),
                    shear_y: T::from_rational(&force.shear_y),
                })
            }
        }
    }

    /// The forces to the spheres below one that is not on the floor.
    pub(super) fn passed_on(
        &mut self,
        statics: &Statics<'p, T, M>,
        site: Site,
    ) -> Result<[T; 3], Error> {
        // In the rows of another pile.
        if site.k == statics.floor() {
            return Err(Error::OnFloor { site });
        }
        let (forces, changes) = match self {
            Self::Each => statics.passed_on(site)?,
            Self::Refused(error) => return Err(error.clone()),
            Self::Tree(piece) => {
                let (above, changes) = Piece::at(piece, statics, site)?;
                statics.lines.to_below(site, above, changes, statics.meter)
            }
            Self::Sweep(sweep) => {
                sweep.advance(site.k, statics.meter);
                statics.meter.visit(1);
                sweep.passed_on(site, statics.meter)
            }
            Self::Integers(integers) => {
                let Integers { statics, sweep } = &mut **integers;
                sweep.advance(site.k, statics.meter);
                statics.meter.visit(1);
                let (forces, changes) = sweep.passed_on(site, statics.meter);
                let scale = statics.lines.scale(changes);
                return Ok(
                    forces.map(|force| T::from_rational(&BigRational::new(force, scale.clone())))
                );
            }
        };
        edge_all("a contact force", forces, &statics.lines.scale(changes))
    }
}

/// A sweep down to layer `last` in the numbers of the scalar.
fn generic_sweep<'p, T: Algebra, M>(
    statics: &Statics<'p, T, M>,
    last: i128,
) -> Result<Descent<'p, T, Cells<T::Numerator>>, Error> {
    let mut words = size_of::<T::Numerator>().div_ceil(size_of::<i64>());
    if T::EXACTNESS == Exactness::Exact {
        // Integers keep their digits elsewhere.
        words += statics.pile.size_of_sweep(last).planes;
    }
    let grid = Grid::new(statics.pile.shape(), last, words)?;
    let layer = Cells::new(&grid, &T::Numerator::zero());
    Ok(Descent::new(statics.lines.clone(), grid, layer))
}

/// The forces from above on one sphere, after a sweep of the whole layer.
pub(super) fn received_by_sweep<T: Algebra, M: Meter>(
    statics: &Statics<'_, T, M>,
    site: Site,
) -> Result<([T::Numerator; 3], usize), Error> {
    let mut sweep = generic_sweep(statics, site.k)?;
    sweep.advance(site.k, statics.meter);
    statics.meter.visit(1);
    Ok(sweep.received(site))
}

impl<T: Algebra> Piece<T> {
    /// The forces from above on a sphere: from the piece it is in, or from a new one that begins with it.
    fn at<M: Meter>(
        piece: &mut Option<Self>,
        statics: &Statics<'_, T, M>,
        site: Site,
    ) -> Result<([T::Numerator; 3], usize), Error> {
        if let Some(found) = piece.as_ref().and_then(|piece| piece.get(site)) {
            return Ok(found);
        }
        let Site { i, j, k } = statics.pile.shape().check(site)?;
        let end = statics.pile.shape().layer(k)?.row(j).end;
        let sites: Vec<[i128; 2]> = (i..end.min(i + CHUNK)).map(|i| [i, j]).collect();
        let above = statics.above(k, &sites, Wanted::All)?;
        let new = piece.insert(Self {
            first: site,
            forces: above.forces,
            changes: above.changes,
        });
        // The piece begins with the site.
        new.get(site).ok_or(Error::LayerOutside {
            layer: k,
            layers: statics.pile.layers(),
        })
    }

    fn get(&self, site: Site) -> Option<([T::Numerator; 3], usize)> {
        let same_row = (site.k, site.j) == (self.first.k, self.first.j);
        let place = usize::try_from(site.i.checked_sub(self.first.i)?).ok()?;
        let forces = self.forces.get(place).filter(|_| same_row)?;
        Some((forces.clone(), self.changes))
    }
}

impl Statics<'_, BigRational> {
    /// Shows the forces of bottom spheres on the floor as integers (shear_x, shear_y, normal), and returns the
    /// denominator of all of them: of the corners of a straight pile under one sphere; of those spheres between which
    /// the forces are linear, where they are far fewer; or of every bottom sphere.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more than 10⁸ of them.
    pub(crate) fn ends_of_base(
        &self,
        mut meet: impl FnMut(&Vector<BigInt>),
    ) -> Result<BigInt, Error> {
        const MOST: u64 = 100_000_000;
        let (shape, floor) = (self.pile.shape(), self.floor());
        let changes = shape.stretch_to(floor).map_or(0, |run| run.index);
        let mut meet = |site, above: &[BigInt; 3]| {
            meet(&self.floor_numerators(site, above, changes).0);
        };
        let rows = self.pile.rows(Selection::Base)?;
        let (sites, ends) = (rows.sites(), self.lines.most_ends_of_pieces(floor));
        if self.pile.is_paper_pile() {
            for corner in rows.corners() {
                meet(corner, &self.received(corner, Wanted::All)?.0);
            }
        } else if sites.clone().min(ends.clone()) > MOST.into() {
            return Err(Error::TooLarge {
                quantity: "the extremes over this base",
                needed: sites.min(ends),
                limit: MOST,
                remedy: "ask for single spheres",
            });
        } else if trees_are_cheaper(&ends, &sites) {
            for (_, row) in self.lines.ends_of_pieces(floor) {
                let above = self.lines.forces_above(floor, &row, Wanted::All)?;
                for ([i, j], above) in row.into_iter().zip(&above.forces) {
                    meet(Site { i, j, k: floor }, above);
                }
            }
        } else {
            let mut source = Source::new(self, &rows);
            for site in rows.flatten() {
                meet(site, &source.received(self, site)?.0);
            }
        }
        Ok(self.lines.scale(changes) * &self.direction_scale * &self.increment_sum)
    }
}

impl<'p> Source<'p, BigRational, ()> {
    /// The forces from above on a sphere of the last layer, as integers, and the changes of sign before.
    fn received(
        &mut self,
        statics: &Statics<'p, BigRational>,
        site: Site,
    ) -> Result<([BigInt; 3], usize), Error> {
        match self {
            Self::Each => statics.received(site, Wanted::All),
            Self::Tree(piece) => Piece::at(piece, statics, site),
            Self::Refused(error) => Err(error.clone()),
            Self::Sweep(sweep) => {
                sweep.advance(site.k, ());
                Ok(sweep.received(site))
            }
            Self::Integers(integers) => {
                integers.sweep.advance(site.k, ());
                Ok(integers.sweep.received(site))
            }
        }
    }
}
