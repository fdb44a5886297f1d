//! Why this crate refuses a request.

use core::fmt;

/// Why there is no answer about a pile with horizontal contacts.
///
/// The message is one line. It names the value and what would be accepted.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::{Region, Site};
/// use cannonpile_horizontal::{Error, bounds};
///
/// // A run of four steps from the top before a sign change: unstable, whatever the horizontal contacts carry.
/// let pile = Pile::under(Region::SITE, "++++-".parse()?)?;
/// assert_eq!(bounds(&pile, Site { i: 0, j: 0, k: 5 }), Err(Error::CannotStand));
///
/// // The core's errors pass through.
/// let error = bounds(&pile, Site { i: 9, j: 0, k: 5 }).unwrap_err();
/// assert!(matches!(error, Error::Core(cannonpile::Error::SiteOutside { .. })));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// The core refuses the pile, a site or the amount of work.
    Core(cannonpile::Error),
    /// Bounds of a pile whose spheres weigh nothing.
    Weightless,
    /// A pile that no forces balance which only push, horizontal contacts included.
    CannotStand,
    /// A program over contact forces whose solution in floats leads to no exact one.
    #[non_exhaustive]
    NotSolved {
        /// The equations of balance that it has.
        equations: usize,
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
            Self::Weightless => f.write_str(
                "bounds are those of a pile that weighs something: give the spheres their weight",
            ),
            Self::CannotStand => f.write_str(
                "this pile cannot stand: no forces that only push balance it, horizontal contacts included; change the \
                 stacking, or the loads",
            ),
            Self::NotSolved { equations } => write!(
                f,
                "no exact solution was found of {equations} equations of balance: ask for a smaller pile"
            ),
        }
    }
}

impl core::error::Error for Error {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            // The message is the inner error's own, so a chain goes on with what is behind that.
            Self::Core(error) => error.source(),
            _ => None,
        }
    }
}
