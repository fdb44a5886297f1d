//! Tests of the command line, which run the binary.
//!
//! The tests in `culprit.rs` cover the option that causes an error.

mod binary;
mod cli;
mod long_numbers;
