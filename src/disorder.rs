//! Random stackings: every stacking with its probability, and what the piles of all of them bear in the mean.

mod stackings;

pub use stackings::{FirstSign, RandomStackings};
