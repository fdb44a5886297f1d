//! Why a table or a file was not written.

use std::io;
use std::path::PathBuf;

use crate::Error;

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
