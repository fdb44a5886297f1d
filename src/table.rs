//! Tables of a pile's forces and spheres, as csv, json and aligned text.
//!
//! A [`Table`] is columns, and rows made as they are asked for: what is written never needs more memory
//! than one page of rows. Its cells are exact; a [`NumberFormat`] says how they are shown, and is checked
//! against the extremes of the table before the first byte is written.
//!
//! # Examples
//! ```
//! use cannonpile::Pile;
//! use cannonpile::table::{self, FileFormat, NumberFormat, Units};
//! use cannonpile::shape::Selection;
//!
//! let pile = Pile::triangular(2)?;
//! let table = table::base(&Units::of_pile(&pile), Selection::Base)?;
//! let mut csv = Vec::new();
//! table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
//! assert_eq!(
//!     String::from_utf8(csv)?,
//!     "i,j,normal,shear_x,shear_y\n0,0,4/3,-1/6,-1/6\n1,0,4/3,-1/6,1/6\n0,1,4/3,1/3,0\n",
//! );
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cell;
mod explain;
mod file;
mod json;
mod rows;
mod summary;
mod tables;
mod text;
mod unfinished;

pub use cell::{Cell, NumberFormat};
pub use explain::Explanation;
pub(crate) use file::Aside;
pub use file::write_aside;
pub use rows::{Column, Table};
pub use summary::Summary;
pub(crate) use tables::refuse_beyond;
pub use tables::{MAX_ROWS, Units, base, census, contacts, spheres, theorems};
pub(crate) use unfinished::Begun;
pub use unfinished::remove_unfinished;

use std::io;
use std::path::PathBuf;

use crate::Error;

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileFormat {
    /// Aligned text with units and totals, for people.
    Text,
    /// Comma-separated values with one line of headers.
    Csv,
    /// An array of objects, one a row.
    Json,
}

/// Why a table was not written, or not to its end.
#[derive(Debug)]
#[non_exhaustive]
pub enum WriteError {
    /// An answer was refused: see [`Error`].
    Answer(Error),
    /// The output was.
    Io(io::Error),
    /// One of several files was.
    File {
        /// Where it was to be written.
        path: PathBuf,
        /// Why it was not.
        error: io::Error,
    },
}

impl core::fmt::Display for WriteError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Answer(error) => error.fmt(f),
            Self::Io(error) => error.fmt(f),
            Self::File { path, error } => write!(f, "{}: {error}", path.display()),
        }
    }
}

impl std::error::Error for WriteError {}

impl From<Error> for WriteError {
    fn from(error: Error) -> Self {
        Self::Answer(error)
    }
}

impl From<io::Error> for WriteError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<csv::Error> for WriteError {
    fn from(error: csv::Error) -> Self {
        Self::Io(match error.into_kind() {
            csv::ErrorKind::Io(error) => error,
            kind => io::Error::other(format!("{kind:?}")),
        })
    }
}

impl From<serde_json::Error> for WriteError {
    fn from(error: serde_json::Error) -> Self {
        Self::Io(error.into())
    }
}
