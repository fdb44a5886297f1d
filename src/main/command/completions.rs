//! Completions for shells, on stdout.

use std::io::{self, Write};

use cannonpile::table::WriteError;
use clap::Args;
use clap_complete::Shell;

use crate::output::Failure;

/// `completions`: bash has them after `source <(cannonpile completions bash)`.
#[derive(Args)]
pub(crate) struct Completions {
    /// The shell that is to complete commands and options
    #[arg(
        value_enum,
        value_name = "bash|zsh|fish|elvish|powershell",
        hide_possible_values = true
    )]
    shell: Shell,
}

impl Completions {
    /// Prints the script for the whole command line.
    pub(crate) fn print(&self, mut line: clap::Command) -> Result<bool, Failure> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut line, "cannonpile", &mut script);
        let written = io::stdout().lock().write_all(&script);
        written.map_err(WriteError::from)?;
        Ok(true)
    }
}
