//! What an answer really took, counted by the engines while they work.

use core::cell::Cell;
use core::fmt;

/// Is told by the engines what they do; `()` ignores all of it, and costs nothing.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::{Counters, Pile};
///
/// let counters = Counters::default();
/// let pile = Pile::triangular(1_000_000)?;
/// let forces = pile.forces::<f64>().metered(&counters);
/// forces.contact(Site { i: 5, j: 7, k: 999_000 }, Direction::Alpha)?;
/// // No other sphere was looked at.
/// assert_eq!(counters.visited(), 1);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub trait Meter: Copy {
    /// Whether it counts at all: what it is told may take a while to find out.
    const COUNTS: bool = true;

    /// The forces at so many spheres were worked out or looked up.
    fn visit(self, _spheres: usize) {}

    /// The forces on so many spheres were turned, across a change of sign.
    fn turn(self, _spheres: usize) {}

    /// A layer was led through a run, or a part of one, at once.
    fn pass(self) {}

    /// So many answers were given.
    fn answer(self, _rows: usize) {}
}

impl Meter for () {
    const COUNTS: bool = false;
}

/// Counts what a [`Meter`] is told.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Region;
/// use cannonpile::shape::Selection;
/// use cannonpile::{Counters, Pile};
///
/// let counters = Counters::default();
/// let pile = Pile::under(Region::SITE, "++-+".parse()?)?;
/// let forces = pile.forces::<f64>().metered(&counters);
/// assert_eq!(forces.base(Selection::Base)?.count(), 18);
/// // Two changes of sign, in layers of 6 and 12 spheres, and then the 18 of the base.
/// assert_eq!((counters.turned(), counters.visited(), counters.passes()), (18, 18, 3));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    visited: Cell<u64>,
    turned: Cell<u64>,
    passes: Cell<u64>,
    rows: Cell<u64>,
}

impl Counters {
    /// Visited, turned, passes and rows.
    #[cfg(feature = "serde")]
    pub(crate) fn of([visited, turned, passes, rows]: [u64; 4]) -> Self {
        Self {
            visited: Cell::new(visited),
            turned: Cell::new(turned),
            passes: Cell::new(passes),
            rows: Cell::new(rows),
        }
    }

    /// Spheres whose forces were worked out or looked up.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Counters, Pile};
    ///
    /// let (pile, counters) = (Pile::triangular(10)?, Counters::default());
    /// let forces = pile.forces::<f64>().metered(&counters);
    /// assert_eq!(forces.contacts(Selection::All)?.count(), 495);
    /// // Each sphere once for its three contacts, and none of the 55 on the floor.
    /// assert_eq!(counters.visited(), 220 - 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn visited(&self) -> u64 {
        self.visited.get()
    }

    /// Spheres whose forces were turned, across a change of sign: the transfer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Region, Site};
    /// use cannonpile::{Counters, Pile};
    ///
    /// let counters = Counters::default();
    /// let pile = Pile::under(Region::SITE, format!("(2,1,{})", 10_i128.pow(30)).parse()?)?;
    /// let site = Site { i: 1, j: 0, k: pile.layers() - 2 };
    /// pile.forces::<f64>().metered(&counters).contact(site, Direction::Alpha)?;
    /// // One sphere at the lower change of sign, and the three above it at the upper.
    /// assert_eq!(counters.turned(), 1 + 3);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn turned(&self) -> u64 {
        self.turned.get()
    }

    /// Runs, or parts of one, that a sweep went through at once.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Counters, Method, Pile};
    ///
    /// let (pile, counters) = (Pile::triangular(10)?, Counters::default());
    /// let forces = pile.forces::<f64>().by(Method::Sweep)?.metered(&counters);
    /// assert_eq!(forces.base(Selection::Base)?.count(), 55);
    /// // Nine steps, and no sign changes.
    /// assert_eq!(counters.passes(), 1);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn passes(&self) -> u64 {
        self.passes.get()
    }

    /// Answers given in rows: those of iterators, not of single questions.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Site;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Counters, Pile};
    ///
    /// let (pile, counters) = (Pile::triangular(10)?, Counters::default());
    /// let forces = pile.forces::<f64>().metered(&counters);
    /// forces.on_floor(Site { i: 5, j: 2, k: 9 })?;
    /// assert_eq!(counters.rows(), 0);
    /// assert_eq!(forces.base(Selection::Base)?.count(), 55);
    /// assert_eq!(counters.rows(), 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows.get()
    }
}

impl Meter for &Counters {
    fn visit(self, spheres: usize) {
        add(&self.visited, spheres);
    }

    fn turn(self, spheres: usize) {
        add(&self.turned, spheres);
    }

    fn pass(self) {
        add(&self.passes, 1);
    }

    fn answer(self, rows: usize) {
        add(&self.rows, rows);
    }
}

fn add(counter: &Cell<u64>, more: usize) {
    counter.set(counter.get().saturating_add(more as u64));
}

impl fmt::Display for Counters {
    /// `18 visited, 18 turned, 3 passes, 18 rows`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} visited, {} turned, {} passes, {} rows",
            self.visited(),
            self.turned(),
            self.passes(),
            self.rows()
        )
    }
}
