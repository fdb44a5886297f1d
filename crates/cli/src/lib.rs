//! The command line: parses arguments, calls the other crates, prints the results.
//!
//! The program `cannonpile` is [`run`].

mod args;
mod command;
mod culprit;
mod error;
mod input;
mod output;
mod program;
mod progress;
mod signals;
mod tables;
mod threads;

use culprit::Culprit;
use error::Error;

pub use program::{command, run};
