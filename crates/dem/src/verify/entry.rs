//! A row of a table: two spheres, known by their numbers or by where they are, and the force between them.

use super::measured::Measured;
use super::refusal::Refusal;
use crate::Error;
use crate::error::bug;

/// A row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) spheres: Spheres,
    pub(super) force: Force,
}

/// The two spheres of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spheres {
    /// By their numbers, from 1.
    Numbers([u64; 2]),
    /// By where they are.
    Places(Place),
}

/// Where a contact is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// The centres of both spheres.
    Centres([[f64; 3]; 2]),
    /// The point where they touch.
    Point([f64; 3]),
}

/// The force of a contact, as it was measured: its magnitude, its vector, or both.
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
    /// Along the line between the centres; positive is push.
    Along(f64),
    /// The force on the first sphere.
    Vector([f64; 3]),
    /// Both.
    Both(f64, [f64; 3]),
}

impl Entry {
    /// Returns the force between the two spheres that it names.
    pub(super) fn named(&self) -> Result<Measured, Error> {
        match self.spheres {
            Spheres::Numbers(ids) => Ok(self.force.between(ids)),
            Spheres::Places(_) => Err(bug("a table is read by numbers, or by place")),
        }
    }

    /// Returns where its contact is.
    pub(super) fn place(&self) -> Result<Place, Error> {
        match self.spheres {
            Spheres::Places(place) => Ok(place),
            Spheres::Numbers(_) => Err(bug("a table is read by numbers, or by place")),
        }
    }
}

impl Force {
    /// Returns it as that between two spheres, the vector on the first.
    pub(super) fn between(self, ids: [u64; 2]) -> Measured {
        match self {
            Self::Along(force) => Measured::new(ids, force),
            Self::Vector(vector) => Measured::of_vector(ids, vector),
            Self::Both(force, vector) => Measured::new(ids, force).with_vector(vector),
        }
    }

    /// Returns it with the vector changed.
    pub(super) fn map(self, change: impl FnOnce([f64; 3]) -> [f64; 3]) -> Self {
        match self {
            Self::Along(force) => Self::Along(force),
            Self::Vector(vector) => Self::Vector(change(vector)),
            Self::Both(force, vector) => Self::Both(force, change(vector)),
        }
    }

    /// Returns the greatest magnitude of its numbers.
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

/// What takes the rows of a file.
pub(super) trait Sink {
    /// Forgets what there was: another snapshot follows.
    fn begin_snapshot(&mut self, timestep: Option<i64>);

    /// Takes a row of a line.
    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal>;

    /// Takes note of a contact with a wall.
    fn pass_over(&mut self);
}
