//! `spheres`: the position, radius and mass of each sphere.

use cannonpile::shape::Selection;
use cannonpile_dem::table;
use clap::Args;

use super::note_instability;
use crate::args::{Numbers, Output, Part, SceneOptions, spheres, with_row_options};
use crate::output::Failure;
use crate::progress::Progress;

const HELP: &str = "\
Columns:
  id             number of the sphere, from 1 at the top, as in export and verify
  k, i, j        layer, from 0 at the top, and indices in the layer
  x, y, z        centre, in m; z points up
  radius, mass   in m and kg
  fixed          1 in the bottom layer, otherwise 0

Examples:
  cannonpile spheres --layers 4
  cannonpile spheres --layers 4 --radius 1/100 --number f64 --output spheres.json";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Spheres {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    output: Output,
}

impl Spheres {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read_whole()?;
        let selection = self.part.selection(&pile)?;
        self.output.format()?;
        let rows = spheres(&pile, selection)?;
        let progress = Progress::of_rows("positions", rows.try_into().ok());
        let table = table::spheres(&scene.packing(&pile)?, selection)
            .map_err(|error| with_row_options(error, selection))?;
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        drop(progress);
        // The stability check takes longer than the positions of a part of the pile.
        if selection == Selection::All {
            note_instability(&pile);
        }
        Ok(true)
    }
}
