//! Numbers of the spheres of a pile.

use alloc::vec::Vec;

use num_bigint::BigUint;

use super::{Shape, Site};
use crate::Error;
use crate::error::{bug, refuse_beyond};

/// The greatest number of spheres in a numbering. Up to this limit, numbers fit in a `u64`, and the offsets of all
/// layers fit in memory.
const MOST: u64 = 100_000_000_000;

/// The numbers 1, 2, 3, … of the spheres of a pile, in row order from the top. Tables and exported files use them.
///
/// A numbering stores one offset per layer. It finds the number of a site by its layer, and the site of a number by two
/// bisections. The spheres of the bottom layer have the greatest numbers.
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
    /// The number of spheres above each layer.
    before: Vec<u64>,
    /// The number of spheres above the bottom layer.
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

    /// Returns the shape whose spheres are numbered.
    #[must_use]
    pub fn shape(&self) -> &'p Shape {
        self.shape
    }

    /// Returns the number of spheres, which is the greatest number of a sphere.
    #[must_use]
    pub const fn sphere_count(&self) -> u64 {
        self.spheres
    }

    /// Returns the number of the first sphere of the bottom layer. All spheres from this number on are on the floor.
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

    /// Returns the number of the sphere at `site`.
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
    /// // Four spheres lie above. The first row of the hexagon begins at i = 0.
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

    /// Returns the site of the sphere with number `id`, or `None` for 0 and for numbers beyond the last.
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
        let position = id.checked_sub(1)?;
        if id > self.spheres {
            return None;
        }
        // The last layer that begins at or before the position.
        let begun = self.before.partition_point(|before| *before <= position);
        let layer = begun.checked_sub(1)?;
        let in_layer = BigUint::from(position - self.before.get(layer)?);
        let k = i128::try_from(layer).ok()?;
        let region = self.shape.layer(k).ok()?;
        let first_of = |j| region.sites_before(region.row(j).start, j);
        // The last row that begins at or before the position.
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

/// Converts the number of some spheres of a pile. It fits in a `u64`, because the number of all spheres does.
fn few(spheres: BigUint) -> Result<u64, Error> {
    u64::try_from(spheres).map_err(|_| bug("a part of the spheres is no more than all"))
}
