//! `prove`: what is proved for every pile.

use cannonpile::table::{self, NumberFormat};
use cannonpile::theorem::{self, Listing};
use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::args::{Format, Output};
use crate::output::Failure;
use crate::progress::Progress;

const HELP: &str = "\
Examples:
  cannonpile prove
  cannonpile prove --theorem uniform-base";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Prove {
    /// One theorem only, with its whole derivation
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(theorem::all().map(|t| t.name)))]
    theorem: Option<String>,
    #[command(flatten)]
    output: Output,
}

impl Prove {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let format = self.output.format()?;
        let progress = Progress::begin("proving");
        let name = self.theorem.as_deref();
        let wanted = theorem::all().filter(|theorem| name.is_none_or(|name| theorem.name == name));
        let proved: Vec<_> = wanted.map(|theorem| (theorem, theorem.prove())).collect();
        let all_hold = proved.iter().all(|(_, proof)| proof.holds());
        if format != Format::Table {
            let table = table::theorems(proved.into_iter());
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
}
