//! Test support that all crates of the workspace share: oracles, piles made twice, random inputs and claims about them.
//!
//! The crate is unpublished. Tests, fuzz targets and benches of the other crates depend on it. Without features it depends
//! on the core only; each feature adds the parts that need one of the crates beside the core.
//!
//! | module | contents | feature |
//! |---|---|---|
//! | [`answers`] | everything the library answers about one straight pile, as plain data | |
//! | [`cases`], [`compare`] | piles of any stacking built twice, for the library and for an oracle; comparison of both | |
//! | [`claims`] | statements that hold for every input, as functions of bytes | some |
//! | `codes` | contact tables as DEM codes write them | `dem` |
//! | `disorder` | piles of random stackings built twice | `disorder` |
//! | [`errors`] | what an error says | |
//! | [`generators`] | random inputs from plain bytes | some |
//! | [`judge`] | whether a float is the one nearest to a number | |
//! | `json` | values written and read, as text and as bytes | `serde` |
//! | [`laws`] | the law suite of scalars on operands chosen to break it | |
//! | [`oracles`] | slow, simple computations that the library is compared with | some |
//! | [`pair`] | two scalars in step, and the first operation at which they differ | |
//! | [`proofs`] | what must hold of the theorems of a crate, and wrong formulas that they refuse | |
//! | [mod@properties] | the runner that tests a claim on random bytes | |
//! | [`python_checker`] | the second certificate checker, as a Python process | |
//! | [`rounding`] | inputs that are critical for correct rounding | some |
//! | `scenes` | scenes of every kind, and the files of their piles | `dem` |
//! | [`stress`] | piles at the limits of floats, and the errors of each way to compute there | |
//! | `tally` | ensembles of stackings, counted one by one | `disorder` |
//! | [`theorems`] | what must hold of the answers about any straight pile | |
//!
//! The tests of this crate show that each judge notices planted faults.

#![allow(
    clippy::missing_errors_doc,
    clippy::missing_panics_doc,
    clippy::must_use_candidate,
    reason = "only tests call these functions, and a failure there is a failed test"
)]

pub mod answers;
pub mod cases;
pub mod claims;
#[cfg(feature = "dem")]
pub mod codes;
pub mod compare;
#[cfg(feature = "disorder")]
pub mod disorder;
pub mod errors;
pub mod generators;
#[cfg(feature = "serde")]
pub mod json;
pub mod judge;
pub mod laws;
pub mod oracles;
pub mod pair;
pub mod proofs;
pub mod properties;
pub mod python_checker;
pub mod rounding;
#[cfg(feature = "dem")]
pub mod scenes;
pub mod stress;
#[cfg(feature = "disorder")]
pub mod tally;
pub mod theorems;
