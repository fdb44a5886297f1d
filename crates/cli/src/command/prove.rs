//! `prove`: theorems that hold for every pile.

use std::io::Write;
use std::path::{Path, PathBuf};

use cannonpile_dem::table::{NumberFormat, write_all};
use cannonpile_proof::{Listing, all, commands, files};
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};

use crate::args::{Format, Output};
use crate::output::Failure;
use crate::progress::Progress;
use crate::tables;

const HELP: &str = "\
Without --to this command proves each theorem and prints its statement, its method and its result. The exit status is 1 if
a theorem fails.

--to coq writes the formulas, exactly as they run, as Coq definitions, together with hand-written laws and proofs. It
prints the Coq name of each theorem and the commands that check the files. Coq then checks every proof, by induction where
the statement covers every number of layers, and coqchk finds no axiom. The files appear together, when all are complete.

Examples:
  cannonpile prove
  cannonpile prove --theorem uniform-base
  cannonpile prove --to coq proofs";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Prove {
    /// Theorem to prove, with its full derivation [default: all, without derivations]
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(all().map(|t| t.name)))]
    theorem: Option<String>,
    /// Proof assistant; writes the formulas and proofs for it into DIR
    #[arg(
        long,
        value_enum,
        value_name = "PROGRAM",
        requires = "folder",
        conflicts_with = "theorem"
    )]
    to: Option<Target>,
    /// Folder for --to, created if it is missing
    #[arg(value_name = "DIR", requires = "to")]
    folder: Option<PathBuf>,
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, ValueEnum)]
enum Target {
    /// Coq 8.16 or later
    Coq,
}

impl Prove {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let format = self.output.format()?;
        if let (Some(Target::Coq), Some(folder)) = (self.to, self.folder.as_deref()) {
            return self.write_for_coq(folder, format);
        }
        let progress = Progress::begin("proving");
        let name = self.theorem.as_deref();
        let wanted = all().filter(|theorem| name.is_none_or(|name| theorem.name == name));
        let proved: Vec<_> = wanted.map(|theorem| (theorem, theorem.prove())).collect();
        let all_hold = proved.iter().all(|(_, proof)| proof.holds());
        if format != Format::Table {
            let table = tables::theorems(proved.into_iter());
            self.output
                .write_table(table, NumberFormat::Exact, &progress)?;
            return Ok(all_hold);
        }
        self.output.write(&progress, |out| {
            let whole = name.is_some();
            for (place, (theorem, proof)) in proved.iter().enumerate() {
                let gap = if place > 0 { "\n" } else { "" };
                let listing = Listing {
                    theorem,
                    proof,
                    whole,
                };
                write!(out, "{gap}{listing}")?;
            }
            if !whole {
                let holding = proved.iter().filter(|(_, proof)| proof.holds()).count();
                writeln!(out, "\n{holding} of {} theorems hold", proved.len())?;
            }
            Ok(())
        })?;
        Ok(all_hold)
    }

    /// Writes the files, then prints the theorems and the commands that check them.
    fn write_for_coq(&self, folder: &Path, format: Format) -> Result<bool, Failure> {
        let files = files()?;
        let files = files
            .iter()
            .map(|file| (folder.join(file.name()), file.text()));
        let checks = commands(folder)?;
        let progress = Progress::begin("writing the proofs");
        let (table, numbers) = (tables::in_coq(), NumberFormat::Exact);
        let list = |out: &mut dyn Write| {
            table.write(format.into(), numbers, out)?;
            if format == Format::Table {
                writeln!(out, "\n{checks}")?;
            }
            Ok(())
        };
        self.output.write_with(&progress, list, Some(folder), || {
            let written = write_all(folder, files, |text, out| {
                Ok(out.write_all(text.as_bytes())?)
            });
            written
                .map(drop)
                .map_err(|error| Failure::of_writing(error, "to", Some(folder)))
        })?;
        Ok(true)
    }
}
