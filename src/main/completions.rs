//! Completions for shells, on stdout.

use std::io::{self, Write};

use cannonpile::table::WriteError;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

use crate::options::Arguments;

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
    pub(crate) fn run(&self) -> Result<(), WriteError> {
        let mut script = Vec::new();
        clap_complete::generate(
            self.shell,
            &mut Arguments::command(),
            "cannonpile",
            &mut script,
        );
        Ok(io::stdout().lock().write_all(&script)?)
    }
}
