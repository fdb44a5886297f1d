//! Claims about recorded formulas on random input. The test is deterministic, and its generators are those of the
//! fuzz targets.
//!
//! Each claim is a function of bytes. `cannonpile_testkit` defines the claims, and mutants that each claim must reject. A
//! failure prints the shortest input that proptest finds, and the counterexample of the claim.

use cannonpile_testkit::{claims, properties};

properties! {
    exported_formulas_match_library: claims::recorded::any_values, 1024;
}
