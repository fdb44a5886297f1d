//! Tests of the files for Coq, and of the list of theorems.
//!
//! Random tests are in `tests/properties.rs`. Coq itself checks the folder `coq`.

mod expression;
mod proof;
mod scalar;
mod theorem;
