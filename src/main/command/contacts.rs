//! `contacts`: the force of each contact between two spheres.

use cannonpile::shape::Selection;
use cannonpile::table;
use cannonpile::{Culprit, Error};
use clap::Args;

use super::{Command, Pulls};
use crate::args::{ByMethod, Numbers, Output, Part, SceneOptions, narrower, spheres};
use crate::output::{Failure, Refused};
use crate::progress::Progress;

#[derive(Args)]
pub(crate) struct Contacts {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    method: ByMethod,
    #[command(flatten)]
    output: Output,
}

impl Command for Contacts {
    fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        let selection = self.part.selection(&pile)?;
        if let Selection::One(site) = selection
            && site.k == pile.layers() - 1
        {
            return Err(Refused {
                remedy: Some("the command base"),
                ..Refused::of(Culprit::Site, Error::OnFloor { site })
            }
            .into());
        }
        self.output.format()?;
        let rows = spheres(&pile, selection)? * pile.dimension().directions().len();
        let progress = Progress::of_rows("contact forces", rows.try_into().ok());
        let units = self.method.of(self.numbers.units(&scene, &pile)?)?;
        let table =
            table::contacts(&units, selection).map_err(|error| narrower(error, selection))?;
        let pulls = Pulls::in_column("force");
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
