//! The choice of a method for a question, and its cost. Both are determined before any force is computed.

use alloc::vec::Vec;
use core::fmt;

use num_bigint::{BigInt, BigUint};
use num_traits::Zero;

use super::grid::Grid;
use super::limbs::{Size, bound};
use super::lines::LineForces;
use super::question::{Method, Quantity};
use super::tree::{MAX_NODES, size_of_tree};
use crate::Error;
use crate::Pile;
use crate::each::Each;
use crate::lattice::{Dimension, Region, Site};
use crate::scalar::{Algebra, Exactness};
use crate::shape::{Rows, Shape};

/// The maximum number of spheres of a row that share a tree.
pub(crate) const CHUNK: i128 = 1024;

/// The method that computes a quantity for a part of a pile, and its cost.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Region;
/// use cannonpile::shape::Selection;
/// use cannonpile::{Method, Pile};
///
/// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
/// let plan = pile.plan(Selection::Base)?;
/// assert_eq!(plan.method, Method::Sweep);
/// assert_eq!(plan.to_string(), "sweep: 68 spheres visited, 648 bytes for numbers of 12 bits");
///
/// // A base of more than 10³⁰ rows is computed row by row, with a tree for each piece of a row.
/// let high = Pile::under(Region::SITE, format!("(2,1,{})", 10_i128.pow(30)).parse()?)?;
/// assert_eq!(high.plan(Selection::Base)?.method, Method::Tree);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Plan {
    /// The method that computes the forces.
    pub method: Method,
    /// The number of rows in the answer.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub rows: BigUint,
    /// The maximum number of spheres whose forces are computed or looked up. A sweep computes those at the sign changes
    /// above too.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub visited: BigUint,
    /// The bits that the exact numerators of a sweep may need, by the proved bound. 0 for the other methods, whose numbers
    /// grow as required.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub bits: u64,
    /// The memory for the numbers of a sweep, in bytes. 0 for the other methods.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub bytes: BigUint,
}

impl fmt::Display for Plan {
    /// `sweep: 68 spheres visited, 648 bytes for numbers of 12 bits`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            method,
            visited,
            bits,
            bytes,
            ..
        } = self;
        write!(f, "{method}: {visited} spheres visited")?;
        match method {
            Method::Closed | Method::Tree => Ok(()),
            Method::Sweep => write!(f, ", {bytes} bytes for numbers of {bits} bits"),
        }
    }
}

/// Returns whether the trees with `above` spheres cost less than a sweep over `sweep` spheres.
pub(crate) fn trees_are_cheaper(above: &BigUint, sweep: &BigUint) -> bool {
    /// The cost of one sphere of a tree, as a number of spheres of a sweep.
    const COST_OF_A_TREE: u32 = 16;
    above * COST_OF_A_TREE < *sweep
}

/// Returns the answer of the first method, or that of the other one if the first is too large. If both are, returns the
/// error of the first.
pub(crate) fn unless_too_large<A>(
    first: impl FnOnce() -> Result<A, Error>,
    other: impl FnOnce() -> Result<A, Error>,
) -> Result<A, Error> {
    match first() {
        Err(too_large @ Error::TooLarge { .. }) => other().map_err(|error| {
            if matches!(error, Error::TooLarge { .. }) {
                too_large
            } else {
                error
            }
        }),
        answer => answer,
    }
}

impl Pile {
    /// Returns an error if a method does not apply to the pile.
    pub(crate) fn check_method(&self, method: Method) -> Result<(), Error> {
        let applies = match method {
            Method::Closed => self.shape().stacking().is_straight(),
            Method::Tree => true,
            Method::Sweep => self.dimension() == Dimension::Three,
        };
        if applies {
            Ok(())
        } else {
            Err(Error::NoSuchMethod { method })
        }
    }

    /// Returns the width of the numbers of an exact sweep down to layer `last`, including a sign change there.
    pub(crate) fn size_of_sweep(&self, last: i128) -> Size {
        let changes = self.shape().changes_above(last + 1);
        Size::new(&self.bound_of_sweep(last), changes)
    }

    /// Returns an upper bound of 2√3·B·D for an exact sweep down to layer `last`, before sign changes triple the
    /// numbers.
    pub(crate) fn bound_of_sweep(&self, last: i128) -> BigInt {
        let [ordinary, extras] = self.magnitudes();
        let spheres = self.shape().spheres_in(0..last + 1);
        bound(last + 1, &spheres, &ordinary, &extras)
    }

    pub(crate) fn check_on_floor(&self, rows: &Rows<'_>) -> Result<(), Error> {
        let floor = self.layers() - 1;
        match rows.clone().flatten().next() {
            Some(site) if site.k != floor => Err(Error::NotOnFloor { site, floor }),
            _ => Ok(()),
        }
    }
}

impl Shape {
    /// Plans a tree for each piece of a row.
    fn plan_trees(&self, closed: &Plan, rows: &Rows<'_>) -> Result<Plan, Error> {
        let last = last_of(rows);
        let sites = rows.site_count();
        let mut pieces = BigUint::from(1_u32);
        if rows.one().is_none() {
            let (layers, height) = (rows.layers(), self.layer(last)?.widths()[1]);
            let layers = (layers.end - layers.start).max(0).unsigned_abs();
            // Each row may end with a shorter piece.
            pieces = BigUint::from(layers) * (height.unsigned_abs() + 1);
            pieces += &sites / CHUNK.unsigned_abs();
        }
        // Each sphere below a sign change depends on at most three spheres at it, and the size of that layer limits
        // their number.
        let most = BigUint::from(MAX_NODES);
        let mut level = BigUint::from(CHUNK.unsigned_abs()).min(sites.clone());
        let mut above = BigUint::zero();
        let mut run = self.run_to(last).filter(|run| run.index > 0);
        while let (Some(lowest), true) = (run, above <= most) {
            level = (level * 3_u32).min(self.layer(lowest.from)?.site_count());
            above += &level;
            run = self.run(lowest.index - 1);
            run = run.filter(|run| run.index > 0);
        }
        if above > most {
            // This bound is not sharp, so the nodes of the trees are counted. No tree may have more than `most`.
            match rows.one() {
                Some(Site { i, j, k }) => {
                    size_of_tree(self, k, &[[i, j]])?;
                }
                None => self.sample_trees(last)?,
            }
            above = most;
        }
        Ok(Plan {
            method: Method::Tree,
            visited: above * pieces + sites,
            ..closed.clone()
        })
    }

    /// Returns an error if a tree of layer `k` is too large, judged by four sample pieces. Other pieces may still be
    /// refused when they are computed.
    fn sample_trees(&self, k: i128) -> Result<(), Error> {
        for piece in samples(&self.layer(k)?) {
            size_of_tree(self, k, &piece)?;
        }
        Ok(())
    }
}

impl<T: Algebra> LineForces<'_, T> {
    /// Returns the number of 64-bit words of each value of a sweep whose exact numbers need this many limbs.
    pub(super) fn words(&self, limbs: usize, are_limbs: bool) -> usize {
        let own = size_of::<T::Numerator>().div_ceil(size_of::<i64>());
        match T::EXACTNESS {
            Exactness::Exact if are_limbs && !self.has_scalar_loads => limbs,
            // The digits of a big integer are stored on the heap.
            Exactness::Exact => own + limbs,
            _ => own,
        }
    }

    /// Returns the method and its cost for a question about the spheres in `rows`.
    ///
    /// # Errors
    /// [`Error::NoSuchMethod`], [`Error::NotOnFloor`], [`Error::TooLarge`].
    pub(crate) fn plan(
        &self,
        rows: &Rows<'_>,
        quantity: Quantity,
        method: Option<Method>,
    ) -> Result<Plan, Error> {
        if let Some(method) = method {
            self.pile.check_method(method)?;
        }
        let mut answers = rows.site_count();
        match quantity {
            Quantity::Contacts => answers *= self.shape.dimension().directions().len(),
            Quantity::Floor => self.pile.check_on_floor(rows)?,
        }
        let closed = Plan {
            method: Method::Closed,
            rows: answers,
            visited: rows.site_count(),
            bits: 0,
            bytes: BigUint::zero(),
        };
        let is_one = rows.one().is_some();
        let by_trees = || self.shape.plan_trees(&closed, rows);
        let by_sweep = || self.plan_sweep(&closed, rows, !is_one);
        match method {
            Some(Method::Closed) => Ok(closed.clone()),
            None if self.shape.stacking().is_straight() => Ok(closed.clone()),
            Some(Method::Tree) => by_trees(),
            Some(Method::Sweep) => self.plan_sweep(&closed, rows, true),
            // A query for a single sphere falls back to a sweep if the tree is too large.
            None if is_one => unless_too_large(by_trees, by_sweep),
            // If the sweep does not fit in memory, the rows are computed one by one.
            None => match by_sweep() {
                Err(Error::TooLarge { .. }) => by_trees(),
                plan => plan,
            },
        }
    }

    /// Plans one sweep, down to the last layer of `rows`.
    fn plan_sweep(&self, closed: &Plan, rows: &Rows<'_>, are_limbs: bool) -> Result<Plan, Error> {
        let last = last_of(rows);
        let size = self.pile.size_of_sweep(last);
        let words = Grid::numbers(self.shape, last, self.words(size.planes, are_limbs))?;
        let first = rows.one().map_or(rows.layers().start, |site| site.k);
        Ok(Plan {
            method: Method::Sweep,
            visited: &closed.visited + self.shape.spheres_at_changes_above(first),
            bits: size.bits,
            bytes: words * size_of::<i64>(),
            ..closed.clone()
        })
    }
}

/// Returns four pieces of rows, each for one tree. They lie in the middle row and in the row of the mean corner, at the
/// middle of the row and at the mean corner.
fn samples(region: &Region) -> impl Iterator<Item = Vec<[i128; 2]>> + use<> {
    let corners = region.corners();
    let mean = |axis: usize| corners.iter().map(|corner| corner[axis]).sum::<i128>() / 6;
    let [i, j] = [0, 1].each(mean);
    let rows = [region.y().start().midpoint(*region.y().end()), j].each(|j| (j, region.row(j)));
    rows.into_iter().flat_map(move |(j, row)| {
        [row.start.midpoint(row.end - 1), i].each(|middle| {
            let piece = middle - CHUNK / 2..middle + CHUNK / 2;
            piece.filter(|i| row.contains(i)).map(|i| [i, j]).collect()
        })
    })
}

/// Returns the lowest layer of some rows.
pub(crate) fn last_of(rows: &Rows<'_>) -> i128 {
    let last = match rows.one() {
        Some(site) => site.k,
        None => rows.layers().end - 1,
    };
    last.max(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tree_costs_sixteen_spheres_of_a_sweep() {
        let are_cheaper = |above: u32, sweep: u32| trees_are_cheaper(&above.into(), &sweep.into());
        assert!(are_cheaper(10, 161) && are_cheaper(0, 1) && are_cheaper(1, 1000));
        assert!(!are_cheaper(10, 160) && !are_cheaper(10, 159) && !are_cheaper(1000, 1000));
    }

    /// The other method replaces one that is too large, but not one that was interrupted.
    #[test]
    fn a_method_that_is_too_large_is_replaced() {
        let too_large = |quantity| crate::error::refuse_beyond(quantity, 2_u32, 1, "take less");
        let both = unless_too_large(|| too_large("a tree"), || too_large("a sweep"));
        assert_eq!(both, too_large("a tree"));
        assert_eq!(unless_too_large(|| too_large("a tree"), || Ok(())), Ok(()));
        let interrupted = || Err(Error::Interrupted);
        assert_eq!(unless_too_large(|| Ok(()), interrupted), Ok(()));
        assert_eq!(
            unless_too_large(interrupted, || Ok(())),
            Err(Error::Interrupted)
        );
        let ended = unless_too_large(|| too_large("a tree"), interrupted);
        assert_eq!(ended, Err(Error::Interrupted));
    }

    fn row(i: core::ops::Range<i128>, j: i128) -> Vec<[i128; 2]> {
        i.map(|i| [i, j]).collect()
    }

    /// The rows 0 … 30 have 5000, 4999, … sites. The corners are (0, 0) twice, (4999, 0) twice, (4969, 30) and (0, 30),
    /// with the mean (2494, 10).
    #[test]
    fn sample_pieces_are_in_the_middle() {
        let region = Region::new(0..=4999, 0..=30, 0..=4999).unwrap();
        let pieces: Vec<_> = samples(&region).collect();
        let middle = [row(1980..3004, 15), row(1982..3006, 15)];
        let mean = [row(1982..3006, 10), row(1982..3006, 10)];
        assert_eq!(pieces, [middle, mean].concat());
        // A shorter row is one piece.
        let low = Region::triangle(4).unwrap();
        assert!(samples(&low).all(|piece| piece == row(0..3, 1)));
    }
}
