//! The error type of this crate.

use std::error::Error as StdError;
use std::fmt;

use cannonpile::engine;
use cannonpile::lattice::{Region, Site};
use num_bigint::BigUint;
use num_rational::BigRational;

/// An error of this crate, or a wrapped error of the crate `cannonpile`.
///
/// The message is one line. It names the value and states what would be accepted.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, RandomStackings};
///
/// let error = RandomStackings::new(0, FirstSign::Plus).unwrap_err();
/// assert_eq!(error.to_string(), "layers must be at least 1 and at most 10^36, not 0");
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Error {
    /// An error of the crate `cannonpile`. It displays as that error.
    Core(cannonpile::Error),
    /// The ensemble has more stackings than one run enumerates.
    TooManyStackings {
        /// The number of stackings.
        stackings: BigUint,
        /// The largest allowed number.
        limit: u64,
    },
    /// The fault probability is not between 0 and 1.
    FaultProbability {
        /// The value given.
        given: BigRational,
    },
    /// A load is on a sphere whose position depends on the stacking.
    PlaceOfLoad {
        /// The sphere.
        site: Site,
        /// True if the base is given. Then the position of every layer above it depends on the stacking.
        on_base: bool,
    },
    /// The quantity is defined for the response to loads only. It needs weightless spheres and at least one load.
    NotAResponse {
        /// The quantity requested.
        quantity: &'static str,
        /// True if the spheres are weightless, so that only a load is missing.
        weightless: bool,
    },
    /// The base supports no stacking of this height.
    NoStacking {
        /// The number of layers requested.
        layers: i128,
        /// The largest number of layers that this base supports.
        greatest: i128,
        /// The base.
        base: Box<Region>,
    },
    /// Stability with horizontal contacts was requested for weightless spheres.
    Weightless,
    /// The ensemble counts stackings that are stable with horizontal contacts, but the run has no judge.
    NoJudge,
}

cannonpile::engine::equality!(Error);

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

impl StdError for Error {}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let message = match self {
            Self::Core(error) => return error.fmt(f),
            Self::TooManyStackings { stackings, limit } => format!(
                "{stackings} stackings exceed the limit of {limit} for one run; draw samples, or use a smaller shard or \
                 fewer layers"
            ),
            Self::FaultProbability { given } => {
                format!("the fault probability must be at least 0 and at most 1, not {given}")
            }
            Self::PlaceOfLoad { site, on_base } => {
                let remedy = if *on_base {
                    "remove the loads, or give a top layer instead of the base"
                } else {
                    "put loads on the top layer, k = 0"
                };
                format!("the position of sphere (i,j,k) = {site} depends on the stacking; {remedy}")
            }
            Self::NotAResponse { quantity, weightless } => {
                let remedy = if *weightless {
                    "add a load on the top layer"
                } else {
                    "make the spheres weightless, and add a load on the top layer"
                };
                format!("{quantity} is defined for loads on weightless spheres only; {remedy}")
            }
            Self::NoStacking { layers, greatest, base } => {
                let s = if *greatest == 1 { "" } else { "s" };
                format!("base {base} supports at most {greatest} layer{s}, not {layers}; use fewer layers or a larger base")
            }
            Self::Weightless => {
                "stability with horizontal contacts needs the weight of the spheres; do not make them weightless".to_owned()
            }
            Self::NoJudge => {
                "the ensemble counts stackings that are stable with horizontal contacts, but the run has no judge; \
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
    fn errors_of_the_core_keep_their_message() {
        let inner = cannonpile::Pile::triangular(0).unwrap_err();
        let wrapped = Error::from(inner.clone());
        assert_eq!(wrapped.to_string(), inner.to_string());
        // A source would repeat the message in reports of the whole chain.
        assert!(wrapped.source().is_none());
    }

    #[test]
    fn messages_shorten_long_numbers() {
        let stackings = BigUint::from(3_u32).pow(1000);
        let error = Error::TooManyStackings {
            stackings,
            limit: 1,
        };
        let message = error.to_string();
        assert!(message.len() < 250 && message.ends_with("or fewer layers"));
    }
}
