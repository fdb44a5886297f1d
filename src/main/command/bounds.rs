//! `bounds`: what bottom spheres can bear with horizontal contacts.

use cannonpile::table;
use clap::Args;

use crate::args::{BaseAt, Number, Output, SceneOptions, narrower};
use crate::output::Failure;
use crate::progress::Progress;

const HELP: &str = "\
At a = R neighbours of a layer touch, and the forces are no longer unique. Columns: i, j; normal_min and normal_max, the
least and the greatest normal force in mg that forces can give which balance the pile and only push; proved, 'yes' if both
are attained, else no forces pass them. Answers are formulas proved for all L, of straight piles, or were checked exactly.

Examples:
  cannonpile bounds --layers 10
  cannonpile bounds --stacking=++-+ --at=0,1
  cannonpile bounds --layers 1000000 --at 0,0";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Bounds {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    part: BaseAt,
    /// How numbers are printed
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
}

impl Bounds {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        scene.check_touching()?;
        let selection = self.part.selection(&pile)?;
        self.output.format()?;
        let progress = Progress::begin("bounds of bottom spheres");
        let table = table::bounds(&pile, selection).map_err(|error| narrower(error, selection))?;
        self.output.write_table(table, self.number, &progress)?;
        Ok(true)
    }
}
