//! The spheres of a pile by number.

use alloc::vec::Vec;

use num_bigint::BigUint;

use super::{Shape, Site};
use crate::Error;
use crate::error::{bug, refuse_beyond};

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
    /// The spheres before each layer.
    before: Vec<u64>,
    /// Those before the bottom layer.
    above_floor: u64,
    spheres: u64,
}

impl<'p> Numbering<'p> {
    pub(super) fn new(shape: &'p Shape) -> Result<Self, Error> {
        let spheres = shape.sphere_count();
        refuse_beyond(
            "the numbers of all spheres",
            spheres,
            MOST,
            "use fewer layers, or a smaller top or base",
        )?;
        let (mut before, mut above_floor, mut sum) = (Vec::new(), 0, 0);
        for k in 0..shape.layers() {
            before.push(sum);
            above_floor = sum;
            sum += few(shape.layer(k)?.site_count())?;
        }
        Ok(Self {
            shape,
            before,
            above_floor,
            spheres: sum,
        })
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
    /// assert_eq!(Pile::triangular(10)?.numbering()?.sphere_count(), 220);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn sphere_count(&self) -> u64 {
        self.spheres
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
    pub const fn first_on_floor(&self) -> u64 {
        self.above_floor + 1
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
        let before = layer.and_then(|layer| self.before.get(layer));
        let before = before.ok_or_else(|| bug("a layer of the shape has its offset"))?;
        let in_layer = self.shape.layer(k)?.sites_before(i, j);
        Ok(before + few(in_layer)? + 1)
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
        if id > self.spheres {
            return None;
        }
        // The last layer that begins at or before it.
        let begun = self.before.partition_point(|before| *before <= place);
        let layer = begun.checked_sub(1)?;
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

/// A part of the spheres of a pile that are few enough to be numbered.
fn few(spheres: BigUint) -> Result<u64, Error> {
    u64::try_from(spheres).map_err(|_| bug("a part of the spheres is no more than all"))
}
