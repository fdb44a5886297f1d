//! Rows of consecutive sites in a layer.

use core::iter::FusedIterator;
use core::ops::Range;

use super::Site;
use crate::Error;

/// Consecutive sites in one row of a layer: fixed k and j, a range of i.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Row, Site};
///
/// let row = Row { k: 2, j: 1, i: 0..2 };
/// assert!(row.into_iter().eq([Site { i: 0, j: 1, k: 2 }, Site { i: 1, j: 1, k: 2 }]));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Row {
    /// The layer.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub k: i128,
    /// The row in the layer.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub j: i128,
    /// The positions in the row.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub i: Range<i128>,
}

impl Row {
    /// Returns the sites as consecutive rows of at most `sites` sites. A value below 1 counts as 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Row;
    ///
    /// let row = Row { k: 8, j: 1, i: 0..8 };
    /// let pieces: Vec<_> = row.pieces(3).map(|piece| piece.i).collect();
    /// assert_eq!(pieces, [0..3, 3..6, 6..8]);
    /// ```
    pub fn pieces(&self, sites: i128) -> impl Iterator<Item = Self> + use<> {
        let (k, j, sites) = (self.k, self.j, sites.max(1));
        let Range { start, end } = self.i;
        let starts = core::iter::successors(Some(start), move |i| i.checked_add(sites));
        let starts = starts.take_while(move |i| *i < end);
        starts.map(move |i| Self {
            k,
            j,
            i: i..end.min(i.saturating_add(sites)),
        })
    }

    /// Returns the number of sites. It is 0 if the range ends before it starts.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the number does not fit in `usize`.
    #[doc(hidden)]
    #[inline]
    pub fn length(&self) -> Result<usize, Error> {
        let Range { start, end } = self.i;
        let sites = if self.i.is_empty() {
            0
        } else {
            end.abs_diff(start)
        };
        usize::try_from(sites).map_err(|_| Error::TooLarge {
            quantity: "a row",
            needed: sites.into(),
            limit: usize::MAX as u64,
            remedy: "ask for pieces of it",
        })
    }
}

impl IntoIterator for Row {
    type Item = Site;
    type IntoIter = Sites;

    fn into_iter(self) -> Sites {
        Sites(self)
    }
}

/// The sites of a [`Row`], in order.
#[derive(Clone, Debug)]
#[must_use = "iterators are lazy and do nothing unless consumed"]
pub struct Sites(Row);

impl Sites {
    /// Returns the number of remaining sites.
    pub(crate) fn remaining(&self) -> u128 {
        let Range { start, end } = self.0.i;
        if start < end { end.abs_diff(start) } else { 0 }
    }
}

impl Iterator for Sites {
    type Item = Site;

    fn next(&mut self) -> Option<Site> {
        let Row { k, j, ref mut i } = self.0;
        i.next().map(|i| Site { i, j, k })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.0.i.size_hint()
    }
}

impl FusedIterator for Sites {}
