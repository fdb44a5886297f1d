//! The tests of the crate, one file for each subject.

mod singular;
