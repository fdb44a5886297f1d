//! `spheres`: the place, size and mass of each sphere.

use cannonpile::shape::Selection;
use cannonpile_dem::table;
use clap::Args;

use super::note_if_it_falls;
use crate::args::{Numbers, Output, Part, SceneOptions, narrower, spheres};
use crate::output::Failure;
use crate::progress::Progress;

const HELP: &str = "\
Spheres are numbered from 1, row by row from the top, as export and verify number them. z points up. R = 1 m and m = 1 kg,
unless these are given.

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
        let progress = Progress::of_rows("places", rows.try_into().ok());
        let table = table::spheres(&scene.packing(&pile)?, selection)
            .map_err(|error| narrower(error, selection))?;
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        drop(progress);
        // The verdict on the pile would take longer than the places of a part of it.
        if selection == Selection::All {
            note_if_it_falls(&pile);
        }
        Ok(true)
    }
}
