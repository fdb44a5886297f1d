//! The reasons why a file is refused: one line, with the place, the value and the remedy.

use core::fmt::{self, Write};
use std::io;

use crate::kind::FileKind;

/// The reason why a file was not read.
///
/// # Examples
/// ```
/// use contact_tables::{Error, Format};
///
/// let table = "id1,id2,force\n1,2,0.5\n1,3,half\n";
/// let rows = contact_tables::read(table.as_bytes(), &Format::default())?;
/// let refused = rows.collect::<Result<Vec<_>, _>>().unwrap_err();
/// assert_eq!(refused.to_string(), "line 3: force 'half' is not a number such as 0.46 or 1e-3");
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// A line that cannot be read, or the file around it.
    Line {
        /// The line, counted from 1.
        line: u64,
        /// The reason, with the value and a remedy.
        reason: String,
    },
    /// A table lacks a necessary column: [`Columns`](crate::Columns) can name it.
    NoColumn {
        /// The line of the header, counted from 1.
        line: u64,
        /// The reason, with the columns that were found.
        reason: String,
    },
    /// A file of a kind that is not read.
    Kind(FileKind),
    /// The step that the user asked for is not in the file.
    NoStep {
        /// The step.
        wanted: String,
        /// The steps that were found.
        found: String,
    },
    /// A VTK file whose contacts cannot be read, or XML of another kind.
    Vtk(String),
    /// The file could not be read.
    Io(io::Error),
}

/// A fault whose line is not known yet.
#[derive(Debug)]
pub(crate) struct Fault {
    reason: String,
    lacks_column: bool,
}

/// A text that is not of the expected form.
///
/// # Examples
/// ```
/// use contact_tables::Separator;
///
/// let error = "ab".parse::<Separator>().unwrap_err();
/// assert_eq!(error.to_string(), "'ab' is not a separator: one character, tab or blanks");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Syntax {
    /// The text, shortened if it is long.
    pub text: String,
    /// The expected form, with an example.
    pub expected: &'static str,
}

impl Syntax {
    /// Returns the error for a text, with the form that was expected. A long text is shortened.
    ///
    /// # Examples
    /// ```
    /// let error = contact_tables::Syntax::new("-2", "a number of at least 0");
    /// assert_eq!(error.to_string(), "'-2' is not a number of at least 0");
    /// ```
    #[must_use]
    pub fn new(text: &str, expected: &'static str) -> Self {
        Self {
            text: quoted(text),
            expected,
        }
    }
}

impl fmt::Display for Syntax {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "'{}' is not {}", self.text, self.expected)
    }
}

impl std::error::Error for Syntax {}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line { line, reason } | Self::NoColumn { line, reason } => {
                write!(f, "line {line}: {reason}")
            }
            Self::Kind(FileKind::Other { is, remedy }) => write!(f, "this is {is}: {remedy}"),
            Self::Kind(kind) => write!(f, "this is {kind}"),
            Self::NoStep { wanted, found } => write!(
                f,
                "no step {wanted}: {}",
                if found.is_empty() {
                    "the file has no steps, so ask for none, or name their column by step=COLUMN"
                        .to_owned()
                } else {
                    format!("the steps are {found}")
                }
            ),
            Self::Vtk(reason) => f.write_str(reason),
            Self::Io(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Error {
    /// Returns the cause of the inner error. The text of the inner error is part of this message.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io(error) => error.source(),
            _ => None,
        }
    }
}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl Fault {
    pub(crate) fn new(reason: impl Into<String>) -> Self {
        Self {
            reason: reason.into(),
            lacks_column: false,
        }
    }

    /// Returns the fault of a table without rows.
    pub(crate) fn empty() -> Self {
        Self::new(
            "the table is empty: begin with a header such as id1,id2,force, or with ITEM: TIMESTEP",
        )
    }

    /// Returns the fault of a table that lacks a necessary column.
    pub(crate) fn no_column(reason: String) -> Self {
        Self {
            reason,
            lacks_column: true,
        }
    }

    /// Returns the fault of a cell that does not match the quantity of its column.
    pub(crate) fn of_cell(column: &str, cell: &str, expected: &'static str) -> Self {
        Self::new(format!("{column} {}", Syntax::new(cell, expected)))
    }

    /// Returns the fault for a broken invariant. If debug assertions are on, it panics instead.
    #[cold]
    #[track_caller]
    pub(crate) fn bug(invariant: &str) -> Self {
        debug_assert!(false, "broken invariant: {invariant}");
        Self::new(format!(
            "this is a bug of contact-tables: it does not hold that {invariant} (please report it)"
        ))
    }

    /// Returns the error for this fault in a line.
    pub(crate) fn at(self, line: u64) -> Error {
        let reason = self.reason;
        if self.lacks_column {
            Error::NoColumn { line, reason }
        } else {
            Error::Line { line, reason }
        }
    }
}

/// Returns the text escaped on one line. In a long text the middle is replaced by the length.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 60;
    const ENDS: [usize; 2] = [30, 12];
    let escaped = |text: &str| text.chars().flat_map(char::escape_debug).collect();
    let length = text.chars().count();
    if length <= LONGEST {
        return escaped(text);
    }
    let beginning: String = text.chars().take(ENDS[0]).collect();
    let end: String = text.chars().skip(length - ENDS[1]).collect();
    escaped(&format!("{beginning}…[{length} characters]…{end}"))
}

/// Returns quoted names for a message, shortened if the list is long.
pub(crate) fn shortened(names: &[&str]) -> String {
    const LONGEST: usize = 120;
    let mut list = String::new();
    for name in names {
        let gap = if list.is_empty() { "" } else { ", " };
        // Writing to a String never fails.
        let _ = write!(list, "{gap}'{}'", name.escape_debug());
        if list.len() > LONGEST {
            let short: String = list.chars().take(LONGEST).collect();
            return short + "…";
        }
    }
    list
}
