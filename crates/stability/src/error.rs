//! Errors of this crate.

use core::fmt;

/// The reason why a question about a pile has no answer.
///
/// The message is one line. It states the value given and the remedy.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_stability::{Error, margin};
///
/// let pile = Pile::triangular(10)?.weightless();
/// assert_eq!(margin(&pile), Err(Error::NoWeight));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// An error of the crate `cannonpile`, about the pile, a site or the amount of work.
    Core(cannonpile::Error),
    /// A pile without weight above the floor, on which a tilt of gravity has no effect.
    NoWeight,
    /// A pile whose forces on a rough floor are not unique, or not covered.
    #[non_exhaustive]
    RoughFloor {
        /// The property that the pile must have.
        needed: &'static str,
        /// The property that it has instead.
        given: Box<str>,
    },
}

impl From<cannonpile::Error> for Error {
    fn from(error: cannonpile::Error) -> Self {
        Self::Core(error)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core(error) => error.fmt(f),
            Self::NoWeight => f.write_str(
                "no sphere above the floor has a weight, so a tilt of gravity has no effect: give the pile weight",
            ),
            Self::RoughFloor { needed, given } => f.write_str(&cannonpile::engine::shortened(&format!(
                "a rough floor needs {needed}, but this pile has {given}: change that, or use a floor with glue"
            ))),
        }
    }
}

impl core::error::Error for Error {}
