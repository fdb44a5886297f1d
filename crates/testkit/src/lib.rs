//! Test support for all crates of the workspace: oracles, piles in two forms, random inputs, and claims about them.
//!
//! The crate is unpublished. Tests, fuzz targets and benches of the other crates depend on it. Without features it depends
//! only on the core. Each feature adds the parts that need another crate.
//!
//! | module | contents | feature |
//! |---|---|---|
//! | [`answers`] | all answers of the library about one straight pile, as plain data | |
//! | [`cases`], [`compare`] | piles of any stacking, for the library and for an oracle; comparison of both | |
//! | [`claims`] | properties that hold for every input, as functions of bytes | some |
//! | `codes` | contact tables as DEM codes write them | `dem` |
//! | `disorder` | piles of random stackings, for the library and for an oracle | `disorder` |
//! | [`errors`] | checks of error messages | |
//! | [`generators`] | random inputs from plain bytes | some |
//! | `guide` | the Rust examples of the guide, as doc tests | some |
//! | [`judge`] | whether a float is the one nearest to a number | |
//! | `json` | values written and read, as text and as bytes | `serde` |
//! | [`laws`] | the law suite of scalars on operands chosen to break it | |
//! | [`oracles`] | slow, simple computations that the library is compared with | some |
//! | [`pair`] | two scalars in parallel, and the first operation at which they differ | |
//! | [`processes`] | child processes whose waits end, and reports of missing programs | |
//! | [`proofs`] | checks of the theorems of a crate, and wrong formulas that the theorems must refute | |
//! | [mod@properties] | the runner that tests a claim on random bytes | |
//! | [`python_checker`] | the second certificate checker, as a Python process | |
//! | [`rational`] | rationals from machine integers | |
//! | [`real`] | scalars with rational bounds | |
//! | [`rounding`] | inputs that are critical for correct rounding | some |
//! | `scenes` | scenes of every kind, and the files of their piles | `dem` |
//! | `tally` | ensembles of stackings, enumerated one by one | `disorder` |
//!
//! The tests of this crate inject faults and show that each check catches them.

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
#[cfg(doctest)]
mod guide;
#[cfg(feature = "serde")]
pub mod json;
pub mod judge;
pub mod laws;
pub mod oracles;
pub mod pair;
pub mod processes;
pub mod proofs;
pub mod properties;
pub mod python_checker;
pub mod rational;
pub mod real;
pub mod rounding;
#[cfg(feature = "dem")]
pub mod scenes;
#[cfg(feature = "disorder")]
pub mod tally;
