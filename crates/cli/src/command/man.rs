//! `man`: writes the manual pages, a file for each command.

use std::path::PathBuf;

use cannonpile_dem::table;
use clap::{Args, Command};

use crate::output::{Failure, write_to};

const HELP: &str = "\
Each page contains the text of --help. The pages appear together, when all are complete.

Examples:
  cannonpile man man1
  man -l man1/cannonpile-base.1";

/// The command `man`, for packages that install manual pages.
#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Man {
    /// Folder for cannonpile.1, cannonpile-base.1 and the other pages, created if it is missing
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

impl Man {
    /// Writes the pages of all commands and lists their files.
    pub(crate) fn write(&self, line: Command) -> Result<bool, Failure> {
        let mut line = line.disable_help_subcommand(true);
        // This gives subcommands their full names.
        line.build();
        let pages = pages(&line);
        let pages = pages.into_iter();
        let files = pages.map(|page| (self.folder.join(page.get_filename()), page));
        let written = table::write_all(&self.folder, files, |page, mut out| {
            Ok(page.render(&mut out)?)
        })
        .map_err(|error| Failure::of_writing(error, "output", None))?;
        write_to("output", None, |out| {
            for (path, _) in &written {
                writeln!(out, "{}", path.display())?;
            }
            Ok(())
        })?;
        Ok(true)
    }
}

/// Returns the page of a command, and those of its subcommands.
fn pages(command: &Command) -> Vec<clap_mangen::Man> {
    let below = command.get_subcommands().flat_map(pages);
    let own = clap_mangen::Man::new(command.clone());
    core::iter::once(own).chain(below).collect()
}
