//! Completions for shells, on stdout.

use clap::Args;
use clap_complete::Shell;

use crate::output::{Failure, write_to};

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
        write_to("output", None, |out| Ok(out.write_all(&script)?))?;
        Ok(true)
    }
}
