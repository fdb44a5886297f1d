//! The stackings of a sorted list that continue a beginning, which is a list of signs from the top.

use core::ops::Range;

use cannonpile::lattice::Sign;

use crate::Error;
use crate::error::bug;

/// For each number of faults: the number of listed stackings that continue a beginning, and the index of the first.
#[derive(Clone)]
pub(super) struct Continuations(Vec<(u64, usize)>);

impl Continuations {
    /// Returns the state without any stacking.
    pub(super) fn none(fault_numbers: usize) -> Self {
        Self(vec![(0, 0); fault_numbers])
    }

    pub(super) fn clear(&mut self) {
        self.0.fill((0, 0));
    }

    /// Adds `count` stackings from the index `first` on. Indices of further calls must be greater.
    pub(super) fn add(&mut self, faults: usize, count: u64, first: usize) -> Result<(), Error> {
        let entry = self.0.get_mut(faults);
        let entry = entry.ok_or_else(|| bug("no more faults than steps"))?;
        if entry.0 == 0 {
            entry.1 = first;
        }
        entry.0 += count;
        Ok(())
    }

    /// Adds the stackings of another state, which come later in the list.
    pub(super) fn add_all(&mut self, other: &Self) -> Result<(), Error> {
        let mut entries = other.entries();
        entries.try_for_each(|(faults, count, first)| self.add(faults, count, first))
    }

    /// Returns the entries that are not empty: the number of faults, the count, and the first index.
    pub(super) fn entries(&self) -> impl Iterator<Item = (usize, u64, usize)> + '_ {
        let entries = self.0.iter().enumerate();
        let entries = entries.map(|(faults, (count, first))| (faults, *count, *first));
        entries.filter(|(_, count, _)| *count > 0)
    }
}

/// Splits a range of the list by the sign of step k. All its stackings have the same first k signs.
pub(super) fn split(
    list: &[Vec<Sign>],
    range: Range<usize>,
    k: usize,
) -> Result<[(Sign, Range<usize>); 2], Error> {
    let listed = list.get(range.clone());
    let listed = listed.ok_or_else(|| bug("indices of a list are in it"))?;
    let middle = range.start + listed.partition_point(|signs| signs.get(k) == Some(&Sign::Plus));
    Ok([
        (Sign::Plus, range.start..middle),
        (Sign::Minus, middle..range.end),
    ])
}
