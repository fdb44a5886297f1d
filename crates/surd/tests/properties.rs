//! Claims about roots and rationals on random input. The test is deterministic, and its generators are
//! those of the fuzz targets.
//!
//! Each claim is a function of bytes. `cannonpile_testkit` defines the claims, and mutants that each claim must
//! reject. A failure prints the shortest input that proptest finds, and the counterexample of the claim.

use cannonpile_testkit::{claims, properties};

properties! {
    roots_round_to_correct_rounding: claims::nearest::of_a_root, 1024;
    rationals_round_to_correct_rounding: claims::nearest::of_a_rational, 1024;
    roots_are_ordered_as_their_squares: claims::order::of_two_roots, 1024;
    roots_of_squares_are_rational: claims::order::of_a_square, 256;
}
