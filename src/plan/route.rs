//! The one decision how forces are found, for plans and for whoever carries them out.

use alloc::vec::Vec;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::Method;
use crate::lattice::Dimension;
use crate::lines::Lines;
use crate::scalar::{Algebra, Exactness};
use crate::shape::Rows;
use crate::sweep::{Grid, Size, bound};
use crate::{Error, Pile};

/// How many spheres of a row share one tree.
pub(crate) const CHUNK: i128 = 1024;

/// The way to the forces on the spheres of some rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Route {
    Closed,
    /// A piece of a row at a time.
    Tree,
    /// In exact numerators of this size, or in the numbers of another scalar.
    Sweep(Size),
}

/// Whether trees above some spheres cost less than a sweep over others.
pub(crate) fn trees_are_cheaper(above: &BigUint, sweep: &BigUint) -> bool {
    /// How many spheres of a sweep cost as much as one of a tree, roughly.
    const COST_OF_A_TREE: u32 = 16;
    above * COST_OF_A_TREE < *sweep
}

impl Pile {
    /// The cheapest way to the forces on the spheres of `rows` in the scalar `T`, or the one asked for.
    ///
    /// # Errors
    /// [`Error::NoSuchMethod`] if the method asked for does not apply; [`Error::TooLarge`] if a sweep is asked for that
    /// does not fit in memory.
    pub(crate) fn route<T: Algebra>(
        &self,
        rows: &Rows<'_>,
        asked: Option<Method>,
    ) -> Result<Route, Error> {
        let straight = self.shape().stacking().is_straight();
        let last = super::last_of(rows);
        let sweep = || {
            let size = self.size_of_sweep(last);
            let words = match T::EXACTNESS {
                Exactness::Exact => size.planes,
                _ => size_of::<T::Numerator>().div_ceil(size_of::<i64>()),
            };
            Grid::numbers(self.shape(), last, words).map(|_| Route::Sweep(size))
        };
        if let Some(method) = asked {
            self.check_method(method)?;
        }
        match asked {
            Some(Method::Closed) => Ok(Route::Closed),
            Some(Method::Tree) => Ok(Route::Tree),
            Some(Method::Sweep) => sweep(),
            None if straight => Ok(Route::Closed),
            None if rows.one().is_some() => Ok(Route::Tree),
            None => Ok(sweep().unwrap_or(Route::Tree)),
        }
    }

    /// That a method applies, as far as that does not depend on the question.
    pub(crate) fn check_method(&self, method: Method) -> Result<(), Error> {
        let applies = match method {
            Method::Closed => self.shape().stacking().is_straight(),
            Method::Tree => true,
            // The third line of a disc, which carries nothing, has no place in a layer.
            Method::Sweep => self.dimension() == Dimension::Three,
        };
        if applies {
            Ok(())
        } else {
            Err(Error::NoSuchMethod { method })
        }
    }

    /// That the pieces of rows of layer `k` have trees that are not too large, as far as those in the middle show it: the
    /// middle of the rows, and of the corners.
    pub(super) fn check_trees(&self, k: i128) -> Result<(), Error> {
        let region = self.shape().layer(k)?;
        let corners = region.corners();
        let mean = |axis: usize| corners.iter().map(|corner| corner[axis]).sum::<i128>() / 6;
        for j in [region.y().start().midpoint(*region.y().end()), mean(1)] {
            let row = region.row(j);
            for middle in [row.start.midpoint(row.end - 1), mean(0)] {
                let piece = middle - CHUNK / 2..middle + CHUNK / 2;
                let sites: Vec<_> = piece.filter(|i| row.contains(i)).map(|i| [i, j]).collect();
                Lines::<BigRational>::new(self).check_tree(k, &sites)?;
            }
        }
        Ok(())
    }

    /// How wide the exact numerators of a sweep down to layer `last` are.
    pub(crate) fn size_of_sweep(&self, last: i128) -> Size {
        let changes = self
            .shape()
            .stretch_to(last + 1)
            .or(self.shape().stretch_to(last));
        let changes = changes.map_or(0, |run| run.index);
        Size::new(&self.bound_of_sweep(last), changes)
    }

    /// No less than 2√3·B·D: B no less than any force in f₀ down to layer `last`, D the common denominator of weights
    /// and loads.
    pub(crate) fn bound_of_sweep(&self, last: i128) -> BigInt {
        let lines = Lines::<BigRational>::new(self);
        let scale = BigRational::from_integer(lines.scale(0));
        let extras = self.loading().extras().map(|(_, extra)| extra.abs());
        let extras = extras.fold(BigRational::zero(), |sum, extra| sum + extra) * scale;
        // An integer: the scale is a multiple of all denominators.
        let extras: BigInt = extras.to_integer();
        let spheres = self.shape().spheres_in(0..last + 1);
        let own = lines.increments_after(0).into_iter().max();
        bound(last + 1, &spheres, &own.unwrap_or_default(), &extras)
    }
}
