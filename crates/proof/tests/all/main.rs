//! The tests of what is written for Coq, and of the theorems of all crates in one list.
//!
//! Random tests are in `tests/properties.rs`. The folder `coq` is checked by Coq itself.

mod expression;
mod proof;
mod scalar;
mod theorem;
