//! The reasons why measured forces are rejected: one line, with the place, the value and the remedy.

use core::fmt;
use std::io;

use super::kind::FileKind;
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
    /// A fault in a line of a file.
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
    /// The positions do not match the pile in any frame.
    Elsewhere {
        /// The number of positions of a sample that match in the best frame.
        found: usize,
        /// The size of the sample.
        sample: usize,
    },
    /// A distance, in radii, that is not between 0 and 1/2.
    Within(f64),
    /// A file of a kind that is not read.
    Kind(FileKind),
    /// No row was read, or none was of the kind that is asked for.
    NoRows {
        /// The reason, with a remedy.
        reason: String,
    },
    /// The step that the user asked for is not in the file.
    NoStep {
        /// The step.
        wanted: String,
        /// The steps that were found.
        found: String,
    },
    /// The table with the forces of the floor was refused.
    FloorTable(Box<Refusal>),
    /// Both tables list contacts with the floor.
    FloorTwice,
    /// There is a table of the floor, but contacts are matched by position.
    FloorByPlace,
    /// A VTK file whose contacts cannot be read, or XML of another kind.
    Vtk(String),
    /// The file could not be read.
    Io(io::Error),
}

/// A fault in an entry, or in the file around it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// The table is empty.
    Empty,
    /// A necessary column is missing.
    NoColumn {
        /// The name of the column.
        column: &'static str,
        /// The columns that were found.
        found: String,
    },
    /// A column that the user named is missing.
    NoNamedColumn {
        /// The quantity of the column.
        column: &'static str,
        /// The name that the user gave.
        name: String,
        /// The columns that were found.
        found: String,
    },
    /// The table has no header, and the columns were not given by number.
    NoHeader {
        /// The number of columns.
        columns: usize,
    },
    /// A numbered column is missing.
    NoNumberedColumn {
        /// The quantity of the column.
        column: &'static str,
        /// The number that the user gave.
        number: usize,
        /// The number of columns.
        columns: usize,
        /// Whether the table has a header.
        has_names: bool,
    },
    /// Two columns match one quantity.
    TwoColumns {
        /// The quantity.
        column: &'static str,
        /// The first column.
        first: String,
        /// The second column.
        second: String,
    },
    /// A line has another number of cells than the header, or than the rows of a table without header.
    Fields {
        /// The number of columns.
        columns: usize,
        /// The number of cells in the line.
        fields: usize,
        /// Whether the table has a header.
        has_names: bool,
    },
    /// A step occurs again after another step.
    StepAgain {
        /// The step.
        step: String,
    },
    /// A field does not match the quantity of its column.
    Field {
        /// The quantity.
        column: &'static str,
        /// The field, shortened if it is long, with the expected form.
        error: Box<Error>,
    },
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
        /// The line or the entry of the first occurrence, if it is known.
        first: Option<u64>,
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
    /// A quoted cell does not end on its line, and there are numbers behind its quote.
    Quote,
    /// All commas of numbers may be decimal signs or separate thousands.
    Thousands {
        /// The first such number, in quotes.
        number: String,
    },
    /// In rows without a header, numbers may be cut in two at their decimal commas.
    CutNumber {
        /// The first such number, in quotes.
        number: String,
    },
    /// A line is too long for a row of a table.
    LongLine {
        /// The largest accepted length, in bytes.
        limit: usize,
    },
    /// A line of a dump differs from the expected one.
    Dump {
        /// The line, with the expected form.
        error: Box<Error>,
    },
    /// A snapshot ends before its last announced entry.
    Truncated {
        /// The announced number of entries.
        announced: u64,
        /// The number of entries found.
        found: u64,
    },
    /// A dump ends within a line or within its header.
    Cut,
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
            Self::Line {
                line,
                fault: Fault::Twice {
                    ids: [a, b],
                    first: Some(first),
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
                 table of this scene, in m?"
            ),
            Self::Within(share) => write!(
                f,
                "{share} radii are not between 0 and 0.5: 0.1 is usual"
            ),
            Self::Kind(FileKind::Other { is, remedy }) => write!(f, "this is {is}: {remedy}"),
            Self::Kind(kind) => write!(f, "this is {kind}"),
            Self::NoStep { wanted, found } => write!(
                f,
                "no step {wanted}: {}",
                if found.is_empty() {
                    "the file has no steps, so leave out --step, or name their column by step=COLUMN".to_owned()
                } else {
                    format!("the steps are {found}")
                }
            ),
            Self::NoRows { reason } | Self::Vtk(reason) => f.write_str(reason),
            Self::FloorTable(refusal) => write!(f, "table of the floor: {refusal}"),
            Self::FloorByPlace => f.write_str(
                "its rows have the numbers of spheres: match contacts by numbers, or leave out this table",
            ),
            Self::FloorTwice => f.write_str(
                "both tables list contacts with the floor: leave out this one, or remove the contacts from the other",
            ),
            Self::Io(error) => error.fmt(f),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoColumn { .. }
            | Self::NoNamedColumn { .. }
            | Self::NoHeader { .. }
            | Self::NoNumberedColumn { .. }
            | Self::TwoColumns { .. }
            | Self::Fields { .. } => self.fmt_columns(f),
            Self::Empty => f.write_str(
                "the table is empty: begin with a header such as id1,id2,force, or with ITEM: TIMESTEP",
            ),
            Self::NoSphereAt {
                point: [x, y, z],
                within,
                nearest,
            } => write!(
                f,
                "no contact at ({x:.6}, {y:.6}, {z:.6}) m: the nearest sphere is {nearest:.4} R off, but only {within} R is allowed"
            ),
            Self::StepAgain { step } => write!(
                f,
                "step {step} again, after another step: --step reads one of them"
            ),
            Self::Field { column, error } => write!(f, "{column} {error}"),
            Self::NotFinite { column, value } => {
                write!(f, "{column} is {value}: forces and positions must be finite")
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
                    f.write_str("; does the table have more layers, or several numbers for one wall?")?;
                }
                Ok(())
            }
            Self::OneSphere { id } => {
                write!(f, "sphere {id} is paired with itself: name two different spheres")
            }
            Self::SphereTwice { id } => write!(
                f,
                "sphere {id} is in an earlier row too: list each sphere once, with a column step if there are several steps"
            ),
            Self::Twice {
                ids: [a, b],
                first: Some(first),
            } => write!(
                f,
                "spheres {a} and {b} are already in entry {first}: {ONCE}"
            ),
            Self::Twice {
                ids: [a, b],
                first: None,
            } => write!(f, "spheres {a} and {b} are already listed: {ONCE}{STEPS}"),
            Self::Quote => f.write_str(
                "a quote does not end on its line: close it, use --quote none, or begin the line with # if it is not a row",
            ),
            Self::Thousands { number } => write!(
                f,
                "the comma of {number} is a decimal sign or separates thousands: use --decimal comma, or leave out such commas"
            ),
            Self::CutNumber { number } => write!(
                f,
                "{number} is two cells or one number with a decimal comma: use --decimal point, or separate cells by semicolons"
            ),
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

impl Fault {
    /// Writes a fault in the columns of a table.
    fn fmt_columns(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoColumn { column, found } if *column == "id" => write!(
                f,
                "no column id, only {found}: name the columns id, fx, fy and fz (in LAMMPS with dump_modify colname)"
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
            Self::TwoColumns {
                column,
                first,
                second,
            } => write!(
                f,
                "two columns, {first} and {second}, for {column}: choose one with --columns {column}=#N"
            ),
            Self::NoHeader { columns } => write!(
                f,
                "there is no header above the {columns} columns: name them by number, such as id1=#1,id2=#2,force=#3"
            ),
            Self::NoNumberedColumn {
                column,
                number,
                columns,
                has_names,
            } => {
                let header = if *has_names {
                    ""
                } else {
                    ", and there is no header"
                };
                write!(
                    f,
                    "no column #{number} for {column}: the rows have {columns} columns{header}; does the table have another form?"
                )
            }
            Self::Fields {
                columns,
                fields,
                has_names: false,
            } => write!(
                f,
                "{fields} cells, but most rows have {columns}: give every column a value"
            ),
            Self::Fields {
                columns, fields, ..
            } if *fields == columns + 1 => write!(
                f,
                "{fields} cells, but the header has {columns}: does the header lack the name of the first column, as for \
                 the row names of R, or does a cell contain the separator?"
            ),
            Self::Fields {
                columns, fields, ..
            } => write!(
                f,
                "{fields} cells, but the header has {columns}: give every column a value"
            ),
            _ => Ok(()),
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
