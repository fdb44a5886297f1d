//! `base`: the force of each bottom sphere on the floor.

use cannonpile::table;
use clap::Args;

use super::{Command, Pulls};
use crate::args::{BaseAt, ByMethod, Numbers, Output, SceneOptions, narrower};
use crate::output::Failure;
use crate::progress::Progress;

const HELP: &str = "\
Columns: i, j; normal, downwards, in mg; shear_x in mg·tanθ and shear_y in √3·mg·tanθ (2cosφ·mg·tanθ for another base
triangle), also in csv and json; with --units si all in N, for m = 1 kg and g = 1 m/s² unless these are given.

Examples:
  cannonpile base --layers 10
  cannonpile base --layers 10 --spacing 6/5 --units si --number f64 --output base.csv
  cannonpile base --layers 1000000000000000000000000000000 --at 5,7";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Base {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    at: BaseAt,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    method: ByMethod,
    #[command(flatten)]
    output: Output,
}

impl Command for Base {
    fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        let selection = self.at.selection(&pile)?;
        self.output.format()?;
        let progress =
            Progress::of_rows("forces on the floor", pile.base_spheres().try_into().ok());
        let units = self.method.of(self.numbers.units(&scene, &pile)?)?;
        let table = table::base(&units, selection).map_err(|error| narrower(error, selection))?;
        let pulls = Pulls::in_column("normal");
        let table = pulls.watch(table);
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        drop(progress);
        pulls.note(&pile, selection);
        Ok(true)
    }

    fn scene(&self) -> Option<&SceneOptions> {
        Some(&self.scene)
    }

    fn target(&self) -> String {
        self.output.target()
    }
}
