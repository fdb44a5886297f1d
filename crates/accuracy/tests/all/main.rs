//! The tests of the crate, one file for each subject.

mod errors;
mod judge;
mod probable;
mod singular;
mod stochastic;
