//! `summary`: the pile in one row.

use cannonpile::Verdict;
use cannonpile::table;
use clap::Args;

use crate::args::{Numbers, Output, SceneOptions};
use crate::output::{Failure, complain};
use crate::progress::Progress;

const HELP: &str = "\
stands is 'no' if a contact would have to pull, and 'undetermined' if it would, but spheres touch that have no contact in
this theory, which may hold the pile: 'touching' says where they are, at --spacing. Exit status 1 unless it stands. A force
that would take too long to find is shown as -, and a note says why. With --units si forces are in N, for R = 1 m, m = 1 kg and g = 1 m/s² unless
these are given.

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
        let touching = pile.clearance().check(&scene.spacing()?);
        let progress = Progress::begin("finding the extreme forces");
        let summary = table::Summary::new(&units, touching.clone().ok())?;
        let table = summary.table();
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        drop(progress);
        let touching = touching.err().map(|error| ("touching", error.to_string()));
        for (columns, reason) in summary.left_out().into_iter().chain(touching) {
            complain(&format!("note: no {columns}: {reason}"));
        }
        Ok(matches!(summary.verdict(), None | Some(Verdict::Yes)))
    }
}
