//! The errors of all crates, in one type.

use core::fmt;

/// The exit status of a usage error, with one line on stderr and nothing on stdout.
pub(crate) const USAGE_ERROR: u8 = 2;

/// An error of one of the crates below the command line.
///
/// The conversions unwrap nested errors: an error of the crate `cannonpile` is always [`Core`](Self::Core), whatever
/// crate returned it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Error {
    Core(cannonpile::Error),
    Horizontal(cannonpile_horizontal::Error),
    Disorder(cannonpile_disorder::Error),
    Dem(cannonpile_dem::Error),
    Figure(cannonpile_figure::Error),
    Proof(cannonpile_proof::Error),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core(error) => error.fmt(f),
            Self::Horizontal(error) => error.fmt(f),
            Self::Disorder(error) => error.fmt(f),
            Self::Dem(error) => error.fmt(f),
            Self::Figure(error) => error.fmt(f),
            Self::Proof(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Error {}

impl From<cannonpile::Error> for Error {
    fn from(error: cannonpile::Error) -> Self {
        Self::Core(error)
    }
}

impl From<cannonpile_horizontal::Error> for Error {
    fn from(error: cannonpile_horizontal::Error) -> Self {
        match error {
            cannonpile_horizontal::Error::Core(error) => error.into(),
            error => Self::Horizontal(error),
        }
    }
}

impl From<cannonpile_disorder::Error> for Error {
    fn from(error: cannonpile_disorder::Error) -> Self {
        match error {
            cannonpile_disorder::Error::Core(error) => error.into(),
            error => Self::Disorder(error),
        }
    }
}

impl From<cannonpile_dem::Error> for Error {
    fn from(error: cannonpile_dem::Error) -> Self {
        match error {
            cannonpile_dem::Error::Core(error) => error.into(),
            cannonpile_dem::Error::Horizontal(error) => error.into(),
            error => Self::Dem(error),
        }
    }
}

impl From<cannonpile_figure::Error> for Error {
    fn from(error: cannonpile_figure::Error) -> Self {
        match error {
            cannonpile_figure::Error::Core(error) => error.into(),
            cannonpile_figure::Error::Horizontal(error) => error.into(),
            cannonpile_figure::Error::Disorder(error) => error.into(),
            cannonpile_figure::Error::Dem(error) => error.into(),
            error => Self::Figure(error),
        }
    }
}

impl From<cannonpile_proof::Error> for Error {
    fn from(error: cannonpile_proof::Error) -> Self {
        match error {
            cannonpile_proof::Error::Core(error) => error.into(),
            error => Self::Proof(error),
        }
    }
}
