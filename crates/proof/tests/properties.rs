//! The claims about recorded formulas on random input: deterministic, from the generators that fuzzing shares.
//!
//! Each claim is a function of bytes; its planted faults stand beside it in `cannonpile_testkit`. A failure prints the
//! shortest bytes that proptest could find, and the claim's own witness.

use cannonpile_testkit::{claims, properties};

properties! {
    what_coq_reads_are_the_formulas: claims::recorded::any_values, 1024;
}
