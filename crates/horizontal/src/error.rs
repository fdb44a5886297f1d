//! Errors of this crate.

use core::fmt;

/// An error of a computation on a pile with horizontal contacts.
///
/// The message is one line. It states the value given and the remedy.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::{Region, Site};
/// use cannonpile_horizontal::{Error, bounds};
///
/// // A run of four steps from the top, followed by a sign change, is unstable whatever the horizontal forces.
/// let pile = Pile::under(Region::SITE, "++++-".parse()?)?;
/// assert_eq!(bounds(&pile, Site { i: 0, j: 0, k: 5 }), Err(Error::CannotStand));
///
/// // Errors of the crate `cannonpile` are passed through.
/// let error = bounds(&pile, Site { i: 9, j: 0, k: 5 }).unwrap_err();
/// assert!(matches!(error, Error::Core(cannonpile::Error::SiteOutside { .. })));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// An error of the crate `cannonpile`, about the pile, a site or the amount of work.
    Core(cannonpile::Error),
    /// An error of the crate `cannonpile_stability`, about the tilts that a pile bears.
    Stability(cannonpile_stability::Error),
    /// Bounds were requested for a pile of weightless spheres.
    Weightless,
    /// The pile is unstable: no compressive forces balance it, even with horizontal contacts.
    CannotStand,
}

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

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core(error) => error.fmt(f),
            Self::Stability(error) => error.fmt(f),
            Self::Weightless => f.write_str(
                "bounds need the weight of the spheres, but this pile is weightless; give the spheres their weight",
            ),
            Self::CannotStand => f.write_str(
                "this pile is unstable: no compressive forces balance it, even with horizontal contacts; change the \
                 stacking, or the loads",
            ),
        }
    }
}

impl core::error::Error for Error {}
