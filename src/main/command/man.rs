//! Pages of the manual, a file for each command.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use cannonpile::table::{WriteError, write_aside};
use clap::{Args, Command};

use crate::output::{Failure, write_to};

const HELP: &str = "\
The pages say what --help says. The folder is created if it is missing; each page is written under another name, and
renamed when it is complete.

Examples:
  cannonpile man man1
  man -l man1/cannonpile-base.1";

/// `man`: packages install its pages, `man` shows them.
#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Man {
    /// The folder to write cannonpile.1, cannonpile-base.1 and the others into
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

impl Man {
    /// Writes the pages of the whole command line, and lists their files.
    pub(crate) fn write(&self, line: Command) -> Result<bool, Failure> {
        let mut line = line.disable_help_subcommand(true);
        // Commands below others have their whole names then.
        line.build();
        fs::create_dir_all(&self.folder).map_err(|error| unwritten(error.into(), &self.folder))?;
        let mut written = Vec::new();
        for page in pages(&line) {
            let path = self.folder.join(page.get_filename());
            let page = |mut out: &mut dyn Write| Ok(page.render(&mut out)?);
            write_aside(&path, page).map_err(|error| unwritten(error, &path))?;
            written.push(path);
        }
        write_to("output", None, |out| {
            for path in &written {
                writeln!(out, "{}", path.display())?;
            }
            Ok(())
        })?;
        Ok(true)
    }
}

/// Returns why there is no such file or folder.
fn unwritten(error: WriteError, path: &Path) -> Failure {
    let error = match error {
        WriteError::Io(error) => WriteError::File {
            path: path.into(),
            error,
        },
        error => error,
    };
    Failure::of_writing(error, "output", None)
}

/// Returns the page of a command, and those of the commands below it.
fn pages(command: &Command) -> Vec<clap_mangen::Man> {
    let below = command.get_subcommands().flat_map(pages);
    let own = clap_mangen::Man::new(command.clone());
    core::iter::once(own).chain(below).collect()
}
