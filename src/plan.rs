//! How a question is answered, and how much it takes: decided before anything is computed.

use alloc::vec::Vec;
use core::fmt;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::lattice::{Direction, Selection, Site};
use crate::lines::Lines;
use crate::query::CHUNK;
use crate::sweep::{Grid, Size};
use crate::{Error, Pile};

/// How forces are found.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Selection;
/// use cannonpile::{Method, Pile};
///
/// assert_eq!(Pile::triangular(10)?.plan(Selection::All)?.method, Method::Closed);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Method {
    /// By counting the spheres on three lines: O(1) a force. For stackings without a change of sign.
    Closed,
    /// From the lines above one sphere, which begin at the changes of sign: the cost follows the changes, not the
    /// layers.
    Tree,
    /// Layer after layer from the top, a run at a time, with one layer in memory.
    Sweep,
}

impl fmt::Display for Method {
    /// `closed`, `tree`, `sweep`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Closed => "closed",
            Self::Tree => "tree",
            Self::Sweep => "sweep",
        })
    }
}

/// The method for a part of a pile, and what it takes.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Region, Selection};
/// use cannonpile::{Method, Pile};
///
/// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
/// let plan = pile.plan(Selection::Base)?;
/// assert_eq!(plan.method, Method::Sweep);
/// assert_eq!(plan.to_string(), "sweep: 5 runs, 81 numbers of 1 x 64 bits");
///
/// // A base of 3·10³⁰ rows is streamed, row by row.
/// let high = Pile::under(Region::SITE, format!("(2,1,{})", 10_i128.pow(30)).parse()?)?;
/// assert_eq!(high.plan(Selection::Base)?.method, Method::Tree);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Plan {
    /// How forces are found.
    pub method: Method,
    /// The runs of steps above the lowest layer asked for.
    pub runs: usize,
    /// How many numbers a sweep keeps; 0 for the other methods.
    pub numbers: BigUint,
    /// The bits that exact numerators may need, by the proved bound; 0 where numbers grow as they must.
    pub bits: u64,
    /// The bits that a sweep reserves for them.
    pub reserved: u64,
    /// The `i64` limbs of each of them.
    pub planes: usize,
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.method)?;
        match self.method {
            Method::Closed => Ok(()),
            Method::Tree => write!(f, ": {} runs", self.runs),
            Method::Sweep => write!(
                f,
                ": {} runs, {} numbers of {} x 64 bits",
                self.runs, self.numbers, self.planes
            ),
        }
    }
}

impl Pile {
    /// How the forces of a part of the pile are found exactly.
    ///
    /// One sphere by the lines above it; a layer or more by a sweep, or row by row where that would not fit in
    /// memory. Of a straight stacking everything is closed.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] or [`Error::LayerOutside`]; [`Error::TooLarge`] if a layer neither fits in memory nor has few
    /// enough spheres at the changes of sign above it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Region, Selection};
    /// use cannonpile::{Method, Pile};
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let plan = pile.plan(Selection::Base)?;
    /// assert_eq!((plan.method, plan.planes), (Method::Sweep, 1));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn plan(&self, selection: Selection) -> Result<Plan, Error> {
        let rows = self.rows(selection)?;
        let last = rows.one().map_or(rows.layers().end - 1, |site| site.k);
        let runs = self.shape().stretch_to(last).map_or(0, |run| run.index + 1);
        let by_lines = |method| Plan {
            method,
            runs,
            numbers: BigUint::zero(),
            bits: 0,
            reserved: 0,
            planes: 0,
        };
        if self.shape().stacking().is_straight() {
            return Ok(by_lines(Method::Closed));
        }
        if rows.one().is_some() {
            return Ok(by_lines(Method::Tree));
        }
        let size = self.size_of_sweep(last);
        if Grid::new(self.shape(), last, size.planes).is_err() {
            // The lines of the middle lead highest: if its tree is not too large, no piece of a row has one that is.
            let region = self.shape().layer(last)?;
            let j = region.y().start().midpoint(*region.y().end());
            let row = region.row(j);
            let middle = row.start.midpoint(row.end - 1);
            let piece = middle - CHUNK / 2..middle + CHUNK / 2;
            let sites: Vec<_> = piece.filter(|i| row.contains(i)).map(|i| [i, j]).collect();
            Lines::<BigRational>::new(self).check_tree(last, &sites)?;
            return Ok(by_lines(Method::Tree));
        }
        Ok(Plan {
            method: Method::Sweep,
            runs,
            numbers: self.shape().layer(last)?.sites() * 3_u32,
            bits: size.bits,
            reserved: size.reserved(),
            planes: size.planes,
        })
    }

    /// How many spheres at changes of sign the force of a contact depends on: the nodes that its tree visits.
    ///
    /// At most (3^d − 1)/2 for d changes of sign above the contact, and at most the spheres above it at those changes.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::OnFloor`]; [`Error::TooLarge`] beyond 4 million.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Direction, Region, Site};
    ///
    /// let layers = 10_i128.pow(30);
    /// let pile = Pile::under(Region::SITE, format!("(2,1,{layers})").parse()?)?;
    /// // A line that begins at the surface of the last run, far below the changes of sign.
    /// let low = Site { i: 5, j: 7, k: pile.layers() - 2 };
    /// assert_eq!(pile.nodes(low, Direction::Alpha)?, 0);
    /// // And one that passes through both changes.
    /// assert_eq!(pile.nodes(Site { i: 1, j: 0, ..low }, Direction::Alpha)?, 4);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn nodes(&self, site: Site, direction: Direction) -> Result<usize, Error> {
        let site = self.shape().check(site)?;
        if site.k == self.layers() - 1 {
            return Err(Error::OnFloor { site });
        }
        Lines::<BigRational>::new(self).nodes(site, direction)
    }

    /// How wide the exact numerators of a sweep down to layer `last` are.
    pub(crate) fn size_of_sweep(&self, last: i128) -> Size {
        let lines = Lines::<BigRational>::new(self);
        let changes = self
            .shape()
            .stretch_to(last + 1)
            .or(self.shape().stretch_to(last));
        let changes = changes.map_or(0, |run| run.index);
        let scale = BigRational::from_integer(lines.scale(0));
        let extras = self.loading().extras().map(|(_, extra)| extra.abs());
        let extras = extras.fold(BigRational::zero(), |sum, extra| sum + extra) * scale;
        // An integer: the scale is a multiple of all denominators.
        let extras: BigInt = extras.to_integer();
        let spheres = self.shape().spheres_in(0..last + 1);
        Size::new(
            last + 1,
            &spheres,
            changes,
            &lines.increment_after(0),
            &extras,
        )
    }
}
