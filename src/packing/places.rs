//! The centres of spheres and their points of contact, correctly rounded.

use core::marker::PhantomData;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use super::upwards;
use crate::each::Each;
use crate::engine::{Unit, check_interrupt};
use crate::forces::check_lengths;
use crate::geometry::Vector;
use crate::lattice::{Direction, Row, Site};
use crate::scalar::{CorrectlyRounded, Surd};
use crate::{Error, Packing};

/// The centres of spheres and their points of contact, row by row, with coordinates correctly rounded to the floats
/// `F`.
///
/// Made by [`Packing::places`]. Coordinates are in the unit of the radius and in the frame of [`Packing::position`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Row;
/// use cannonpile::{Packing, Pile};
///
/// let pile = Pile::triangular(10)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let [mut x, mut y, mut z] = [[0.0; 3]; 3];
/// let row = Row { k: 9, j: 0, i: 0..3 };
/// packing.places::<f64>().fill_row(&row, [&mut x, &mut y, &mut z])?;
/// assert_eq!((y, z), ([-10.8, -8.4, -6.0], [0.0; 3]));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Places<'p, F> {
    packing: Packing<'p>,
    /// The denominator of the coordinates in the symbolic basis, which are sums of half directions.
    halves: BigInt,
    units: [Unit; 3],
    floats: PhantomData<F>,
}

impl<'p> Packing<'p> {
    /// Returns the centres and the points of contact, with correctly rounded coordinates. This is the fastest way to
    /// compute many of them.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Row};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let [mut x, mut y, mut z] = [[0.0_f32]; 3];
    /// let places = packing.places();
    /// let apex = Row { k: 0, j: 0, i: 0..1 };
    /// places.fill_row_of_contacts(&apex, Direction::Beta, [&mut x, &mut y, &mut z])?;
    /// assert_eq!((x, y, z), ([-0.34641016], [0.6], [0.7211103]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn places<F: CorrectlyRounded>(&self) -> Places<'p, F> {
        // A centre is a sum of directions, and a point of contact is a sum of half directions.
        let halves: BigInt = self.forces.direction_scale() * 2;
        let diameter = self.diameter();
        let unit = |root: &Surd| Unit::new(root.scaled(&diameter), halves.clone());
        Places {
            packing: self.clone(),
            units: self.roots.lengths().each(unit),
            halves,
            floats: PhantomData,
        }
    }
}

impl<F: CorrectlyRounded> Places<'_, F> {
    /// Writes the centres of consecutive spheres of a row into slices of x, y and z.
    ///
    /// # Errors
    /// [`Error::SiteOutside`], [`Error::Length`]; [`Error::Overflow`] for a coordinate beyond the range of the floats;
    /// [`Error::TooLarge`] for a row that does not fit in memory.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Row;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(3)?;
    /// let packing = Packing::new(&pile, &"5/4".parse()?)?;
    /// let mut places = [[0.0]; 3];
    /// let slices = places.each_mut().map(|slice| slice.as_mut_slice());
    /// packing.places::<f64>().fill_row(&Row { k: 0, j: 0, i: 0..1 }, slices)?;
    /// // The height of two layers is 2√(4 − (5/4)²).
    /// assert_eq!(places[2], [3.122498999199199]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row(&self, row: &Row, slices: [&mut [F]; 3]) -> Result<(), Error> {
        self.fill(row, slices, |site| self.centre(site))
    }

    /// Writes the contact points of consecutive spheres with their supports along `direction` into slices of x, y and
    /// z.
    ///
    /// # Errors
    /// [`Error::OnFloor`], [`Error::NoSuchDirection`]; otherwise as for [`fill_row`](Self::fill_row).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Row};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// let [mut x, mut y, mut z] = [[0.0]; 3];
    /// let apex = Row { k: 0, j: 0, i: 0..1 };
    /// let slices = [x.as_mut_slice(), &mut y, &mut z];
    /// packing.places::<f64>().fill_row_of_contacts(&apex, Direction::Gamma, slices)?;
    /// assert_eq!((x, y), ([0.6928203230275509], [0.0]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row_of_contacts(
        &self,
        row: &Row,
        direction: Direction,
        slices: [&mut [F]; 3],
    ) -> Result<(), Error> {
        self.fill(row, slices, |site| self.point(site, direction))
    }

    /// Writes coordinates that change by a constant step along a row.
    fn fill(
        &self,
        row: &Row,
        slices: [&mut [F]; 3],
        at: impl Fn(Site) -> Result<[BigInt; 3], Error>,
    ) -> Result<(), Error> {
        check_interrupt()?;
        check_lengths(row.length()?, &slices)?;
        let mut sites = row.clone().into_iter();
        let Some(first) = sites.next() else {
            return Ok(());
        };
        let shape = self.packing.pile().shape();
        shape.check(Site {
            i: row.i.end - 1,
            ..first
        })?;
        let here = at(first)?;
        let next = match sites.next() {
            Some(second) => at(second)?,
            None => here.clone(),
        };
        let along = here.into_iter().zip(next);
        for (((first, second), unit), slice) in along.zip(&self.units).zip(slices) {
            let step = second - &first;
            if step.is_zero() {
                slice.fill(unit.nearest(&first).ok_or_else(overflow::<F>)?);
            } else if let (Some(first), Some(step)) = (first.to_i64(), step.to_i64()) {
                for (n, place) in (0..).zip(slice) {
                    let at = i128::from(first) + n * i128::from(step);
                    *place = unit.nearest_to(at).ok_or_else(overflow::<F>)?;
                }
            } else {
                for (n, place) in (0_u64..).zip(slice) {
                    let at = &first + &step * n;
                    *place = unit.nearest(&at).ok_or_else(overflow::<F>)?;
                }
            }
        }
        Ok(())
    }

    /// Returns the coordinates of a centre, over `halves`, with z up from the bottom layer.
    fn centre(&self, site: Site) -> Result<[BigInt; 3], Error> {
        let forces = &self.packing.forces;
        let Vector { x, y, z } = forces.position_numerators(site)?;
        let bottom = &self.halves * (self.packing.pile().layers() - 1);
        Ok([x * 2, y * 2, bottom - z * 2])
    }

    /// Returns the coordinates of the point of contact between a sphere and the sphere below it.
    fn point(&self, site: Site, direction: Direction) -> Result<[BigInt; 3], Error> {
        let forces = &self.packing.forces;
        let lean = forces.contact_direction_numerators(site, direction)?;
        let [x, y, z] = self.centre(site)?;
        // The contact point lies half a contact direction back from the centre. The z of `lean` points down.
        Ok([x - lean.x, y - lean.y, z + lean.z])
    }
}

fn overflow<F>() -> Error {
    Error::overflow("a position", core::any::type_name::<F>())
}

impl Packing<'_> {
    /// Returns the point of contact between a sphere and the sphere below it, in 2R and the symbolic basis, with z up
    /// from the bottom layer.
    pub(super) fn point(
        &self,
        site: Site,
        direction: Direction,
    ) -> Result<Vector<BigRational>, Error> {
        let lean = upwards(self.forces.contact_direction(site, direction)?);
        let half = BigRational::new((-1).into(), 2.into());
        Ok(self.centre(site)? + &lean.scaled(&half))
    }
}
