//! Measured contact forces, compared with the exact ones of a pile: whether a simulation got it right.
//!
//! What is measured is a list of pairs of spheres with the force between them, [`Measured`]: from a file ([`read`]: a
//! csv table, or what LAMMPS writes as `dump local`), or straight from a simulation. A [`Comparison`] holds it against a
//! [`Packing`](crate::Packing), contact by contact.
//!
//! # What is compared
//! Spheres are numbered from 1, in row order from the top, as `cannonpile spheres` prints them. A force is in the units of
//! the packing, N for sizes in SI; positive is push. A vector is the force **on the first** of the two spheres. So it is
//! in LAMMPS: `force` of `compute pair/local` is positive for repulsion, and `fx fy fz` act on `patom1` of
//! `compute property/local`, whichever of the two has the greater id.
//!
//! * The exact force is rounded once, to the nearest `f64`, and compared with the `f64` measured: an error of 0 means that
//!   all bits agree, and no other is reported as 0. A relative error is itself right to a few units of 2⁻⁵³.
//! * The error of a contact is |f − f₀|/|f₀|, f measured, f₀ exact; with a vector the greater of that and
//!   |**F** − **F**₀|/|f₀|. So a force that is turned has an error, and so has a magnitude that is not that of its vector.
//!   Pull (a negative force) is a difference like any other.
//! * A contact whose exact force is 0 may be measured or not. The error of what is measured there is relative to the
//!   largest exact force of the pile.
//! * A contact whose exact force is not 0 and that is not in the list, or is there with a force of 0, is missing.
//! * A pair that is no contact of the pile is extra if it has a force over the accepted error times the largest exact
//!   force; below that it is noise. This goes for neighbours that touch beside the contacts too, as in a layer at a = R.
//! * Two spheres of the bottom layer are fixed: such pairs are counted, and not judged.
//!
//! # Examples
//! A test of a simulation in three lines:
//! ```
//! use cannonpile::geometry::Spacing;
//! use cannonpile::verify::{Comparison, Measured};
//! use cannonpile::{Packing, Pile};
//! use num_rational::BigRational;
//!
//! let pile = Pile::triangular(2)?;
//! let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
//!
//! let simulated = [(2, 1, 0.46225021), (3, 1, 0.46225018), (4, 1, 0.46225014)];
//! let measured = simulated.map(|(id1, id2, force)| Measured::new([id1, id2], force));
//! let comparison = Comparison::new(&packing, measured)?;
//! assert!(comparison.accepted(1e-6), "{comparison}");
//! # Ok::<(), cannonpile::verify::Refusal>(())
//! ```

mod columns;
mod comparison;
mod csv_file;
mod difference;
mod dump;
mod exact;
mod lines;
mod pairs;
mod reading;
mod refusal;
mod report;
mod tally;

pub use comparison::Comparison;
pub use csv_file::read_csv;
pub use difference::{Difference, Extra};
pub use dump::read_dump;
pub use reading::{Reading, read};
pub use refusal::{Fault, Refusal};
pub use report::Report;

/// The most entries that are read, and the most contacts of a pile that they are compared with.
pub const MAX_ENTRIES: u64 = 100_000_000;

/// The force that was measured between two spheres.
///
/// # Examples
/// ```
/// use cannonpile::verify::Measured;
///
/// let push = Measured::new([1, 4], 2.0).with_vector([-1.2, 0.0, 1.6]);
/// assert_eq!(push.reversed(), Measured::new([4, 1], 2.0).with_vector([1.2, 0.0, -1.6]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The numbers of the two spheres, from 1.
    pub ids: [u64; 2],
    /// The force along the line between their centres; positive is push.
    pub force: f64,
    /// The force on the first of them, z up, if it was measured.
    pub vector: Option<[f64; 3]>,
}

impl Measured {
    /// A force of which the magnitude is known.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::verify::Measured;
    ///
    /// let pull = Measured::new([1, 4], -2.0);
    /// assert_eq!((pull.ids, pull.force, pull.vector), ([1, 4], -2.0, None));
    /// ```
    #[must_use]
    pub const fn new(ids: [u64; 2], force: f64) -> Self {
        Self {
            ids,
            force,
            vector: None,
        }
    }

    /// With the force on the first of the two spheres as a vector.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::verify::Measured;
    ///
    /// // The magnitude stays what was measured, that of the vector or not.
    /// let turned = Measured::new([1, 4], 2.0).with_vector([0.0, 0.0, 2.5]);
    /// assert_eq!((turned.force, turned.vector), (2.0, Some([0.0, 0.0, 2.5])));
    /// ```
    #[must_use]
    pub const fn with_vector(mut self, vector: [f64; 3]) -> Self {
        self.vector = Some(vector);
        self
    }

    /// The same, told of the other sphere: the vector is turned round.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::verify::Measured;
    ///
    /// let pull = Measured::new([1, 4], -2.0).with_vector([1.2, 0.0, -1.6]);
    /// // Pull is pull, seen from either sphere.
    /// assert_eq!((pull.reversed().ids, pull.reversed().force), ([4, 1], -2.0));
    /// assert_eq!(pull.reversed().reversed(), pull);
    /// ```
    #[must_use]
    pub fn reversed(self) -> Self {
        let [first, second] = self.ids;
        Self {
            ids: [second, first],
            // 0 stays 0, not -0.
            vector: self.vector.map(|vector| vector.map(|x| 0.0 - x)),
            ..self
        }
    }

    /// Whether there is no force at all: the two do not touch.
    fn is_zero(&self) -> bool {
        self.magnitude() == 0.0
    }

    /// The greater of the magnitude and that of the vector.
    fn magnitude(&self) -> f64 {
        let vector = self.vector.map_or(0.0, difference::norm);
        self.force.abs().max(vector)
    }
}
