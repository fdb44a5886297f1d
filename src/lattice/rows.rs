//! Walking a pile row by row.

use core::ops::Range;

use num_bigint::BigUint;
use num_rational::BigRational;

use super::{Dimension, Direction, Pyramid, Site, count};
use crate::Error;
use crate::scalar::Ring;

/// A part of a pile.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Selection;
///
/// let pile = Pile::triangular(10)?;
/// assert_eq!(pile.rows(Selection::Base)?.sites(), 55_u32.into());
/// assert_eq!(pile.rows(Selection::All)?.sites(), 220_u32.into());
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Selection {
    /// One sphere.
    One(Site),
    /// The layer k, counted from the top.
    Layer(i128),
    /// The bottom layer.
    Base,
    /// Every sphere.
    All,
}

/// Consecutive sites of one row: fixed k and j, a range of i.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Row, Site};
///
/// let row = Row { k: 2, j: 1, i: 0..2 };
/// assert!(row.into_iter().eq([Site { i: 0, j: 1, k: 2 }, Site { i: 1, j: 1, k: 2 }]));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Row {
    /// The layer.
    pub k: i128,
    /// The row within the layer.
    pub j: i128,
    /// The places within the row.
    pub i: Range<i128>,
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
pub struct Sites(Row);

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

/// The rows of a [`Selection`], from the top, made as they are asked for.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Dimension, Pyramid, Row, Selection};
///
/// let pyramid = Pyramid::new(3, Dimension::Three)?;
/// let mut base = pyramid.rows(Selection::Base)?;
/// assert_eq!(base.sites(), 6_u32.into());
/// assert_eq!(base.next(), Some(Row { k: 2, j: 0, i: 0..3 }));
/// assert_eq!(base.next(), Some(Row { k: 2, j: 1, i: 0..2 }));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Rows {
    dimension: Dimension,
    /// The next row to give, unless `one` is set.
    k: i128,
    j: i128,
    /// The layer to stop before.
    end: i128,
    /// A single sphere instead of layers.
    one: Option<Site>,
}

impl Rows {
    pub(super) fn new(pyramid: &Pyramid, selection: Selection) -> Result<Self, Error> {
        let (dimension, layers) = (pyramid.dimension(), pyramid.layers());
        Ok(match selection {
            Selection::One(site) => Self {
                one: Some(pyramid.check(site)?),
                ..Self::of_layers(dimension, 0..0)
            },
            Selection::Layer(k) if !(0..layers).contains(&k) => {
                return Err(Error::LayerOutside { layer: k, layers });
            }
            Selection::Layer(k) => Self::of_layers(dimension, k..k + 1),
            Selection::Base => Self::of_layers(dimension, layers - 1..layers),
            Selection::All => Self::of_layers(dimension, 0..layers),
        })
    }

    pub(super) fn of_layers(dimension: Dimension, layers: Range<i128>) -> Self {
        Self {
            dimension,
            k: layers.start,
            j: 0,
            end: layers.end,
            one: None,
        }
    }

    /// Leaves out the bottom layer of `pyramid`: the spheres left all have spheres below them.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Pyramid, Selection};
    ///
    /// let pyramid = Pyramid::new(4, Dimension::Three)?;
    /// let rows = pyramid.rows(Selection::All)?.off_the_floor(&pyramid);
    /// assert_eq!(rows.sites(), 10_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn off_the_floor(mut self, pyramid: &Pyramid) -> Self {
        let floor = pyramid.layers() - 1;
        self.one = self.one.filter(|site| site.k < floor);
        self.end = self.end.min(floor);
        self
    }

    /// How many sites are still to come, of any size.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Pyramid, Selection};
    ///
    /// let pyramid = Pyramid::new(4, Dimension::Three)?;
    /// let mut rows = pyramid.rows(Selection::All)?;
    /// assert_eq!(rows.sites(), 20_u32.into());
    /// rows.next();
    /// assert_eq!(rows.sites(), 19_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn sites(&self) -> BigUint {
        if self.one.is_some() {
            return 1_u32.into();
        }
        if self.k >= self.end {
            return 0_u32.into();
        }
        let d = self.dimension.number();
        let [i, j, k, end] = [0, self.j, self.k, self.end].map(BigRational::from_i128);
        let count = count::spheres(&end, d) - count::before(&i, &j, &k, d);
        count.to_integer().into_parts().1
    }

    /// The sites at which a quantity that is linear in i, j and k, or the norm of such quantities, takes its
    /// extremes: the corners of the first and the last layer, whole layers even where some rows of the first
    /// have been given already.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Pyramid, Selection, Site};
    ///
    /// let pyramid = Pyramid::new(4, Dimension::Three)?;
    /// let corners: Vec<Site> = pyramid.rows(Selection::All)?.corners().collect();
    /// // The apex is each corner of its layer.
    /// assert_eq!(corners[..3], [Site::APEX; 3]);
    /// assert_eq!(corners[3..], [(0, 0), (3, 0), (0, 3)].map(|(i, j)| Site { i, j, k: 3 }));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn corners(&self) -> impl Iterator<Item = Site> + use<> {
        let layers = (self.k < self.end).then_some([self.k, self.end - 1]);
        let directions = self.dimension.directions();
        let corners = layers.into_iter().flatten().flat_map(move |k| {
            directions.iter().map(move |direction| match direction {
                Direction::Alpha => Site { i: 0, j: 0, k },
                Direction::Beta => Site { i: k, j: 0, k },
                Direction::Gamma => Site { i: 0, j: k, k },
            })
        });
        self.one.into_iter().chain(corners)
    }
}

impl Iterator for Rows {
    type Item = Row;

    fn next(&mut self) -> Option<Row> {
        if let Some(Site { i, j, k }) = self.one.take() {
            return Some(Row { k, j, i: i..i + 1 });
        }
        if self.k >= self.end {
            return None;
        }
        let row = Row {
            k: self.k,
            j: self.j,
            i: 0..self.k - self.j + 1,
        };
        if self.dimension == Dimension::Three && self.j < self.k {
            self.j += 1;
        } else {
            self.j = 0;
            self.k += 1;
        }
        Some(row)
    }
}
