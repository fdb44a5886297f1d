//! What tests, fuzz targets and the bench of roundings share. It has no tests of its own: they are in the rooms.
//!
//! | file | what it has |
//! |---|---|
//! | `answers` | all that is said about one straight pile, as plain data |
//! | `cases`, `compare` | piles of any stacking made twice, for the library and for an oracle; their answers compared |
//! | `codes` | tables of contacts as codes write them (feature `export`) |
//! | `disorder` | piles of random stackings made twice |
//! | `judge` | which float is nearest to a number |
//! | `oracles` | what the library is compared with |
//! | `pair` | two scalars in step, and the first operation at which they part |
//! | `python_checker` | the second checker of certificates, as a process that stays |
//! | `rounding` | the cases of which every float must be the nearest |
//! | `stress` | piles at the limits of floats, and how far off each way to compute is there |
//! | `tally` | ensembles of stackings, counted one by one (feature `ensemble`) |
//! | `theorems` | what must hold of the answers about any straight pile |

#![allow(dead_code, reason = "each of those who share it uses a part")]

pub(crate) mod answers;
pub(crate) mod cases;
#[cfg(feature = "export")]
pub(crate) mod codes;
pub(crate) mod compare;
pub(crate) mod disorder;
pub(crate) mod judge;
pub(crate) mod oracles;
pub(crate) mod pair;
pub(crate) mod python_checker;
pub(crate) mod rounding;
pub(crate) mod stress;
#[cfg(feature = "ensemble")]
pub(crate) mod tally;
pub(crate) mod theorems;
