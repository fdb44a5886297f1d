//! Why measured forces were refused: one line, with the place, the value and the remedy.

use core::fmt;
use std::io;

use crate::Error;
use crate::error::bug;

/// Why measured forces were not compared.
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
    /// A line of the file, counted from 1.
    Line {
        /// The line.
        line: u64,
        /// What is wrong with it.
        fault: Fault,
    },
    /// An entry of a list that is no file, counted from 1.
    Entry {
        /// The entry.
        entry: u64,
        /// What is wrong with it.
        fault: Fault,
    },
    /// The scene has no exact forces to compare with.
    Scene(Error),
    /// Exact forces that no normal `f64` is near to.
    OutOfRange,
    /// The places are not those of the pile, however the table is turned.
    Elsewhere {
        /// How many places of a sample are, in the best of frames.
        found: usize,
        /// How many the sample has.
        sample: usize,
    },
    /// A share of the radius that cannot be one.
    Within(f64),
    /// A picture file that cannot be read as lines with data.
    Vtk(String),
    /// The file could not be read.
    Io(io::Error),
}

/// What is wrong with an entry, or with the file around it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// There is nothing.
    Empty,
    /// A column is not there.
    NoColumn {
        /// The column.
        column: &'static str,
        /// Those that are.
        found: String,
    },
    /// A column that was named is not there.
    NoNamedColumn {
        /// What it would hold.
        column: &'static str,
        /// Its name.
        name: String,
        /// Those that are.
        found: String,
    },
    /// Two columns could be meant.
    TwoColumns {
        /// What they could be.
        column: &'static str,
        /// The one.
        first: String,
        /// The other.
        second: String,
    },
    /// A line with another number of fields than the header has columns.
    Fields {
        /// The columns of the header.
        columns: usize,
        /// The fields of the line.
        fields: usize,
    },
    /// A field that is not what its column holds.
    Field {
        /// The column.
        column: &'static str,
        /// The field, as far as it is shown, with what was expected.
        error: Box<Error>,
    },
    /// A force beyond the floats, or none.
    NotFinite {
        /// The column.
        column: &'static str,
        /// The value.
        value: f64,
    },
    /// The number of a sphere that the pile has not got.
    NoSuchSphere {
        /// The number.
        id: u64,
        /// How many spheres the pile has.
        spheres: u64,
    },
    /// A sphere and itself.
    OneSphere {
        /// Its number.
        id: u64,
    },
    /// A pair that was there before, this way round or the other.
    Twice {
        /// The pair.
        ids: [u64; 2],
        /// Where it was first, if that is known: a line, or an entry.
        first: Option<u64>,
    },
    /// A place where no sphere is.
    NoSphereAt {
        /// The place, in the axes of the scene, in m.
        point: [f64; 3],
        /// How far off it may be, in radii.
        within: f64,
        /// How far off the nearest one is, in radii.
        nearest: f64,
    },
    /// A quote that does not end on its line, or has something after its end.
    Quote,
    /// A line that is no text.
    Encoding,
    /// A line too long to be one.
    LongLine {
        /// The most bytes.
        limit: usize,
    },
    /// A line of a dump that is not the one expected here.
    Dump {
        /// What was expected, with what was found.
        error: Box<Error>,
    },
    /// A snapshot that ends before all its entries are there.
    Truncated {
        /// How many were announced.
        announced: u64,
        /// How many there are.
        found: u64,
    },
    /// A dump that ends within a line, or within its header.
    Cut,
    /// More entries than are read.
    TooMany {
        /// The most that are.
        limit: u64,
    },
    /// Something that cannot be: a fault of this library and of no table.
    Bug {
        /// [`Error::Bug`](cannonpile::Error::Bug).
        error: Box<Error>,
    },
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line {
                line,
                fault: Fault::Twice {
                    ids: [a, b],
                    first: Some(first),
                },
            } => write!(
                f,
                "line {line}: spheres {a} and {b} again, after line {first}: list each pair once"
            ),
            Self::Line { line, fault } => write!(f, "line {line}: {fault}"),
            Self::Entry { entry, fault } => write!(f, "entry {entry}: {fault}"),
            Self::Scene(error) => error.fmt(f),
            Self::OutOfRange => f.write_str(
                "a contact force of this scene does not fit in f64: measure mass or gravity in another unit",
            ),
            Self::Elsewhere { found, sample } => write!(
                f,
                "no frame in which its places are those of the scene: {found} of {sample} are found in the best one; is it of \
                 this scene, in m?"
            ),
            Self::Within(share) => write!(
                f,
                "{share} radii are no distance below half of one: 0.1 is usual"
            ),
            Self::Vtk(reason) => f.write_str(reason),
            Self::Io(error) => error.fmt(f),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str(
                "nothing is there: begin with a header such as id1,id2,force, or with ITEM: TIMESTEP",
            ),
            Self::NoColumn { column, found } => write!(
                f,
                "no column {column}, only {found}: name the columns id1, id2, force, and fx, fy, fz if there are vectors \
                 (in LAMMPS with dump_modify colname)"
            ),
            Self::NoNamedColumn {
                column,
                name,
                found,
            } => write!(
                f,
                "no column {name} for {column}, only {found}: name one of these"
            ),
            Self::NoSphereAt {
                point: [x, y, z],
                within,
                nearest,
            } => write!(
                f,
                "no contact at ({x:.6}, {y:.6}, {z:.6}) m: the nearest sphere is {nearest:.4} R off, {within} R are allowed"
            ),
            Self::TwoColumns {
                column,
                first,
                second,
            } => write!(
                f,
                "two columns, {first} and {second}, for {column}: leave one out"
            ),
            Self::Fields { columns, fields } => write!(
                f,
                "{fields} fields where the header has {columns}: give every column a value"
            ),
            Self::Field { column, error } => write!(f, "{column} {error}"),
            Self::NotFinite { column, value } => {
                write!(f, "{column} is {value}: forces and places must be finite")
            }
            Self::NoSuchSphere { id, spheres } => write!(
                f,
                "no sphere {id}: the spheres of this scene are numbered 1 to {spheres}, from the top"
            ),
            Self::OneSphere { id } => {
                write!(f, "sphere {id} with itself: a contact is of two spheres")
            }
            Self::Twice {
                ids: [a, b],
                first: Some(first),
            } => write!(
                f,
                "spheres {a} and {b} again, after entry {first}: list each pair once"
            ),
            Self::Twice {
                ids: [a, b],
                first: None,
            } => write!(f, "spheres {a} and {b} again: list each pair once"),
            Self::Quote => f.write_str("a quoted field must end on its line, before a comma"),
            Self::Encoding => f.write_str("not a text: write it in UTF-8"),
            Self::LongLine { limit } => write!(
                f,
                "longer than {limit} bytes: is this a table with one contact per line?"
            ),
            Self::Dump { error } | Self::Bug { error } => error.fmt(f),
            Self::Truncated { announced, found } => write!(
                f,
                "the snapshot ends after {found} of {announced} entries: it is not complete"
            ),
            Self::Cut => f.write_str("the dump ends here, within a line or a header: it is not complete"),
            Self::TooMany { limit } => write!(
                f,
                "more than {limit} entries: leave out pairs that do not touch"
            ),
        }
    }
}

impl std::error::Error for Refusal {
    /// Returns the cause of the inner error, whose own text is part of this message.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Scene(error) => error.source(),
            Self::Io(error) => error.source(),
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

impl From<io::Error> for Refusal {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl Refusal {
    /// Why there are no exact forces to compare with.
    pub(super) fn of_forces(error: impl Into<Error>) -> Self {
        match error.into() {
            Error::Core(cannonpile::Error::Overflow { .. }) => Self::OutOfRange,
            error => error.into(),
        }
    }
}

impl Fault {
    /// A case that an invariant rules out.
    pub(super) fn of_bug(invariant: &'static str) -> Self {
        Self::Bug {
            error: Box::new(bug(invariant)),
        }
    }

    /// At a line.
    pub(super) fn at(self, line: u64) -> Refusal {
        Refusal::Line { line, fault: self }
    }
}
