//! Errors of this crate.

use core::fmt;

use cannonpile::engine::shortened;
use num_bigint::BigUint;

/// The error of a figure or of the viewer.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_figure::{Error, Subject};
///
/// let pile = Pile::triangular(1000)?;
/// let refused = cannonpile_figure::pile(&Subject::of_pile(&pile, &"6/5".parse()?)?);
/// assert!(matches!(refused, Err(Error::TooManyGlyphs { limit: 20_000, .. })));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A figure would have more glyphs than a reader can tell apart.
    TooManyGlyphs {
        /// The number of glyphs.
        glyphs: BigUint,
        /// The objects that the glyphs show, such as `spheres`.
        kind: &'static str,
        /// The largest allowed number.
        limit: u32,
        /// A change that gives fewer glyphs.
        remedy: &'static str,
    },
    /// An error of the crate `cannonpile`.
    Core(cannonpile::Error),
    /// An error of the crate `cannonpile_stability`, about tilts or a rough floor.
    Stability(cannonpile_stability::Error),
    /// An error of the crate `cannonpile_horizontal`, about bounds or elastic states.
    Horizontal(cannonpile_horizontal::Error),
    /// An error of the crate `cannonpile_disorder`, about random stackings.
    Disorder(cannonpile_disorder::Error),
    /// An error of the crate `cannonpile_dem`, about the numbered pile in the viewer.
    Dem(cannonpile_dem::Error),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyGlyphs {
                glyphs,
                kind,
                limit,
                remedy,
            } => f.write_str(&shortened(&format!(
                "{glyphs} {kind} are too many for a figure, at most {limit}: {remedy}"
            ))),
            Self::Core(error) => error.fmt(f),
            Self::Stability(error) => error.fmt(f),
            Self::Horizontal(error) => error.fmt(f),
            Self::Disorder(error) => error.fmt(f),
            Self::Dem(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Error {}

impl From<cannonpile::Error> for Error {
    fn from(error: cannonpile::Error) -> Self {
        Self::Core(error)
    }
}

impl From<cannonpile_stability::Error> for Error {
    fn from(error: cannonpile_stability::Error) -> Self {
        match error {
            cannonpile_stability::Error::Core(error) => Self::Core(error),
            error => Self::Stability(error),
        }
    }
}

impl From<cannonpile_horizontal::Error> for Error {
    fn from(error: cannonpile_horizontal::Error) -> Self {
        match error {
            cannonpile_horizontal::Error::Core(error) => Self::Core(error),
            cannonpile_horizontal::Error::Stability(error) => Self::Stability(error),
            error => Self::Horizontal(error),
        }
    }
}

impl From<cannonpile_disorder::Error> for Error {
    fn from(error: cannonpile_disorder::Error) -> Self {
        match error {
            cannonpile_disorder::Error::Core(error) => Self::Core(error),
            error => Self::Disorder(error),
        }
    }
}

impl From<cannonpile_dem::Error> for Error {
    fn from(error: cannonpile_dem::Error) -> Self {
        match error {
            cannonpile_dem::Error::Core(error) => Self::Core(error),
            cannonpile_dem::Error::Stability(error) => Self::Stability(error),
            cannonpile_dem::Error::Horizontal(error) => error.into(),
            error => Self::Dem(error),
        }
    }
}
