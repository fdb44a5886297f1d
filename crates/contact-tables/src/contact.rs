//! A row of a table: the force between two spheres, which are known by number or by position.

use core::slice;
use std::io;

/// A row of a table: a contact of two spheres, with the force that was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The two spheres.
    pub spheres: Spheres,
    /// The force along the line between their centres, or the whole force.
    pub force: Force,
    /// The tangential force on the first sphere, if the table lists it besides the normal force.
    pub tangential: Option<[f64; 3]>,
    /// The line of the row, counted from 1. In a file of VTK, the number of the row.
    pub line: u64,
}

/// The identification of the two spheres of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spheres {
    /// The numbers of the spheres, counted from 1. A floor or a wall has a number of its own: 0,
    /// a negative one, or one beyond the last sphere.
    Numbers([i64; 2]),
    /// The position of the contact.
    Places(Place),
}

/// The position of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// The centres of both spheres.
    Centres([[f64; 3]; 2]),
    /// The contact point.
    Point([f64; 3]),
}

/// The measured force of a contact: its magnitude, its vector, or both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force {
    /// The force along the line between the centres; compressive forces are positive.
    Along(f64),
    /// The force on the first sphere.
    Vector([f64; 3]),
    /// Both the force along the line and the vector on the first sphere.
    Both(f64, [f64; 3]),
}

/// Adds a row to others.
///
/// # Errors
/// [`io::ErrorKind::OutOfMemory`].
pub(crate) fn keep(rows: &mut Vec<Contact>, row: Contact) -> io::Result<()> {
    rows.try_reserve(1)?;
    rows.push(row);
    Ok(())
}

impl Contact {
    /// Returns the position of the contact, if it is known by position.
    #[must_use]
    pub const fn place(&self) -> Option<Place> {
        match self.spheres {
            Spheres::Places(place) => Some(place),
            Spheres::Numbers(_) => None,
        }
    }
}

impl Place {
    /// Returns the coordinates: both centres, or the contact point.
    #[must_use]
    pub fn points(&self) -> &[[f64; 3]] {
        match self {
            Self::Centres(centres) => centres,
            Self::Point(point) => slice::from_ref(point),
        }
    }

    /// Returns the contact point.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::Place;
    ///
    /// assert_eq!(Place::Centres([[0.0, 0.0, 2.0], [1.0, 0.0, 0.0]]).point(), [0.5, 0.0, 1.0]);
    /// ```
    #[must_use]
    pub fn point(&self) -> [f64; 3] {
        match self {
            Self::Centres([[x, y, z], [u, v, w]]) => {
                [x.midpoint(*u), y.midpoint(*v), z.midpoint(*w)]
            }
            Self::Point(point) => *point,
        }
    }

    /// Returns the position with each of its points changed.
    #[must_use]
    pub fn map(self, change: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        match self {
            Self::Centres([one, other]) => Self::Centres([change(one), change(other)]),
            Self::Point(point) => Self::Point(change(point)),
        }
    }
}

impl Force {
    /// Returns the magnitude and the vector, as far as they were measured.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::Force;
    ///
    /// assert_eq!(Force::Vector([3.0, 0.0, 4.0]).parts(), (None, Some([3.0, 0.0, 4.0])));
    /// ```
    #[must_use]
    pub const fn parts(self) -> (Option<f64>, Option<[f64; 3]>) {
        match self {
            Self::Along(force) => (Some(force), None),
            Self::Vector(vector) => (None, Some(vector)),
            Self::Both(force, vector) => (Some(force), Some(vector)),
        }
    }

    /// Returns the force with its vector transformed.
    #[must_use]
    pub fn map(self, change: impl FnOnce([f64; 3]) -> [f64; 3]) -> Self {
        match self {
            Self::Along(force) => Self::Along(force),
            Self::Vector(vector) => Self::Vector(change(vector)),
            Self::Both(force, vector) => Self::Both(force, change(vector)),
        }
    }
}
