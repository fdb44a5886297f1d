//! Fixed and exhaustive tests of regions, stackings, shapes and positions.

#![cfg(feature = "std")]

mod lattice;

mod stacking {
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
    mod round_base;
}

mod geometry {
    mod clearance;
    mod overlap;
    mod positions;
}
