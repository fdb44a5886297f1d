//! `summary`: the pile in one row.

use cannonpile::Verdict;
use cannonpile::table;
use clap::Args;

use crate::args::{Numbers, Output, SceneOptions};
use crate::output::Failure;
use crate::progress::Progress;

const HELP: &str = "\
Lengths and forces in SI are for R = 1 m, m = 1 kg and g = 1 m/s², unless these are given.

Examples:
  cannonpile summary --stacking hcp --layers 7
  cannonpile summary --top hexagon:3 --stacking=++-+ --units si --gravity 9.81";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Summary {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    output: Output,
}

impl Summary {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        self.output.format()?;
        let units = self.numbers.units.of(&scene, &pile)?;
        // At the default spacing, where none is given: if that fits.
        let touching = pile.clearance().check(&scene.spacing()?).ok();
        let progress = Progress::begin("finding the extreme forces");
        let summary = table::Summary::new(&units, touching)?;
        let table = summary.table()?;
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        Ok(matches!(summary.verdict(), None | Some(Verdict::Yes)))
    }
}
