//! The claims about random stackings on random input: deterministic, from the generators that fuzzing shares.
//!
//! Each claim is a function of bytes; its planted faults stand beside it in `cannonpile_testkit`. A failure prints the
//! shortest bytes that proptest could find, and the claim's own witness.

use cannonpile_testkit::{claims, properties};

properties! {
    means_are_those_of_all_stackings: claims::disorder::small, 256;
    means_of_any_size_are_found_or_refused: claims::disorder::any_size, 512;
    words_are_read_as_they_are_printed: claims::disorder::any_word, 2048;
    ensembles_are_counted_one_by_one: claims::ensemble::counts, 96;
    parts_in_any_order_make_the_whole: claims::ensemble::parts, 96;
    damaged_tallies_are_refused_or_valid: claims::ensemble::damaged, 512;
}
