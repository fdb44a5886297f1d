//! `contacts`: the force of each contact between two spheres.

use cannonpile::shape::Selection;
use cannonpile::table;
use cannonpile::{Culprit, Error};
use clap::Args;

use super::{Command, Pulls};
use crate::args::{ByMethod, Numbers, Output, Part, SceneOptions, narrower, spheres};
use crate::output::{Failure, Refused};
use crate::progress::Progress;

const HELP: &str = "\
Each row is a sphere (k, i, j), counted from k = 0 at the top, and its contact with the sphere below it in one direction.
The force is positive for a push, in mg/(3cosθ); with --units si in N and m, for R = 1 m, m = 1 kg and g = 1 m/s² unless
these are given, with the force on the upper sphere fx, fy, fz and the point of contact x, y, z.

Examples:
  cannonpile contacts --layers 4
  cannonpile contacts --stacking hcp --layers 7 --layer 4
  cannonpile contacts --layers 20 --units si --number f64 --output contacts.csv";

#[derive(Args)]
#[command(after_help = HELP)]
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
