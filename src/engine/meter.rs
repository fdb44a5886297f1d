//! Counters of the work of queries.

use core::fmt;
use core::sync::atomic::{AtomicUsize, Ordering};

/// Counts the work of queries: spheres visited, spheres whose forces cross a sign change, passes of a sweep, rows
/// returned.
///
/// The counts are of type `usize` internally. A count stops at the maximum of this type.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Region, Site};
/// use cannonpile::shape::Selection;
/// use cannonpile::{Counters, Pile};
///
/// let counters = Counters::default();
/// let pile = Pile::under(Region::SITE, "++-+".parse()?)?;
/// let forces = pile.forces::<f64>().with_counters(&counters);
/// assert_eq!(forces.base(Selection::Base)?.count(), 18);
/// // The forces are turned on 6 and 12 spheres at the two sign changes. The 18 spheres of the base are visited.
/// assert_eq!(counters.to_string(), "18 visited, 18 turned, 3 passes, 18 rows");
///
/// // One force of a straight pile visits one sphere, whatever the height.
/// let (pile, counters) = (Pile::triangular(1_000_000)?, Counters::default());
/// let forces = pile.forces::<f64>().with_counters(&counters);
/// forces.contact(Site { i: 5, j: 7, k: 999_000 }, Direction::Alpha)?;
/// assert_eq!((counters.visited(), counters.rows()), (1, 0));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Debug, Default)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize))]
pub struct Counters {
    #[cfg_attr(feature = "serde", serde(serialize_with = "written"))]
    visited: AtomicUsize,
    #[cfg_attr(feature = "serde", serde(serialize_with = "written"))]
    turned: AtomicUsize,
    #[cfg_attr(feature = "serde", serde(serialize_with = "written"))]
    passes: AtomicUsize,
    #[cfg_attr(feature = "serde", serde(serialize_with = "written"))]
    rows: AtomicUsize,
}

/// Writes a counter as a number.
#[cfg(feature = "serde")]
fn written<S: ::serde::Serializer>(
    counter: &AtomicUsize,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    crate::data::number::serialize(&count(counter), serializer)
}

impl Counters {
    /// Returns the number of spheres whose forces were computed or looked up.
    #[must_use]
    pub fn visited(&self) -> u64 {
        count(&self.visited)
    }

    /// Returns the number of spheres whose forces were transferred across a sign change.
    #[must_use]
    pub fn turned(&self) -> u64 {
        count(&self.turned)
    }

    /// Returns the number of passes of a sweep. A pass crosses a run, or a part of one, in one step.
    #[must_use]
    pub fn passes(&self) -> u64 {
        count(&self.passes)
    }

    /// Returns the number of rows that iterators returned. A query for a single force does not count as a row.
    #[must_use]
    pub fn rows(&self) -> u64 {
        count(&self.rows)
    }
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

/// The counters to which an engine reports, if any.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meter<'c>(Option<&'c Counters>);

impl<'c> Meter<'c> {
    /// The meter without counters.
    pub(crate) const NONE: Self = Self(None);

    pub(crate) const fn of(counters: &'c Counters) -> Self {
        Self(Some(counters))
    }

    /// Returns whether counters are present. Engines compute expensive counts only if so.
    pub(crate) const fn counts(self) -> bool {
        self.0.is_some()
    }

    /// Counts spheres whose forces were computed or looked up.
    pub(crate) fn visit(self, spheres: usize) {
        self.add(|counters| &counters.visited, spheres);
    }

    /// Counts spheres whose forces were transferred across a sign change.
    pub(crate) fn turn(self, spheres: usize) {
        self.add(|counters| &counters.turned, spheres);
    }

    /// Counts a pass of a sweep.
    pub(crate) fn pass(self) {
        self.add(|counters| &counters.passes, 1);
    }

    /// Counts rows that iterators returned.
    pub(crate) fn answer(self, rows: usize) {
        self.add(|counters| &counters.rows, rows);
    }

    fn add(self, counter: impl FnOnce(&Counters) -> &AtomicUsize, more: usize) {
        if let Some(counters) = self.0 {
            let counter = counter(counters);
            // `fetch_add` would wrap. The closure always returns a value, so the update cannot fail.
            let _ = counter.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |count| {
                Some(count.saturating_add(more))
            });
        }
    }
}

fn count(counter: &AtomicUsize) -> u64 {
    counter.load(Ordering::Relaxed) as u64
}
