//! Iteration over a pile by sites.

use core::iter::FusedIterator;

use num_bigint::BigUint;

use super::Shape;
use super::rows::{Rows, exact_hint};
use crate::lattice::{self, Site};

/// A lazy iterator over the sites of a [`Selection`](super::Selection), from the top.
///
/// [`Pile::sites`](crate::Pile::sites) and [`Rows::sites`] return it. Its `size_hint` is exact if the number of sites
/// fits in `usize`.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let mut sites = pile.sites(Selection::Layer(1))?;
/// assert_eq!(sites.size_hint(), (3, Some(3)));
/// assert_eq!(sites.next(), Some(Site::new(0, 0, 1)));
/// assert!(sites.eq([Site::new(1, 0, 1), Site::new(0, 1, 1)]));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
#[must_use = "iterators are lazy and do nothing unless consumed"]
pub struct Sites<'p> {
    rows: Rows<'p>,
    /// The remaining sites of the current row.
    row: Option<lattice::Sites>,
}

impl Sites<'_> {
    /// Returns the number of remaining sites.
    pub(crate) fn remaining(&self) -> BigUint {
        let in_row = self.row.iter().map(lattice::Sites::remaining);
        in_row.fold(self.rows.site_count(), |sites, row| sites + row)
    }
}

impl Shape {
    /// Returns all sites, layer by layer from the top, row by row.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(2, Dimension::Three)?;
    /// let sites: Vec<Site> = pyramid.sites().collect();
    /// assert_eq!(sites[1..], [(0, 0), (1, 0), (0, 1)].map(|(i, j)| Site { i, j, k: 1 }));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn sites(&self) -> Sites<'_> {
        Rows::of_layers(self, 0..self.layers()).sites()
    }
}

impl<'p> Rows<'p> {
    /// Returns the sites of the remaining rows, one by one.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::shape::{Selection, Shape};
    ///
    /// let pyramid = Shape::pyramid(4, Dimension::Three)?;
    /// let sites = pyramid.rows(Selection::All)?.off_the_floor().sites();
    /// assert_eq!(sites.size_hint(), (10, Some(10)));
    /// assert_eq!(sites.last(), Some(Site::new(0, 2, 2)));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn sites(self) -> Sites<'p> {
        Sites {
            rows: self,
            row: None,
        }
    }
}

impl Iterator for Sites<'_> {
    type Item = Site;

    fn next(&mut self) -> Option<Site> {
        loop {
            if let Some(site) = self.row.as_mut().and_then(Iterator::next) {
                return Some(site);
            }
            self.row = Some(self.rows.next()?.into_iter());
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        exact_hint(&self.remaining())
    }
}

impl FusedIterator for Sites<'_> {}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use crate::lattice::{Dimension, Region};
    use crate::shape::{Selection, Shape};
    use crate::stacking::Stacking;

    fn shapes() -> Vec<Shape> {
        let on = |base: &str, stacking: &str| {
            Shape::on(base.parse().unwrap(), stacking.parse().unwrap()).unwrap()
        };
        let under = |top: &str, stacking: &str| {
            Shape::under(top.parse().unwrap(), stacking.parse().unwrap()).unwrap()
        };
        Vec::from([
            Shape::pyramid(6, Dimension::Three).unwrap(),
            Shape::pyramid(6, Dimension::Two).unwrap(),
            under("hexagon:3,2", "++-+"),
            under("2..5,1..1,3..6", "-++"),
            on("hexagon:5,4", "+-++"),
            on("triangle:9", "++++++"),
            on("triangle:9", "----"),
            on("0..9,0..7,3..12", "++++-"),
        ])
    }

    fn parts(shape: &Shape) -> impl Iterator<Item = Selection> {
        let layers = (0..shape.layers()).map(Selection::Layer);
        let site = shape.sites().last().unwrap();
        layers.chain([Selection::All, Selection::Base, Selection::One(site)])
    }

    /// Exhausts an iterator. Checks its hint before each item and after the last.
    fn check<I: Iterator + Clone>(mut items: I) {
        let mut left = items.clone().count();
        loop {
            assert_eq!(items.size_hint(), (left, Some(left)));
            if items.next().is_none() {
                break;
            }
            left -= 1;
        }
        assert!(left == 0 && items.next().is_none());
    }

    #[test]
    fn hints_of_sites_and_rows_are_exact() {
        for shape in shapes() {
            for part in parts(&shape) {
                let rows = shape.rows(part).unwrap();
                check(rows.clone());
                check(rows.clone().off_the_floor());
                check(rows.clone().sites());
                assert!(rows.clone().sites().eq(rows.flatten()));
            }
        }
    }

    #[test]
    fn more_than_a_usize_has_no_upper_bound() {
        let pyramid = Shape::pyramid(10_i128.pow(30), Dimension::Three).unwrap();
        assert_eq!(pyramid.sites().size_hint(), (usize::MAX, None));
        assert_eq!(
            pyramid.rows(Selection::All).unwrap().size_hint(),
            (usize::MAX, None)
        );
        let base = Region::triangle(10_000).unwrap();
        let shape = Shape::on(base, Stacking::fcc(10_000).unwrap()).unwrap();
        let rows = shape.rows(Selection::All).unwrap().size_hint();
        assert_eq!(rows, (50_005_000, Some(50_005_000)));
    }
}
