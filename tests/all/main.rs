//! The exhaustive and the fixed tests: a folder for each room of `src`, a file for each subject.
//!
//! What they share stands in `tests/support`: oracles, the judges of theorems and of roundings, piles made twice. Random
//! tests are in `tests/properties`. A test of what several rooms do together stands with the lowest of them.

#[path = "../support/mod.rs"]
mod support;

mod scalar {
    mod double_double;
    mod fixed_width;
    mod flaws;
    mod half;
    mod interval;
    mod laws;
    mod nearest;
    mod pair;
    mod polynomial;
    mod sums;
    mod surd;
}

mod lattice;

mod stacking {
    mod definitions;
    mod long;
    mod notations;
}

mod shape {
    mod counts;
    mod edges;
    mod greatest_height;
    mod grown;
    mod mixed;
    mod numbering;
}

mod geometry {
    mod clearance;
    mod positions;
}

mod formula {
    mod one_body;
}

mod engine {
    mod high;
    mod methods;
    mod trees;
    mod widths;
}

mod forces {
    mod against_oracle;
    mod agreement;
    mod contracts;
    mod equilibrium;
    mod extremes;
    pub(crate) mod invariants;
    mod layers;
    mod loads;
    mod mirrors;
    mod parts;
    mod planted;
    mod planted_faults;
    mod response;
    mod rows;
    mod scalars;
    mod stress_table;
    mod symmetry;
}

mod packing {
    mod rounded;
    mod vectors;
}

mod census {
    mod all_stackings;
    pub(crate) mod brute;
}

mod theorem;

#[cfg(feature = "toml")]
mod scene {
    mod file;
}

#[cfg(feature = "serde")]
mod serde;

#[cfg(feature = "export")]
mod dem;

#[cfg(feature = "export")]
mod verify;

#[cfg(feature = "plot")]
mod figure;

#[cfg(feature = "cli")]
mod cli;

mod error;

mod house;
