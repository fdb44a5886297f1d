//! `completions`: shell completions, on stdout.

use clap::Args;
use clap_complete::Shell;

use crate::output::{Failure, write_to};

const HELP: &str = "\
Example:
  source <(cannonpile completions bash)";

/// The command `completions`.
#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Completions {
    /// Shell that completes commands and options
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
