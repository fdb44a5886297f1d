//! `response`: the forces that a unit load on one sphere causes.

use clap::Args;

use crate::args::{ExplainOption, Number, Output, SceneOptions, parse_site};
use crate::output::Failure;
use crate::progress::Progress;
use crate::tables::{self, Work};

const HELP: &str = "\
The response does not depend on the weight of the spheres, on --load or on --tilt. Forces are linear in the loads, so three
numbers a contact give its response to every load (W,X,Y): W down + X x + Y y.

Columns:
  k, i, j     upper sphere of a contact, or bottom sphere
  direction   alpha, beta or gamma: force of this contact, in mg/(3cosθ);
              normal, shear_x or shear_y: force of the bottom sphere on the floor, in mg, mg·tanθ and √3·mg·tanθ
  down        force for a load of 1 mg downwards
  x           force for a load of 1 mg·tanθ along x
  y           force for a load of 1 √3·mg·tanθ along y (2cosφ·mg·tanθ with --sin-phi)
Contacts without a response are listed too. A negative number is a loss of compression.

Examples:
  cannonpile response --layers 4 --at 0,0,0
  cannonpile response --stacking hcp --layers 6 --at 1,0,0 --output response.csv";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Response {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// Loaded sphere: K,I,J with k from 0 at the top, or I,J on the base (discs: K,I or I)
    #[arg(long, value_name = "K,I,J", allow_hyphen_values = true)]
    at: String,
    /// Format of numbers
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    explain: ExplainOption,
}

impl Response {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (_, pile) = self.scene.read()?;
        let Some(site) = parse_site(Some(&self.at), &pile)? else {
            return Ok(true);
        };
        self.output.format()?;
        let pile = pile.bare();
        let table = tables::response(&pile, site)?;
        let rows = table.row_count().and_then(|rows| rows.try_into().ok());
        let progress = Progress::of_rows("the response to a load", rows);
        self.output.write_table(table, self.number, &progress)?;
        drop(progress);
        self.explain.print(|| {
            Ok(Work::of_whole(
                &pile,
                "the load may reach every sphere below",
            ))
        })?;
        Ok(true)
    }
}
