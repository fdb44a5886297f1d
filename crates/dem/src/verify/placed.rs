//! The measured force of a contact that is known by its position.

use contact_tables::{Contact, Force, Place, Spheres};

use super::measured::refuse_infinite;
use super::refusal::Fault;

/// A measured force between two spheres that are known by position.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{Force, Placed};
///
/// let push = Placed::at([-0.6, 0.0, 0.8], Force::Along(0.625));
/// assert_ne!(push, Placed::at([-0.6, 0.0, 0.8], Force::Along(-0.625)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    pub(super) place: Place,
    pub(super) force: Force,
}

impl Placed {
    /// Returns a measurement at a contact point, in m. A vector may be the force on either sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Comparison, Force, Placed};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// let measured = [-0.6, 0.6].map(|x| Placed::at([x, 0.0, 0.8], Force::Vector([-0.625 * x, 0.0, 0.5])));
    /// let (comparison, frame) = Comparison::of_places(&packing, measured, 0.1)?;
    /// assert!(comparison.accepted(1e-12) && frame.is_none());
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub const fn at(point: [f64; 3], force: Force) -> Self {
        let place = Place::Point(point);
        Self { place, force }
    }

    /// Returns a measurement between two centres, in m. A vector is the force on the first sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Comparison, Force, Placed};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// let centres = [-1.2, 1.2].map(|x| [[0.0, 0.0, 1.6], [x, 0.0, 0.0]]);
    /// let measured = centres.map(|centres| Placed::between(centres, Force::Along(0.625)));
    /// let (comparison, _) = Comparison::of_places(&packing, measured, 0.1)?;
    /// assert!(comparison.accepted(1e-12));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub const fn between(centres: [[f64; 3]; 2], force: Force) -> Self {
        let place = Place::Centres(centres);
        Self { place, force }
    }

    /// Returns the measurements in the rows of a table.
    pub(super) fn all(rows: &[Contact]) -> impl Iterator<Item = Self> {
        rows.iter().filter_map(|row| {
            let (place, force) = (row.place()?, row.force);
            Some(Self { place, force })
        })
    }

    /// Returns the measurement as a row of a table, if all its numbers are finite.
    pub(super) fn row(&self, line: u64) -> Result<Contact, Fault> {
        let mut coordinates = self.place.points().iter().flatten().copied();
        if let Some(value) = coordinates.find(|x| !x.is_finite()) {
            let column = "a coordinate";
            return Err(Fault::NotFinite { column, value });
        }
        refuse_infinite(self.force)?;
        Ok(Contact {
            spheres: Spheres::Places(self.place),
            force: self.force,
            tangential: None,
            line,
        })
    }
}
