//! `cases`: the benchmark cases.

use cannonpile_dem::table::NumberFormat;
use clap::Args;

use crate::args::Output;
use crate::output::Failure;
use crate::progress::Progress;
use crate::tables;

const HELP: &str = "\
The name of a case can be cited: a published case never changes. Other commands take a case as --case NAME.

Columns:
  name, title         the case
  dimension, layers   2 for discs, 3 for spheres; number of layers
  spheres, contacts   numbers of spheres, and of contacts between layers
  stands              yes if the pile is stable; no if contacts must open; empty for spheres without weight
  command             writes the scene, the exact forces, and a card with the purpose and the acceptance criteria

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
