//! Errors of this crate.

use core::fmt;

/// Why a file or a value is not returned.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// An error of the core.
    Core(cannonpile::Error),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Error {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            // The message is the inner one, so the chain goes on below it.
            Self::Core(error) => error.source(),
        }
    }
}

impl From<cannonpile::Error> for Error {
    fn from(error: cannonpile::Error) -> Self {
        Self::Core(error)
    }
}
