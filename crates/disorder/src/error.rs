//! Errors of this crate: one enum, whose messages name the value and the remedy.

use std::error::Error as StdError;
use std::fmt;

use cannonpile::engine;
use cannonpile::lattice::{Region, Site};
use num_bigint::BigUint;
use num_rational::BigRational;

/// An error of this crate, or an error of the core that it wraps.
///
/// The message is one line. It names the value and says what would be accepted.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, RandomStackings};
///
/// let error = RandomStackings::new(0, FirstSign::Plus).unwrap_err();
/// assert_eq!(error.to_string(), "layers must be at least 1 and at most 10^36, not 0");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// An error of the crate `cannonpile`. It displays as that error.
    Core(cannonpile::Error),
    /// The ensemble has more stackings than one run enumerates.
    #[non_exhaustive]
    TooManyStackings {
        /// The number of stackings.
        stackings: BigUint,
        /// The most that are allowed.
        limit: u64,
    },
    /// The fault probability is not between 0 and 1.
    #[non_exhaustive]
    FaultProbability {
        /// The value given.
        given: BigRational,
    },
    /// A load is on a sphere whose position depends on the stacking.
    #[non_exhaustive]
    PlaceOfLoad {
        /// The sphere.
        site: Site,
        /// Whether the base is given. Then the position of every layer above it depends on the stacking.
        on_base: bool,
    },
    /// A response to loads needs weightless spheres and at least one load.
    #[non_exhaustive]
    OnlyOfLoads {
        /// The quantity requested.
        quantity: &'static str,
        /// Whether the spheres are weightless, so that only a load is missing.
        weightless: bool,
    },
    /// The base supports no stacking of this height.
    #[non_exhaustive]
    NoStacking {
        /// The number of layers requested.
        layers: i128,
        /// The most layers that a stacking has on this base.
        greatest: i128,
        /// The base.
        base: Box<Region>,
    },
    /// Stability with horizontal contacts was requested for weightless spheres.
    Weightless,
    /// The ensemble counts stackings that stand with horizontal contacts, but the run has no judge of them.
    NoJudge,
}

/// Returns the error for a case that `invariant` rules out. With debug assertions it panics instead.
#[cold]
#[track_caller]
pub(crate) fn bug(invariant: &'static str) -> Error {
    engine::bug(invariant).into()
}

impl Error {
    /// Returns a syntax error that quotes `text`, shortened if it is long.
    pub(crate) fn syntax(text: &str, expected: &'static str) -> Self {
        cannonpile::Error::syntax(text, expected).into()
    }
}

impl From<cannonpile::Error> for Error {
    fn from(error: cannonpile::Error) -> Self {
        Self::Core(error)
    }
}

impl StdError for Error {
    /// Returns the source of a wrapped error, since the wrapped error itself is already displayed.
    fn source(&self) -> Option<&(dyn StdError + 'static)> {
        match self {
            Self::Core(error) => error.source(),
            _ => None,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = match self {
            Self::Core(error) => return error.fmt(f),
            Self::TooManyStackings { stackings, limit } => format!(
                "{stackings} stackings are too many to go through at a time, at most {limit}: draw samples, take a \
                 smaller shard, or fewer layers"
            ),
            Self::FaultProbability { given } => {
                format!("the fault probability must be at least 0 and at most 1, not {given}")
            }
            Self::PlaceOfLoad { site, on_base } => {
                let remedy = if *on_base {
                    "leave loads out, or let the stackings hang from a top layer"
                } else {
                    "put loads on the top layer, k = 0"
                };
                format!("the sphere (i,j,k) = {site} is not at one place in every stacking: {remedy}")
            }
            Self::OnlyOfLoads { quantity, weightless } => {
                let remedy = if *weightless {
                    "put a load on one of the top layer"
                } else {
                    "make them weightless, and put a load on one of the top layer"
                };
                format!("{quantity} is that of loads on spheres that weigh nothing: {remedy}")
            }
            Self::NoStacking { layers, greatest, base } => {
                format!("no stacking has {layers} layers on the base {base}: the highest has {greatest}")
            }
            Self::Weightless => {
                "bounds are those of a pile that weighs something: give the spheres their weight".to_owned()
            }
            Self::NoJudge => {
                "this ensemble counts stackings that stand with horizontal contacts, but has no judge of them: \
                 call Ensemble::run_judged".to_owned()
            }
        };
        f.write_str(&engine::shortened(&message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_of_the_core_display_as_themselves() {
        let inner = cannonpile::Pile::triangular(0).unwrap_err();
        let wrapped = Error::from(inner.clone());
        assert_eq!(wrapped.to_string(), inner.to_string());
        assert_eq!(
            wrapped.source().map(ToString::to_string),
            inner.source().map(ToString::to_string)
        );
    }

    #[test]
    fn long_numbers_are_shortened() {
        let stackings = BigUint::from(3_u32).pow(1000);
        let error = Error::TooManyStackings {
            stackings,
            limit: 1,
        };
        let message = error.to_string();
        assert!(message.len() < 250 && message.ends_with("or fewer layers"));
    }
}
