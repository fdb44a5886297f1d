//! The exhaustive and the fixed tests: a folder for each room of `src`, a file for each subject.
//!
//! What they share stands in `tests/support`: oracles, the judges of theorems and of roundings, piles made twice. Random
//! tests are in `tests/properties`. A test of what several rooms do together stands with the lowest of them.
//!
//! Without `std` only roots are taken in another way, so only what rounds is built then.

#[path = "../support/mod.rs"]
mod support;

mod scalar {
    mod double_double;
    mod expression;
    #[cfg(feature = "std")]
    mod fixed_width;
    #[cfg(feature = "std")]
    mod flaws;
    #[cfg(feature = "std")]
    mod half;
    #[cfg(feature = "std")]
    mod interval;
    #[cfg(feature = "std")]
    mod laws;
    mod nearest;
    #[cfg(feature = "std")]
    mod pair;
    #[cfg(feature = "std")]
    mod polynomial;
    #[cfg(feature = "std")]
    mod sums;
    mod surd;
}

#[cfg(feature = "std")]
mod lattice;

#[cfg(feature = "std")]
mod stacking {
    mod definitions;
    mod long;
    mod notations;
}

#[cfg(feature = "std")]
mod shape {
    mod counts;
    mod edges;
    mod greatest_height;
    mod grown;
    mod mixed;
    mod numbering;
}

#[cfg(feature = "std")]
mod geometry {
    mod clearance;
    mod positions;
}

#[cfg(feature = "std")]
mod formula {
    mod one_body;
    mod turn;
}

#[cfg(feature = "std")]
mod engine {
    mod high;
    #[cfg(all(feature = "export", feature = "horizontal"))]
    mod interrupt;
    mod methods;
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
    mod contracts;
    #[cfg(feature = "std")]
    mod equilibrium;
    #[cfg(feature = "std")]
    mod error_bounds;
    #[cfg(feature = "std")]
    mod extremes;
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
    mod planted;
    #[cfg(feature = "std")]
    mod planted_faults;
    #[cfg(feature = "std")]
    mod pushes;
    #[cfg(feature = "std")]
    mod response;
    mod rows;
    #[cfg(feature = "std")]
    mod scalars;
    #[cfg(feature = "std")]
    mod stress_table;
    #[cfg(feature = "std")]
    mod symmetry;
}

mod packing {
    mod places;
    mod rounded;
    mod vectors;
}

#[cfg(feature = "std")]
mod standing {
    mod least;
}

#[cfg(feature = "std")]
mod census {
    mod all_stackings;
    pub(crate) mod brute;
}

#[cfg(feature = "horizontal")]
mod horizontal {
    mod bounds;
    mod census;
    mod states;

    /// All stackings of so many steps that begin with +.
    fn stackings(steps: usize) -> impl Iterator<Item = String> {
        let all = crate::support::cases::all_signs(steps);
        all.into_iter().filter(|signs| signs.starts_with('+'))
    }
}

#[cfg(feature = "ensemble")]
mod ensemble {
    mod enumeration;
    mod parts;
    mod samples;

    use num_rational::BigRational;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }
}

#[cfg(feature = "std")]
mod certificate;

#[cfg(feature = "std")]
mod disorder {
    mod denominators;
    mod ensemble_of_stackings;
    mod enumeration;
    mod few_faults;
    mod moments;
    mod products;
    mod refused;
    mod spread;
    mod squares;
    mod sums;
    mod widths;
}

#[cfg(feature = "std")]
mod theorem;

#[cfg(feature = "export")]
mod proof;

#[cfg(feature = "toml")]
mod scene {
    mod cases;
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

#[cfg(feature = "std")]
mod error;

#[cfg(feature = "std")]
mod house;
