//! Exact contact forces in sphere piles of random stackings: mean forces, moments of the response to a load, and
//! ensembles.
//!
//! A stacking is a sequence of close-packed layers. In a random stacking each sign of the sequence differs from the
//! previous sign with the fault probability q, independently. A recursion over the layers yields averages over all
//! stackings, in exact numbers or in floats. Quantities without such a recursion are computed by enumeration or
//! sampling.
//!
//! ```
//! use cannonpile_disorder::{ContactSet, Choice, Ensemble, FirstSign, RandomPiles, RandomStackings, Shard};
//! use cannonpile::lattice::{Region, Site};
//! use num_rational::BigRational;
//!
//! let half = BigRational::new(1.into(), 2.into());
//! let stackings = RandomStackings::new(6, FirstSign::Plus)?;
//!
//! // The mean normal forces on the floor below a unit load on one sphere of a wide top layer sum to the load.
//! let load = BigRational::from_integer(1.into());
//! let plane = RandomPiles::plane(stackings).weightless().with_load(Site::APEX, load.clone())?;
//! let mean = plane.mean(&half)?;
//! assert_eq!(mean.rows().iter().map(|row| &row.normal).sum::<BigRational>(), load);
//!
//! // Of the 16 stackings of six layers under one sphere, 11 stand.
//! let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
//! assert_eq!(tally.standing(ContactSet::Sloping), Some(11_u32.into()));
//! # Ok::<(), cannonpile_disorder::Error>(())
//! ```
//!
//! # Map
//! | subject | items |
//! |---|---|
//! | the random stackings | [`RandomStackings`], [`FirstSign`], [`check_fault_probability`] |
//! | mean forces, at one q or for all | [`RandomPiles`], [`Mean`], [`MeanForce`]; [`ByFaults`], [`FaultForce`]; [`Place`] |
//! | moments of the response to a load, and its waves | [`Moments`], [`Wave`] |
//! | enumeration and samples | [`Ensemble`], [`Choice`], [`Samples`], [`Shard`] |
//! | the result of a run, and its file | [`Tally`], [`WithFaults`], [`Distribution`], [`Histogram`], [`ForceKind`], [`Extreme`]; [`TallyRecord`], [`Unmergeable`] |
//! | the formulas, which `cannonpile-proof` proves | [`formula`] |
//! | errors | [`Error`] |
//!
//! # Guarantees
//! * With exact scalars every result is exact. With floats each operation rounds.
//! * A tally contains integers and rationals only. The tallies of all shards merge into the tally of the whole, byte
//!   for byte.
//! * Sample n depends on the seed, the fault probability and n only. It is the same on every machine and in every shard.
//! * A function that would need too much memory or time returns an error, which names the limit.
//! * The crate contains no `unsafe` code.
//!
//! The feature `rayon` runs sweeps and enumerations on all cores. It changes no result.
#![doc = "\n# Random stackings\n"]
#![doc = include_str!("disorder.md")]

use std::num::NonZeroI64;

mod correlation;
mod domain;
mod ensemble;
mod error;
mod faults;
mod floor;
pub mod formula;
mod grid;
mod mean;
mod moments;
mod nets;
mod number;
mod piles;
mod place;
mod stackings;
mod transfer;
mod width;

use cannonpile::each::Each;

pub use ensemble::{
    Choice, ContactSet, Distribution, Ensemble, Extreme, ForceKind, Histogram, Samples, Shard,
    Tally, TallyRecord, Unmergeable, WithFaults,
};
pub use error::Error;
pub use faults::{ByFaults, FaultForce};
pub use mean::{Mean, MeanForce};
pub use moments::{Moments, Wave};
pub use piles::RandomPiles;
pub use place::Place;
pub use stackings::{FirstSign, RandomStackings, check_fault_probability};

// The compiler evaluates the `unwrap`, and rejects zero.
pub(crate) const ONE: NonZeroI64 = NonZeroI64::new(1).unwrap();
pub(crate) const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();
pub(crate) const THREE: NonZeroI64 = NonZeroI64::new(3).unwrap();

/// Runs the examples of README.md as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
