//! The spheres of a pile by number.

use alloc::vec::Vec;

use num_bigint::BigUint;

use super::{Shape, Site};
use crate::Error;

/// The most spheres that are numbered: each has one number in a `u64`, and each layer one offset in memory.
const MOST: u64 = 100_000_000_000;

/// The numbers of the spheres of a pile: 1, 2, 3, … in row order from the top, as in the table of spheres and in every
/// file made of a pile.
///
/// It keeps one offset a layer, so that a sphere is numbered in the time that its layer takes to find, and found again
/// by two bisections. The spheres of the bottom layer have the last numbers.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
///
/// let pile = Pile::triangular(10)?;
/// let numbering = pile.numbering()?;
/// assert_eq!(numbering.id(Site::APEX)?, 1);
/// assert_eq!(numbering.site(220), Some(Site { i: 0, j: 9, k: 9 }));
/// assert_eq!(numbering.site(221), None);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbering<'p> {
    shape: &'p Shape,
    /// The spheres before each layer, and all of them.
    before: Vec<u64>,
}

impl<'p> Numbering<'p> {
    pub(super) fn new(shape: &'p Shape) -> Result<Self, Error> {
        let spheres = shape.spheres();
        if spheres > BigUint::from(MOST) {
            return Err(Error::TooLarge {
                quantity: "the numbers of all spheres",
                needed: spheres,
                limit: MOST,
                remedy: "use fewer layers, or a smaller top or base",
            });
        }
        let mut before = alloc::vec![0];
        let mut sum = 0;
        for k in 0..shape.layers() {
            // A part of the sum that fits.
            sum += u64::try_from(shape.layer(k)?.sites()).unwrap_or_default();
            before.push(sum);
        }
        Ok(Self { shape, before })
    }

    /// Returns the shape whose spheres these are.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.numbering()?.shape(), pile.shape());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn shape(&self) -> &'p Shape {
        self.shape
    }

    /// Returns the number of spheres, which is the greatest number of a sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.numbering()?.spheres(), 220);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn spheres(&self) -> u64 {
        self.before.last().copied().unwrap_or_default()
    }

    /// Returns the number of the first sphere of the bottom layer. All spheres from it on are on the floor.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.numbering()?.first_on_floor(), 220 - 55 + 1);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn first_on_floor(&self) -> u64 {
        let layer = self.before.len().checked_sub(2);
        let before = layer.and_then(|layer| self.before.get(layer));
        before.copied().unwrap_or_default() + 1
    }

    /// Returns the number of a sphere.
    ///
    /// # Errors
    /// As for [`Shape::check`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Region, Site};
    ///
    /// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
    /// let numbering = pile.numbering()?;
    /// // One sphere, three, and the first row of the hexagon, which begins at i = 0.
    /// assert_eq!(numbering.id(Site { i: 0, j: -1, k: 2 })?, 5);
    /// assert!(numbering.id(Site { i: -1, j: -1, k: 2 }).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn id(&self, site: Site) -> Result<u64, Error> {
        let Site { i, j, k } = self.shape.check(site)?;
        let layer = usize::try_from(k).ok();
        let before = layer.and_then(|layer| self.before.get(layer)).copied();
        let in_layer = self.shape.layer(k)?.sites_before(i, j);
        // Not more than all spheres, which fit.
        let in_layer = u64::try_from(in_layer).unwrap_or_default();
        Ok(before.unwrap_or_default() + in_layer + 1)
    }

    /// Returns the sphere of a number, or `None` for 0 and for numbers past the last.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::discs(4)?;
    /// let numbering = pile.numbering()?;
    /// for id in 1..=10 {
    ///     assert_eq!(numbering.id(numbering.site(id).unwrap())?, id);
    /// }
    /// assert_eq!(numbering.site(0), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn site(&self, id: u64) -> Option<Site> {
        let place = id.checked_sub(1)?;
        // The first layer that ends past it.
        let ends = self.before.get(1..)?;
        let layer = ends.partition_point(|end| *end <= place);
        let in_layer = BigUint::from(place - self.before.get(layer)?);
        let k = i128::try_from(layer).ok()?;
        let region = self.shape.layer(k).ok()?;
        let first_of = |j| region.sites_before(region.row(j).start, j);
        // The last row that begins at or before it.
        let (mut row, mut past) = (*region.y().start(), *region.y().end() + 1);
        while past - row > 1 {
            let middle = row + (past - row) / 2;
            if first_of(middle) <= in_layer {
                row = middle;
            } else {
                past = middle;
            }
        }
        let along = i128::try_from(in_layer - first_of(row)).ok()?;
        let i = region.row(row).start + along;
        Some(Site { i, j: row, k })
    }
}
