//! `base`: the force of each bottom sphere on the floor.

use cannonpile::table;
use clap::Args;

use super::{Command, Pulls};
use crate::args::{BaseAt, ByMethod, Numbers, Output, SceneOptions, narrower};
use crate::output::Failure;
use crate::progress::Progress;

#[derive(Args)]
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
