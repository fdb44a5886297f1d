//! The claims about roots and rationals on random input: deterministic, from the generators that fuzzing shares.
//!
//! Each claim is a function of bytes; its planted faults stand beside it in `cannonpile_testkit`. A failure prints the
//! shortest bytes that proptest could find, and the claim's own witness.

use cannonpile_testkit::{claims, properties};

properties! {
    roots_round_to_the_nearest_float: claims::nearest::of_a_root, 1024;
    rationals_round_to_the_nearest_float: claims::nearest::of_a_rational, 1024;
    roots_are_ordered_as_their_squares: claims::order::of_two_roots, 1024;
    roots_of_squares_are_rational: claims::order::of_a_square, 256;
}
