//! The tests of the command line, which run the binary.
//!
//! Which option an error is blamed on is tested beside `culprit.rs`.

mod cli;
