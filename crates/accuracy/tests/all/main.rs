//! The tests of the crate, one file for each subject.

mod judge;
mod probable;
mod singular;
