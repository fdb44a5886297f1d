//! Iteration over a pile by rows.

use alloc::vec::Vec;
use core::fmt;
use core::iter::FusedIterator;
use core::ops::Range;

use exact_surd::layout::padded;

use super::Shape;
use crate::Error;
use crate::lattice::{Row, Site};
use num_bigint::BigUint;
use num_traits::ToPrimitive;

/// A part of a pile: the argument of most queries.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// assert_eq!(pile.rows(Selection::Base)?.site_count(), 55_u32.into());
/// assert_eq!(pile.rows(Selection::All)?.site_count(), 220_u32.into());
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(rename_all = "lowercase")
)]
pub enum Selection {
    /// One sphere.
    One(Site),
    /// The layer k, counted from the top.
    Layer(#[cfg_attr(feature = "serde", serde(with = "crate::data::number"))] i128),
    /// The bottom layer.
    Base,
    /// Every sphere.
    All,
}

impl fmt::Display for Selection {
    /// Prints `all`, `base`, `layer 3` or the site, `(0,1,2)`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    ///
    /// assert_eq!(Selection::Base.to_string(), "base");
    /// assert_eq!(format!("{:>9}", Selection::Layer(3)), "  layer 3");
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::One(site) => site.fmt(f),
            Self::Layer(k) => padded(f, format_args!("layer {k}")),
            Self::Base => padded(f, format_args!("base")),
            Self::All => padded(f, format_args!("all")),
        }
    }
}

/// A lazy iterator over the rows of a [`Selection`], from the top.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Dimension, Row};
/// use cannonpile::shape::{Selection, Shape};
///
/// let pyramid = Shape::pyramid(3, Dimension::Three)?;
/// let mut base = pyramid.rows(Selection::Base)?;
/// assert_eq!(base.site_count(), 6_u32.into());
/// assert_eq!(base.next(), Some(Row { k: 2, j: 0, i: 0..3 }));
/// assert_eq!(base.next(), Some(Row { k: 2, j: 1, i: 0..2 }));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
#[must_use = "iterators are lazy and do nothing unless consumed"]
pub struct Rows<'p> {
    shape: &'p Shape,
    /// The layer of the next row. The iterator ends at layer `end`.
    k: i128,
    /// The next row of that layer, or `None` before its first row.
    j: Option<i128>,
    /// The end of the layers, exclusive.
    end: i128,
    /// The sphere, if the selection is a single one. The range of layers is then empty.
    one: Option<Site>,
}

impl Shape {
    /// Returns the rows of a part of the pile, from the top.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] or [`Error::LayerOutside`] if the pile does not contain the selection.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Dimension;
    /// use cannonpile::shape::{Selection, Shape};
    ///
    /// let pyramid = Shape::pyramid(10, Dimension::Three)?;
    /// assert_eq!(pyramid.rows(Selection::Layer(3))?.count(), 4);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn rows(&self, selection: Selection) -> Result<Rows<'_>, Error> {
        Rows::new(self, selection)
    }
}

impl<'p> Rows<'p> {
    pub(super) fn new(shape: &'p Shape, selection: Selection) -> Result<Self, Error> {
        let layers = shape.layers();
        Ok(match selection {
            Selection::One(site) => Self {
                one: Some(shape.check(site)?),
                ..Self::of_layers(shape, 0..0)
            },
            Selection::Layer(k) => {
                shape.layer(k)?;
                Self::of_layers(shape, k..k + 1)
            }
            Selection::Base => Self::of_layers(shape, layers - 1..layers),
            Selection::All => Self::of_layers(shape, 0..layers),
        })
    }

    pub(super) fn of_layers(shape: &'p Shape, layers: Range<i128>) -> Self {
        Self {
            shape,
            k: layers.start,
            j: None,
            end: layers.end,
            one: None,
        }
    }

    /// Removes the bottom layer. Every remaining sphere has supports.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Dimension;
    /// use cannonpile::shape::{Selection, Shape};
    ///
    /// let pyramid = Shape::pyramid(4, Dimension::Three)?;
    /// let rows = pyramid.rows(Selection::All)?.off_the_floor();
    /// assert_eq!(rows.site_count(), 10_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn off_the_floor(mut self) -> Self {
        let floor = self.shape.layers() - 1;
        self.one = self.one.filter(|site| site.k < floor);
        self.end = self.end.min(floor);
        self
    }

    /// Returns the shape that the rows belong to.
    #[must_use]
    pub fn shape(&self) -> &'p Shape {
        self.shape
    }

    /// Returns the range of the remaining layers. It is empty for a single sphere.
    #[doc(hidden)]
    #[must_use]
    pub fn layers(&self) -> Range<i128> {
        self.k..self.end
    }

    /// Returns the single sphere, if the selection was one.
    #[doc(hidden)]
    #[must_use]
    pub fn one(&self) -> Option<Site> {
        self.one
    }

    /// Returns the number of remaining sites, which may exceed any machine integer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Dimension;
    /// use cannonpile::shape::{Selection, Shape};
    ///
    /// let pyramid = Shape::pyramid(4, Dimension::Three)?;
    /// let mut rows = pyramid.rows(Selection::All)?;
    /// assert_eq!(rows.site_count(), 20_u32.into());
    /// rows.next();
    /// assert_eq!(rows.site_count(), 19_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn site_count(&self) -> BigUint {
        if self.one.is_some() {
            return 1_u32.into();
        }
        if self.k >= self.end {
            return 0_u32.into();
        }
        let all = self.shape.spheres_in(self.k..self.end);
        match (self.j, self.shape.layer(self.k)) {
            // The iterator has already returned some rows of this layer.
            (Some(j), Ok(region)) => all - region.sites_before(region.row(j).start, j),
            _ => all,
        }
    }

    /// Returns the number of remaining rows.
    fn remaining(&self) -> BigUint {
        if self.one.is_some() {
            return 1_u32.into();
        }
        let all = self.shape.rows_in(self.k..self.end);
        match (self.j, self.shape.layer(self.k)) {
            // The iterator has already returned some rows of this layer.
            (Some(j), Ok(region)) => all - j.abs_diff(*region.y().start()),
            _ => all,
        }
    }

    /// Returns the corner sites of the first and the last layer. On a straight pile, a linear function of (i, j, k)
    /// attains its extremes at these sites. The norm of a vector of such functions attains its maximum there. Rows of
    /// the current layer that were already returned are included.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::shape::{Selection, Shape};
    ///
    /// let pyramid = Shape::pyramid(4, Dimension::Three)?;
    /// let corners: Vec<Site> = pyramid.rows(Selection::All)?.corners().collect();
    /// assert_eq!(corners[0], Site::APEX);
    /// assert_eq!(corners[1..], [(0, 0), (3, 0), (0, 3)].map(|(i, j)| Site { i, j, k: 3 }));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn corners(&self) -> impl Iterator<Item = Site> + use<'p> {
        let (shape, one) = (self.shape, self.one);
        let layers = (self.k < self.end).then_some([self.k, self.end - 1]);
        let ends = layers.into_iter().flatten();
        let corners = ends.flat_map(move |k| {
            let mut corners = shape
                .layer(k)
                .map_or_else(|_| Vec::new(), |r| r.corners().into());
            corners.dedup();
            if corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
            corners.into_iter().map(move |[i, j]| Site { i, j, k })
        });
        one.into_iter().chain(corners)
    }
}

impl Iterator for Rows<'_> {
    type Item = Row;

    fn next(&mut self) -> Option<Row> {
        if let Some(Site { i, j, k }) = self.one.take() {
            return Some(Row { k, j, i: i..i + 1 });
        }
        if self.k >= self.end {
            return None;
        }
        let region = self.shape.layer(self.k).ok()?;
        let (k, j) = (self.k, self.j.unwrap_or(*region.y().start()));
        if j < *region.y().end() {
            self.j = Some(j + 1);
        } else {
            (self.k, self.j) = (k + 1, None);
        }
        let i = region.row(j);
        Some(Row { k, j, i })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        exact_hint(&self.remaining())
    }
}

impl FusedIterator for Rows<'_> {}

/// Returns the `size_hint` of an iterator with `items` items. It is exact if the number fits in `usize`.
pub(crate) fn exact_hint(items: &BigUint) -> (usize, Option<usize>) {
    match items.to_usize() {
        Some(items) => (items, Some(items)),
        None => (usize::MAX, None),
    }
}
