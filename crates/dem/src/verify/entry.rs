//! A row of a table: the force between two spheres, which are known by number or by position.

use super::measured::Measured;
use super::refusal::Refusal;
use crate::Error;
use crate::error::bug;

/// A row of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) spheres: Spheres,
    pub(super) force: Force,
}

/// The identification of the two spheres of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spheres {
    /// The numbers of the spheres, from 1.
    Numbers([u64; 2]),
    /// The position of the contact.
    Places(Place),
}

/// The position of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// The centres of both spheres.
    Centres([[f64; 3]; 2]),
    /// The contact point.
    Point([f64; 3]),
}

/// The measured force of a contact: its magnitude, its vector, or both.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{Force, Placed};
///
/// let force = Force::Both(0.625, [0.375, 0.0, 0.5]);
/// assert_ne!(Placed::at([-0.6, 0.0, 0.8], force), Placed::at([-0.6, 0.0, 0.8], Force::Along(0.625)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force {
    /// The force along the line between the centres; compressive forces are positive.
    Along(f64),
    /// The force on the first sphere.
    Vector([f64; 3]),
    /// Both the force along the line and the vector on the first sphere.
    Both(f64, [f64; 3]),
}

impl Entry {
    /// Returns the force between the two numbered spheres of the row.
    pub(super) fn named(&self) -> Result<Measured, Error> {
        match self.spheres {
            Spheres::Numbers(ids) => Ok(self.force.between(ids)),
            Spheres::Places(_) => Err(bug("a table is read by numbers, or by place")),
        }
    }

    /// Returns the position of the contact.
    pub(super) fn place(&self) -> Result<Place, Error> {
        match self.spheres {
            Spheres::Places(place) => Ok(place),
            Spheres::Numbers(_) => Err(bug("a table is read by numbers, or by place")),
        }
    }
}

impl Force {
    /// Returns the force as a measurement between two numbered spheres. A vector acts on the first.
    pub(super) fn between(self, ids: [u64; 2]) -> Measured {
        match self {
            Self::Along(force) => Measured::new(ids, force),
            Self::Vector(vector) => Measured::of_vector(ids, vector),
            Self::Both(force, vector) => Measured::new(ids, force).with_vector(vector),
        }
    }

    /// Returns the force with its vector transformed.
    pub(super) fn map(self, change: impl FnOnce([f64; 3]) -> [f64; 3]) -> Self {
        match self {
            Self::Along(force) => Self::Along(force),
            Self::Vector(vector) => Self::Vector(change(vector)),
            Self::Both(force, vector) => Self::Both(force, change(vector)),
        }
    }

    /// Returns the largest absolute value among the magnitude and the components of the vector.
    pub(super) fn magnitude(self) -> f64 {
        let greatest =
            |numbers: [f64; 3]| numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        match self {
            Self::Along(force) => force.abs(),
            Self::Vector(vector) => greatest(vector),
            Self::Both(force, vector) => force.abs().max(greatest(vector)),
        }
    }
}

/// A receiver for the rows of a file.
pub(super) trait Sink {
    /// Begins a new snapshot, and discards the rows of the previous one.
    fn begin_snapshot(&mut self, timestep: Option<i64>);

    /// Receives the row of a line.
    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal>;

    /// Counts a contact with a wall.
    fn pass_over(&mut self);
}
