//! The errors of this crate.

use core::error::Error as Cause;
use core::fmt;

use cannonpile::lattice::Site;

use crate::Key;

/// The reason why a scene, a file or a table was rejected.
///
/// The message is one line. It contains the given value and the accepted ones.
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::Scene;
///
/// let error = Scene::from_toml("layers = 0").unwrap_err();
/// assert_eq!(error.to_string(), "line 1, layers: layers must be at least 1 and at most 10^36, not 0");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// The crate `cannonpile` rejected a pile, a site, a geometry or a number.
    Core(cannonpile::Error),
    /// The pile has no weight, or its forces on a rough floor are unknown.
    Stability(cannonpile_stability::Error),
    /// The forces of horizontal contacts are unknown.
    ///
    /// An error of `cannonpile` that `cannonpile_horizontal` returned is [`Core`](Self::Core).
    Horizontal(cannonpile_horizontal::Error),
    /// sin φ was given for a pile of discs.
    SinPhiOfDiscs,
    /// Two options of a scene exclude each other.
    Excluded {
        /// The option to change.
        given: Key,
        /// The other option.
        beside: Key,
    },
    /// A scene file is not TOML.
    NotToml {
        /// The line, counted from 1.
        line: usize,
        /// The message of the TOML parser.
        reason: String,
    },
    /// A scene file has an unknown key.
    UnknownKey {
        /// The line of the key, counted from 1.
        line: usize,
        /// The key, shortened if it is long.
        key: String,
        /// The most similar known key, if any.
        nearest: Option<&'static str>,
        /// All known keys.
        known: &'static [&'static str],
    },
    /// No benchmark case has this name.
    UnknownCase {
        /// The name, shortened if it is long.
        name: String,
        /// The most similar name of a case, if any.
        nearest: Option<&'static str>,
    },
    /// A value in a scene file was rejected.
    InFile {
        /// The line of the key, counted from 1.
        line: usize,
        /// The key.
        key: &'static str,
        /// The reason why the value was rejected.
        error: Box<Self>,
    },
    /// A pile has no equations of equilibrium with the forces of sloping contacts as unknowns.
    NoEquations {
        /// The option to change: the number of layers, or the state.
        given: Key,
    },
    /// A file that only exists for a floor with glue.
    GluedOnly {
        /// The file.
        file: &'static str,
    },
}

/// An error that displays its numbers in full.
struct Whole<'a>(&'a Error);

impl fmt::Display for Whole<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Error::Core(error) => error.fmt(f),
            Error::Stability(error) => error.fmt(f),
            Error::Horizontal(error) => error.fmt(f),
            Error::SinPhiOfDiscs => {
                f.write_str("a pile of discs has no sin phi: leave it out, or use dimension 3")
            }
            Error::Excluded {
                given: Key::State,
                beside: Key::Floor,
            } => f.write_str(
                "the elastic state needs a floor with glue, not a rough one: leave out state or floor",
            ),
            Error::Excluded {
                given,
                beside: Key::Floor,
            } => write!(
                f,
                "only a rough floor has friction: use floor rough, or leave {given} out"
            ),
            Error::Excluded { given, beside } => {
                // Only the dimension 2 excludes other options.
                let two = if *beside == Key::Dimension { " 2" } else { "" };
                write!(
                    f,
                    "{given} has no meaning with {beside}{two}: leave one of the two out"
                )
            }
            Error::NotToml { line, reason } => write!(f, "line {line} is not TOML: {reason}"),
            Error::UnknownKey {
                line,
                key,
                nearest,
                known,
            } => {
                write!(f, "line {line}: there is no key '{key}'")?;
                match nearest {
                    Some(nearest) => write!(f, "; did you mean '{nearest}'?"),
                    None => write!(f, ": the keys are {}", known.join(", ")),
                }
            }
            Error::UnknownCase { name, nearest } => {
                write!(f, "there is no case '{name}'")?;
                match nearest {
                    Some(nearest) => write!(f, "; did you mean '{nearest}'?"),
                    None => f.write_str("; 'cannonpile cases' lists those there are"),
                }
            }
            Error::InFile { line, key, error } => write!(f, "line {line}, {key}: {error}"),
            Error::NoEquations { given: Key::Layers } => {
                f.write_str("one layer has no contacts between spheres: use two layers or more")
            }
            Error::NoEquations { .. } => f.write_str(
                "this state has horizontal contact forces, which the equations leave out: use isostatic",
            ),
            Error::GluedOnly { file } => write!(
                f,
                "{file} is only written for a floor with glue: use the formats lammps, yade and card, or a floor with glue"
            ),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&cannonpile::engine::shortened(&Whole(self).to_string()))
    }
}

impl Cause for Error {}

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

impl From<contact_tables::Syntax> for Error {
    fn from(contact_tables::Syntax { text, expected }: contact_tables::Syntax) -> Self {
        Self::Core(cannonpile::Error::Syntax { text, expected })
    }
}

/// Returns the error for a violated invariant.
#[cold]
#[track_caller]
pub(crate) fn bug(invariant: &'static str) -> Error {
    cannonpile::engine::bug(invariant).into()
}

/// Returns the text on one line. The middle of a long text is replaced by its length.
pub(crate) fn quoted(text: &str) -> String {
    cannonpile::engine::quoted(text)
}

/// Errors of the crate `cannonpile` that this crate itself returns.
impl Error {
    pub(crate) fn syntax(text: &str, expected: &'static str) -> Self {
        cannonpile::Error::syntax(text, expected).into()
    }

    pub(crate) fn overflow(quantity: &'static str, scalar: &'static str) -> Self {
        cannonpile::Error::overflow(quantity, scalar).into()
    }

    pub(crate) fn on_floor(site: Site) -> Self {
        cannonpile::Error::OnFloor { site }.into()
    }
}
