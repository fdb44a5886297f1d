//! `summary`: the pile in one row.

use cannonpile::Verdict;
use cannonpile::table;
use clap::Args;

use super::Command;
use crate::args::{Numbers, Output, SceneOptions};
use crate::output::{Failure, complain};
use crate::progress::Progress;

const HELP: &str = "\
Lengths and forces in SI are for R = 1 m, m = 1 kg and g = 1 m/s², unless these are given. Why a column is empty is said in
a note on stderr.

Examples:
  cannonpile summary --stacking hcp --layers 7
  cannonpile summary --top hexagon:3 --stacking=++-+ --units si --gravity 9.81";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Summary {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    output: Output,
}

impl Command for Summary {
    fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        self.output.format()?;
        let units = self.numbers.units(&scene, &pile)?;
        // At the default spacing, where none is given: if that fits.
        let touching = pile.clearance().check(&scene.spacing()?);
        let progress = Progress::begin("finding the extreme forces");
        let summary = table::Summary::new(&units, touching.clone().ok())?;
        let table = summary.table()?;
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        drop(progress);
        let touching = touching.err().map(|error| ("touching", error.to_string()));
        for (columns, reason) in summary.left_out().into_iter().chain(touching) {
            complain(&format!("note: no {columns}: {reason}"));
        }
        Ok(matches!(summary.verdict(), None | Some(Verdict::Yes)))
    }

    fn scene(&self) -> Option<&SceneOptions> {
        Some(&self.scene)
    }

    fn target(&self) -> String {
        self.output.target()
    }
}
