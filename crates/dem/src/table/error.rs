//! The errors of writing tables and files.

use std::io;
use std::path::PathBuf;

use crate::Error;

/// The reason why a table or a file was not written, or not completely.
#[derive(Debug)]
#[non_exhaustive]
pub enum WriteError {
    /// A value could not be computed or formatted: see [`Error`].
    Answer(Error),
    /// Writing to the output failed.
    Io(io::Error),
    /// Writing one of several files failed.
    File {
        /// The path of the file.
        path: PathBuf,
        /// The error of the file system.
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

impl std::error::Error for WriteError {
    /// Returns the cause of the inner error, whose own text is part of this message.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Answer(error) => error.source(),
            Self::Io(error) | Self::File { error, .. } => error.source(),
        }
    }
}

impl From<Error> for WriteError {
    fn from(error: Error) -> Self {
        Self::Answer(error)
    }
}

impl From<cannonpile::Error> for WriteError {
    fn from(error: cannonpile::Error) -> Self {
        Self::Answer(error.into())
    }
}

impl From<cannonpile_horizontal::Error> for WriteError {
    fn from(error: cannonpile_horizontal::Error) -> Self {
        Self::Answer(error.into())
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
