//! The reasons why measured forces are rejected: one line, with the place, the value and the remedy.

use core::fmt;
use std::io;

use crate::error::bug;
use crate::{Each, Error};

/// The reason why measured forces were not compared.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify;
///
/// let refused = verify::read(&b"id1,id2,force\n1,2,0.5\n1,3,half\n"[..]).unwrap_err();
/// assert_eq!(refused.to_string(), "line 3: force 'half' is not a number such as 0.46 or 1e-3");
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub enum Refusal {
    /// The file could not be read.
    Table(contact_tables::Error),
    /// A row of a file does not match the pile.
    Line {
        /// The line, counted from 1.
        line: u64,
        /// The fault.
        fault: Fault,
    },
    /// A fault in an entry of a list.
    Entry {
        /// The entry, counted from 1.
        entry: u64,
        /// The fault.
        fault: Fault,
    },
    /// The scene has no exact forces to compare with.
    Scene(Error),
    /// Exact forces outside the normal range of `f64`.
    OutOfRange,
    /// The positions do not match the pile in any frame that is searched: one whose vertical is an axis of the table.
    Elsewhere {
        /// The number of positions of a sample that match in the best frame.
        found: usize,
        /// The size of the sample.
        sample: usize,
    },
    /// A distance, in radii, that is not between 0 and 1/2.
    Within(f64),
    /// No row was read, or none was of the kind that is asked for.
    NoRows {
        /// The reason, with a remedy.
        reason: String,
    },
    /// The table with the forces of the floor was refused.
    FloorTable(Box<Refusal>),
    /// Both tables list contacts with the floor.
    FloorTwice,
    /// There is a table of the floor, but contacts are matched by position.
    FloorByPlace,
}

/// A fault in a row of a file, or in an entry of a list.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// A number is infinite or NaN.
    NotFinite {
        /// The quantity.
        column: &'static str,
        /// The value.
        value: f64,
    },
    /// The number of a sphere is not in the pile.
    NoSuchSphere {
        /// The number.
        id: i128,
        /// The number of the first sphere of the pile.
        first: u64,
        /// The number of spheres of the pile.
        spheres: u64,
    },
    /// A sphere is paired with itself.
    OneSphere {
        /// The number of the sphere.
        id: u64,
    },
    /// A sphere is in two rows of a table of the floor.
    SphereTwice {
        /// The number of the sphere.
        id: u64,
    },
    /// A pair is in three rows, or in two rows of the same order with different forces.
    Twice {
        /// The numbers of the two spheres.
        ids: [u64; 2],
        /// The line or the entry of the first occurrence.
        first: u64,
    },
    /// No two spheres touch at a position.
    NoSphereAt {
        /// The position in the axes of the scene, in m.
        point: [f64; 3],
        /// The largest accepted distance from an exact position, in radii.
        within: f64,
        /// The distance of the nearest sphere from its exact position, in radii.
        nearest: f64,
    },
    /// The file has too many entries.
    TooMany {
        /// The largest accepted number of entries.
        limit: u64,
    },
    /// An internal error of this library.
    Bug {
        /// [`Error::Bug`](cannonpile::Error::Bug).
        error: Box<Error>,
    },
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Table(error) => error.fmt(f),
            Self::Line {
                line,
                fault: Fault::Twice {
                    ids: [a, b],
                    first,
                },
            } => write!(
                f,
                "line {line}: spheres {a} and {b} are already on line {first}: {ONCE}{STEPS}"
            ),
            Self::Line { line, fault } => write!(f, "line {line}: {fault}"),
            Self::Entry { entry, fault } => write!(f, "entry {entry}: {fault}"),
            Self::Scene(error) => error.fmt(f),
            Self::OutOfRange => f.write_str(
                "a contact force of this scene does not fit in f64: measure mass or gravity in another unit",
            ),
            Self::Elsewhere { found, sample } => write!(
                f,
                "no frame matches the positions of the table to the scene: the best one matches {found} of {sample}; is the \
                 table of this scene, in m? If gravity is along none of its axes, turn positions and vectors until it is along −z"
            ),
            Self::Within(share) => write!(
                f,
                "{share} radii are not between 0 and 0.5: 0.1 is usual"
            ),
            Self::NoRows { reason } => f.write_str(reason),
            Self::FloorTable(refusal) => write!(f, "table of the floor: {refusal}"),
            Self::FloorByPlace => f.write_str(
                "its rows have the numbers of spheres: match contacts by numbers, or leave out this table",
            ),
            Self::FloorTwice => f.write_str(
                "both tables list contacts with the floor: leave out this one, or remove the contacts from the other",
            ),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSphereAt {
                point: [x, y, z],
                within,
                nearest,
            } => write!(
                f,
                "no contact at ({x:.6}, {y:.6}, {z:.6}) m: the nearest sphere is {nearest:.4} R off, but only {within} R is allowed"
            ),
            Self::NotFinite { column, value } => {
                write!(
                    f,
                    "{column} is {value}: forces and positions must be finite"
                )
            }
            Self::NoSuchSphere { id, first, spheres } => {
                let first = i128::from(*first);
                let last = first + i128::from(*spheres) - 1;
                write!(
                    f,
                    "no sphere {id}: the spheres of this scene are numbered {first} to {last}, from the top"
                )?;
                if *id >= 0 && *id == first - 1 {
                    write!(f, "; if the table counts from {id}, use --first-id {id}")?;
                } else if *id > last {
                    f.write_str(
                        "; does the table have more layers, or several numbers for one wall?",
                    )?;
                }
                Ok(())
            }
            Self::OneSphere { id } => {
                write!(
                    f,
                    "sphere {id} is paired with itself: name two different spheres"
                )
            }
            Self::SphereTwice { id } => write!(
                f,
                "sphere {id} is in an earlier row too: list each sphere once, with a column step if there are several steps"
            ),
            Self::Twice { ids: [a, b], first } => write!(
                f,
                "spheres {a} and {b} are already in entry {first}: {ONCE}"
            ),
            Self::Bug { error } => error.fmt(f),
            Self::TooMany { limit } => write!(
                f,
                "more than {limit} entries: leave out pairs that do not touch"
            ),
        }
    }
}

/// The remedy for a repeated pair.
const ONCE: &str = "list each pair once, or once in each order";

/// The remedy for a table with several steps.
const STEPS: &str = "; if the table holds several steps, name their column with step=COLUMN in --columns, or leave one step";

impl std::error::Error for Refusal {
    /// Returns the cause of the inner error. The text of the inner error is part of this message.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Scene(error) => error.source(),
            Self::Table(error) => error.source(),
            _ => None,
        }
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Self::Scene(error)
    }
}

impl From<cannonpile::Error> for Refusal {
    fn from(error: cannonpile::Error) -> Self {
        Self::Scene(error.into())
    }
}

impl From<contact_tables::Error> for Refusal {
    fn from(error: contact_tables::Error) -> Self {
        Self::Table(error)
    }
}

impl From<io::Error> for Refusal {
    fn from(error: io::Error) -> Self {
        Self::Table(error.into())
    }
}

impl Refusal {
    /// Returns this refusal for a table that numbers its spheres from `first_id`, if it is one for numbers from 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Fault, Refusal};
    ///
    /// let refusal = Refusal::Line { line: 7, fault: Fault::OneSphere { id: 4 } };
    /// let said = "line 7: sphere 3 is paired with itself: name two different spheres";
    /// assert_eq!(refusal.renumbered(0).to_string(), said);
    /// ```
    #[must_use]
    pub fn renumbered(self, first_id: u64) -> Self {
        match self {
            Self::Line { line, fault } => fault.renumbered(first_id).at(line),
            Self::Entry { entry, fault } => Self::Entry {
                entry,
                fault: fault.renumbered(first_id),
            },
            Self::FloorTable(refusal) => Self::FloorTable(Box::new(refusal.renumbered(first_id))),
            other => other,
        }
    }

    /// Converts an error in the exact forces.
    pub(super) fn of_forces(error: impl Into<Error>) -> Self {
        match error.into() {
            Error::Core(cannonpile::Error::Overflow { .. }) => Self::OutOfRange,
            error => error.into(),
        }
    }
}

impl Fault {
    /// Returns the fault for a violated invariant.
    pub(super) fn of_bug(invariant: &'static str) -> Self {
        Self::of_error(bug(invariant))
    }

    /// Returns the fault for an internal error.
    pub(super) fn of_error(error: Error) -> Self {
        let error = Box::new(error);
        Self::Bug { error }
    }

    /// Returns this fault for a table that numbers its spheres from `first_id`, if it is one for numbers from 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Fault;
    ///
    /// let fault = Fault::NoSuchSphere { id: 0, first: 1, spheres: 10 };
    /// let said = "no sphere -1: the spheres of this scene are numbered 0 to 9, from the top";
    /// assert_eq!(fault.renumbered(0).to_string(), said);
    /// ```
    #[must_use]
    pub fn renumbered(self, first_id: u64) -> Self {
        let shifted = |id: u64| id.saturating_sub(1).saturating_add(first_id);
        match self {
            Self::NoSuchSphere { id, first, spheres } => Self::NoSuchSphere {
                id: id.saturating_add(i128::from(first_id) - 1),
                first: shifted(first),
                spheres,
            },
            Self::OneSphere { id } => Self::OneSphere { id: shifted(id) },
            Self::SphereTwice { id } => Self::SphereTwice { id: shifted(id) },
            Self::Twice { ids, first } => Self::Twice {
                ids: ids.each(shifted),
                first,
            },
            other => other,
        }
    }

    /// Returns this fault with its line.
    pub(super) fn at(self, line: u64) -> Refusal {
        Refusal::Line { line, fault: self }
    }
}
