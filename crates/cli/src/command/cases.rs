//! `cases`: the benchmark cases.

use cannonpile_dem::table::NumberFormat;
use clap::Args;

use crate::args::Output;
use crate::output::Failure;
use crate::progress::Progress;
use crate::tables;

const HELP: &str = "\
Each has a name that others can quote: a case that was published is never altered, and new ones get new names. --case NAME
is a scene option of every command. stands is 'no' where contacts must be lost, and empty where the spheres weigh
nothing; it counts horizontal contacts in where they are meant, at a = R. contacts are those between layers. The
command of the last column writes the scene, the answers, and a card (card.md, card.json) that says what the case tests and what a
code must satisfy.

Examples:
  cannonpile cases
  cannonpile summary --case C8
  cannonpile export C2 --case C2 --to csv,card
  cannonpile verify forces.csv --case C2";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Cases {
    #[command(flatten)]
    output: Output,
}

impl Cases {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let progress = Progress::begin("listing the cases");
        self.output
            .write_table(tables::cases(), NumberFormat::Exact, &progress)?;
        Ok(true)
    }
}
