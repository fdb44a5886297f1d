//! Claims about random stackings on random input. The input is deterministic, from the generators that the fuzz targets
//! share.
//!
//! Each claim is a function of bytes. `cannonpile_testkit` defines the claims, and mutants that each claim must reject. A
//! failure prints the shortest bytes that proptest found, and the description of the case.

use cannonpile_testkit::{claims, properties};

properties! {
    means_agree_with_enumeration: claims::disorder::small, 256;
    means_of_any_size_succeed_or_are_rejected: claims::disorder::any_size, 512;
    words_round_trip: claims::disorder::any_word, 2048;
    ensembles_agree_with_enumeration: claims::ensemble::counts, 96;
    shards_merge_in_any_order: claims::ensemble::parts, 96;
    damaged_tallies_are_rejected_or_valid: claims::ensemble::damaged, 512;
}
