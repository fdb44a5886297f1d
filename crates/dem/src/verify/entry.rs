//! A row of a table: the force between two spheres, which are known by number or by position.

use core::slice;

use super::measured::Measured;
use super::refusal::{Fault, Refusal};
use crate::error::bug;
use crate::vector::plus;
use crate::{Each, Error};

/// A row of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) spheres: Spheres,
    pub(super) force: Force,
    /// The tangential force on the first sphere, if the table lists it besides the normal force.
    pub(super) tangential: Option<[f64; 3]>,
}

/// The identification of the two spheres of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Spheres {
    /// The numbers of the spheres, counted from 1. A number outside the pile may belong to the floor or to a wall, as
    /// 0, a negative number, or one beyond the last sphere.
    Numbers([i64; 2]),
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
    /// Returns the numbers of the two spheres.
    pub(super) fn numbers(&self) -> Result<[i64; 2], Error> {
        match self.spheres {
            Spheres::Numbers(ids) => Ok(ids),
            Spheres::Places(_) => Err(bug("a table is read by numbers, or by place")),
        }
    }

    /// Returns the force between the two numbered spheres of the row. No number may be negative.
    pub(super) fn named(&self) -> Result<Measured, Fault> {
        let ids = self.numbers().map_err(Fault::of_error)?;
        match ids.each(u64::try_from) {
            [Ok(one), Ok(other)] => Ok(self.between([one, other])),
            [first, _] => {
                let (column, id) = match (first, ids) {
                    (Err(_), [id, _]) => ("id1", id),
                    (Ok(_), [_, id]) => ("id2", id),
                };
                let error = Error::syntax(&id.to_string(), "a number of at least 0");
                Err(Fault::Field {
                    column,
                    error: Box::new(error),
                })
            }
        }
    }

    /// Returns the force as a measurement between two numbered spheres.
    pub(super) fn between(&self, ids: [u64; 2]) -> Measured {
        Measured {
            tangential: self.tangential,
            ..self.force.between(ids)
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

impl Place {
    /// Returns the coordinates: both centres, or the contact point.
    pub(super) fn points(&self) -> &[[f64; 3]] {
        match self {
            Self::Centres(centres) => centres,
            Self::Point(point) => slice::from_ref(point),
        }
    }

    /// Returns the contact point.
    pub(super) fn point(&self) -> [f64; 3] {
        match self {
            Self::Centres([[x, y, z], [u, v, w]]) => {
                [x.midpoint(*u), y.midpoint(*v), z.midpoint(*w)]
            }
            Self::Point(point) => *point,
        }
    }

    /// Returns the position with each of its points changed.
    pub(super) fn map(self, change: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        match self {
            Self::Centres(centres) => Self::Centres(centres.each(change)),
            Self::Point(point) => Self::Point(change(point)),
        }
    }
}

impl Force {
    /// Returns the measured force on the first sphere.
    pub(super) fn of(measured: &Measured) -> Self {
        match measured.vector {
            Some(vector) => Self::Both(measured.force, vector),
            None => Self::Along(measured.force),
        }
    }

    /// Returns the force as a measurement between two numbered spheres. A vector acts on the first.
    pub(super) fn between(self, ids: [u64; 2]) -> Measured {
        match self {
            Self::Along(force) => Measured::new(ids, force),
            Self::Vector(vector) => Measured::of_vector(ids, vector),
            Self::Both(force, vector) => Measured::new(ids, force).with_vector(vector),
        }
    }

    /// Returns the whole force of a contact with a floor or a wall: the sum of the normal and the tangential vector.
    pub(super) fn with_tangential(self, tangential: Option<[f64; 3]>) -> Self {
        match (self, tangential) {
            (Self::Vector(normal), Some(tangential)) => Self::Vector(plus(normal, tangential)),
            (Self::Both(force, normal), Some(tangential)) => {
                Self::Both(force, plus(normal, tangential))
            }
            (force, _) => force,
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

    /// Refuses a force that is infinite or NaN.
    pub(super) fn refuse_infinite(self) -> Result<(), Fault> {
        let (along, [x, y, z]) = match self {
            Self::Along(along) => (along, [0.0; 3]),
            Self::Vector(vector) => (0.0, vector),
            Self::Both(along, vector) => (along, vector),
        };
        let mut numbers = [("force", along), ("fx", x), ("fy", y), ("fz", z)].into_iter();
        match numbers.find(|(_, x)| !x.is_finite()) {
            Some((column, value)) => Err(Fault::NotFinite { column, value }),
            None => Ok(()),
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
    /// Begins another step, and discards the rows of the previous one.
    fn begin_step(&mut self);

    /// Receives the row of a line.
    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal>;

    /// Counts a contact with a wall.
    fn pass_over(&mut self);
}
