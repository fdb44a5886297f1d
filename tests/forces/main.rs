//! Fixed and exhaustive tests of forces: the formulas, the engines, the answers in pile units and in SI.
//!
//! Without the feature `std` only the roots use another algorithm. So a build without `std` contains only the tests of
//! rounding.

#[cfg(feature = "std")]
mod dual;
#[cfg(feature = "std")]
mod limits;
#[cfg(feature = "std")]
mod theorems;

#[cfg(feature = "std")]
mod formula {
    mod one_body;
    mod turn;
}

#[cfg(feature = "std")]
mod engine {
    mod high;
    mod methods;
    mod placement;
    mod plans;
    mod trees;
    mod widths;
}

mod forces {
    #[cfg(feature = "std")]
    mod against_oracle;
    #[cfg(feature = "std")]
    mod agreement;
    #[cfg(feature = "std")]
    mod closures;
    #[cfg(feature = "std")]
    mod contracts;
    #[cfg(feature = "std")]
    mod directed;
    #[cfg(feature = "std")]
    mod equilibrium;
    #[cfg(feature = "std")]
    mod error_bounds;
    #[cfg(feature = "std")]
    mod extremes;
    #[cfg(feature = "std")]
    mod faulty_answers;
    #[cfg(feature = "std")]
    mod faulty_forces;
    #[cfg(feature = "std")]
    mod horizontal_forces;
    #[cfg(feature = "std")]
    pub(crate) mod invariants;
    mod layers;
    #[cfg(feature = "std")]
    mod loads;
    #[cfg(feature = "std")]
    mod mirrors;
    #[cfg(feature = "std")]
    mod parts;
    #[cfg(feature = "std")]
    mod response;
    mod rows;
    #[cfg(feature = "std")]
    mod scalars;
    #[cfg(feature = "std")]
    mod stress;
    #[cfg(feature = "std")]
    mod stress_table;
    #[cfg(feature = "std")]
    mod symmetry;
}

mod packing {
    #[cfg(feature = "std")]
    mod derivatives;
    mod places;
    mod rounded;
    mod vectors;
}
