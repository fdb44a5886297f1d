//! The tests of the crate, one file for each subject. The oracles are those of `cannonpile_testkit`.

mod census;
mod friction;
mod sensitivity;
mod tilts;
mod uniqueness;
