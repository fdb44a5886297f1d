//! How a question is answered, and how much it takes: decided before anything is computed.

mod question;
mod route;

pub use question::{Quantity, Question};
pub(crate) use route::{CHUNK, Route, trees_are_cheaper};

use core::fmt;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::Zero;

use crate::lattice::{Direction, Site};
use crate::lines::{Lines, MAX_NODES};
use crate::shape::Rows;
use crate::sweep::{Grid, Size};
use crate::{Error, Pile};

/// How forces are found.
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
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
/// use cannonpile::lattice::Region;
/// use cannonpile::shape::Selection;
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
    /// The runs of steps above the lowest layer asked for: a sweep jumps each of them, a tree has a level for each.
    pub runs: usize,
    /// The spheres whose forces are worked out or looked up, at most.
    pub visited: BigUint,
    /// Those of them that forces are turned on, across a change of sign, at most.
    pub turned: BigUint,
    /// The runs, or parts of one, that a sweep goes through at once, at most; 0 for the other methods.
    pub passes: BigUint,
    /// How many numbers a sweep keeps; 0 for the other methods.
    pub numbers: BigUint,
    /// The bits that exact numerators may need, by the proved bound; 0 where numbers grow as they must.
    pub bits: u64,
    /// The bits that a sweep reserves for them.
    pub reserved: u64,
    /// The `i64` limbs of each of them.
    pub planes: usize,
    /// The square roots that are taken, at most.
    pub roots: u64,
    /// How many answers there are.
    pub rows: BigUint,
    /// The memory that a sweep keeps its numbers in.
    pub bytes: BigUint,
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
    /// How a question is answered exactly, and how much it takes at most.
    ///
    /// One sphere by the lines above it; a layer or more by a sweep, or row by row where that would not fit in
    /// memory. Of a straight stacking everything is closed. A [`Counters`](crate::Counters) tells what it took.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] or [`Error::LayerOutside`]; [`Error::NotOnFloor`] if forces on the floor are asked of a
    /// sphere that is not there; [`Error::TooLarge`] if a layer neither fits in memory nor has few enough spheres at the
    /// changes of sign above it; [`Error::NoSuchMethod`] if one is asked for that does not apply.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Method, Pile, Question};
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let plan = pile.plan(Selection::Base)?;
    /// assert_eq!((plan.method, plan.planes), (Method::Sweep, 1));
    ///
    /// let by_trees = Question { method: Some(Method::Tree), ..Selection::Base.into() };
    /// assert_eq!(pile.plan(by_trees)?.method, Method::Tree);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn plan(&self, question: impl Into<Question>) -> Result<Plan, Error> {
        let Question {
            part,
            quantity,
            method,
        } = question.into();
        if let Some(method) = method {
            self.check_method(method)?;
        }
        let mut rows = self.rows(part)?;
        let mut answers = rows.sites();
        if quantity.is_of_contacts() {
            rows = rows.off_the_floor();
            answers = rows.sites() * self.dimension().directions().len();
        } else if quantity != Quantity::Positions {
            self.check_on_floor(&rows)?;
        }
        let last = last_of(&rows);
        let mut plan = Plan {
            method: Method::Closed,
            runs: self.shape().stretch_to(last).map_or(0, |run| run.index + 1),
            visited: rows.sites(),
            turned: BigUint::zero(),
            passes: BigUint::zero(),
            numbers: BigUint::zero(),
            bits: 0,
            reserved: 0,
            planes: 0,
            roots: quantity.roots(),
            rows: answers,
            bytes: BigUint::zero(),
        };
        if quantity == Quantity::Positions {
            plan.visited = BigUint::zero();
            return Ok(plan);
        }
        match self.route::<BigRational>(&rows, method)? {
            Route::Closed => {}
            Route::Tree => match self.by_trees(plan.clone(), &rows) {
                // The one sphere is left to a sweep where its tree is too large.
                Err(too_large) if rows.one().is_some() && method.is_none() => {
                    // In integers that grow, each with its digits elsewhere.
                    let size = self.size_of_sweep(last);
                    let words = size.planes + size_of::<BigInt>().div_ceil(size_of::<i64>());
                    if Grid::numbers(self.shape(), last, words).is_err() {
                        return Err(too_large);
                    }
                    self.by_sweep(&mut plan, &rows, size)?;
                    plan.bytes = &plan.numbers * words * size_of::<i64>();
                }
                by_trees => plan = by_trees?,
            },
            Route::Sweep(size) => self.by_sweep(&mut plan, &rows, size)?,
        }
        Ok(plan)
    }

    fn check_on_floor(&self, rows: &Rows<'_>) -> Result<(), Error> {
        let floor = self.layers() - 1;
        match rows.clone().flatten().next() {
            Some(site) if site.k != floor => Err(Error::NotOnFloor { site, floor }),
            _ => Ok(()),
        }
    }

    /// Trees, each of a piece of a row.
    fn by_trees(&self, mut plan: Plan, rows: &Rows<'_>) -> Result<Plan, Error> {
        plan.method = Method::Tree;
        let last = last_of(rows);
        let sites = rows.sites();
        let mut pieces = BigUint::from(1_u32);
        if rows.one().is_none() {
            let (layers, height) = (rows.layers(), self.shape().layer(last)?.widths()[1]);
            let layers = (layers.end - layers.start).max(0).unsigned_abs();
            // Each row may end with a shorter piece.
            pieces = BigUint::from(layers) * (height.unsigned_abs() + 1);
            pieces += &sites / CHUNK.unsigned_abs();
        }
        // At a change of sign, three for each below, and no more than there are.
        let most = BigUint::from(MAX_NODES);
        let mut level = BigUint::from(CHUNK.unsigned_abs()).min(sites.clone());
        let mut above = BigUint::zero();
        let mut run = self.shape().stretch_to(last).filter(|run| run.index > 0);
        while let (Some(stretch), true) = (run, above <= most) {
            level = (level * 3_u32).min(self.shape().layer(stretch.from)?.sites());
            above += &level;
            run = self.shape().stretch(stretch.index - 1);
            run = run.filter(|run| run.index > 0);
        }
        if above > most {
            // It may be less, and is more for none.
            match rows.one() {
                Some(Site { i, j, k }) => {
                    Lines::<BigRational>::new(self).check_tree(k, &[[i, j]])?;
                }
                None => self.check_trees(last)?,
            }
            above = most;
        }
        above *= pieces;
        plan.turned = &above + &sites;
        plan.visited = above + sites;
        Ok(plan)
    }

    /// One sweep, down to the last layer.
    fn by_sweep(&self, plan: &mut Plan, rows: &Rows<'_>, size: Size) -> Result<(), Error> {
        let (last, shape) = (last_of(rows), self.shape());
        plan.method = Method::Sweep;
        plan.numbers = shape.layer(last)?.sites() * 3_u32;
        plan.bytes = &plan.numbers * size.planes * size_of::<i64>();
        (plan.bits, plan.reserved, plan.planes) = (size.bits, size.reserved(), size.planes);
        let changes = (1..).map_while(|run| shape.stretch(run));
        for change in changes.take_while(|run| run.from <= last) {
            plan.turned += shape.layer(change.from)?.sites();
        }
        let layers = rows.layers();
        let stops = (layers.end - layers.start).max(1).unsigned_abs();
        plan.passes = BigUint::from(stops) + plan.runs;
        Ok(())
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
}

/// The lowest layer that rows are of.
pub(crate) fn last_of(rows: &Rows<'_>) -> i128 {
    let last = rows.one().map_or(rows.layers().end - 1, |site| site.k);
    last.max(0)
}
