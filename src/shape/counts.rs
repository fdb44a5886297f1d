//! Closed forms for the numbers of spheres and rows.

use core::ops::Range;

use num_bigint::BigUint;
use num_integer::Integer;
use num_traits::Zero;

use super::{Anchor, RunLayers, Shape};
use crate::Error;
use crate::each::Each;
use crate::lattice::Site;
use crate::shape::Numbering;

impl Shape {
    /// Returns the number of spheres, which may exceed any machine integer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Shape;
    /// use cannonpile::stacking::Stacking;
    ///
    /// let shape = Shape::under(Region::SITE, Stacking::fcc(10)?)?;
    /// assert_eq!(shape.sphere_count(), 220_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn sphere_count(&self) -> BigUint {
        self.spheres_in(0..self.layers())
    }

    /// Returns the number of spheres in these layers.
    ///
    /// Sign changes, and layers where a side of the region vanishes, divide the pile into pieces. Within a piece the
    /// number of spheres in layer k is a polynomial of degree two in k, and Newton's forward differences give its sum.
    pub(crate) fn spheres_in(&self, layers: Range<i128>) -> BigUint {
        let mut sum = BigUint::zero();
        let mut from = layers.start.max(0);
        let end = layers.end.min(self.layers());
        while from < end {
            let to = self.end_of_piece(from).min(end);
            sum += self.spheres_in_piece(from..to);
            from = to;
        }
        sum
    }

    /// Returns the number of rows in these layers. Within a piece the number of rows in layer k is linear in k.
    pub(super) fn rows_in(&self, layers: Range<i128>) -> BigUint {
        let rows = |k| {
            let region = self.region(k);
            region.map_or_else(BigUint::zero, |r| (r.widths()[1].unsigned_abs() + 1).into())
        };
        let mut twice_sum = BigUint::zero();
        let mut from = layers.start.max(0);
        let end = layers.end.min(self.layers());
        while from < end {
            let to = self.end_of_piece(from).min(end);
            twice_sum += (rows(from) + rows(to - 1)) * (to - from).unsigned_abs();
            from = to;
        }
        twice_sum / 2_u32
    }

    /// Returns the number of spheres at the sign changes above layer `k`.
    pub(crate) fn spheres_at_changes_above(&self, k: i128) -> BigUint {
        let changes = self.runs.iter().skip(1).map(|run| run.from);
        let regions = changes
            .take_while(|from| *from < k)
            .filter_map(|from| self.region(from));
        regions.map(|region| region.site_count()).sum()
    }

    /// Returns the first layer of the next piece after layer `k`.
    fn end_of_piece(&self, k: i128) -> i128 {
        let Some(RunLayers { sign, to, .. }) = self.run_to(k + 1) else {
            return k + 1;
        };
        let (Anchor::Base(_), Some(bottom)) = (self.anchor, self.region(to)) else {
            return to + 1;
        };
        // Upwards from the bottom of the run, sides shrink and may vanish.
        let breaks = bottom.vanishing_sides(sign).each(|steps| to - steps);
        breaks
            .into_iter()
            .filter(|layer| *layer > k)
            .min()
            .map_or(to, |layer| layer.min(to))
            + 1
    }

    fn spheres_in_piece(&self, layers: Range<i128>) -> BigUint {
        let count = |k| {
            self.region(k)
                .map_or_else(BigUint::zero, |r| r.site_count())
        };
        let n = layers.end - layers.start;
        if n <= 3 {
            return layers.map(count).sum();
        }
        let [c0, c1, c2] = [0, 1, 2].each(|t| num_bigint::BigInt::from(count(layers.start + t)));
        let n = num_bigint::BigInt::from(n);
        let pairs = (&n * (&n - 1_u32)).div_floor(&2.into());
        let triples = (&pairs * (&n - 2_u32)).div_floor(&3.into());
        let first = &c1 - &c0;
        let second = c2 - &c1 - &first;
        // A count is not negative, so its magnitude is the value.
        (n * c0 + pairs * first + triples * second).into_parts().1
    }

    /// Returns the number of spheres before this one, in row order from the top.
    ///
    /// # Errors
    /// As for [`check`](Self::check).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(10, Dimension::Three)?;
    /// // Layer 2 begins after 1 + 3 spheres, and its second row 3 spheres later.
    /// assert_eq!(pyramid.before(Site { i: 1, j: 1, k: 2 })?, 8_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn before(&self, site: Site) -> Result<BigUint, Error> {
        let Site { i, j, k } = self.check(site)?;
        let region = self.layer(k)?;
        let in_layer = region.sites_before(i, j);
        Ok(self.spheres_in(0..k) + in_layer)
    }

    /// Returns the [`Numbering`] of all spheres, which converts between sites and numbers.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more than 10¹¹ spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::shape::Shape;
    ///
    /// let pyramid = Shape::pyramid(10, Dimension::Three)?;
    /// assert_eq!(pyramid.numbering()?.id(Site { i: 1, j: 1, k: 2 })?, 9);
    /// assert!(Shape::pyramid(10_000, Dimension::Three)?.numbering().is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn numbering(&self) -> Result<Numbering<'_>, Error> {
        Numbering::new(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Region;

    #[test]
    fn a_run_is_one_piece() {
        let shape = Shape::under(Region::SITE, "++++-----+".parse().unwrap()).unwrap();
        let pieces = core::iter::successors(Some(0), |k| Some(shape.end_of_piece(*k)));
        assert!(pieces.take_while(|k| *k < shape.layers()).eq([0, 5, 10]));
    }
}
