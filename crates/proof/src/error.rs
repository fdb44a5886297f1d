//! Errors of this crate.

use core::fmt;

/// The reason why a file or a value cannot be returned.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// An error of the crate `cannonpile`.
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
            // This variant prints the message of the inner error. So its source is the source of the inner error, or
            // the chain would contain the same message twice.
            Self::Core(error) => error.source(),
        }
    }
}

impl From<cannonpile::Error> for Error {
    fn from(error: cannonpile::Error) -> Self {
        Self::Core(error)
    }
}
