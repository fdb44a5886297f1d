//! Fixed and exhaustive tests of scenes, tables, exports and the comparison with measured forces.
//!
//! Random tests are in `tests/properties.rs`. The oracles are those of `cannonpile_testkit`.

mod error;
mod exports;
mod interrupt;
mod scene {
    mod cases;
    mod file;
}
mod stress;
mod verify;
