//! `bounds`: what bottom spheres can bear with horizontal contacts.

use std::iter::once;
use std::path::{Path, PathBuf};

use cannonpile::shape::Selection;
use cannonpile_horizontal::certificate::write_certificates;
use cannonpile_horizontal::{NormalBounds, bounds};
use clap::Args;

use crate::args::{BaseAt, Number, Output, SceneOptions, narrower};
use crate::output::{Failure, write_to};
use crate::progress::Progress;
use crate::tables;

const HELP: &str = "\
At a = R neighbours of a layer touch, and the forces are no longer unique. Columns: i, j; normal_min and normal_max, the
least and the greatest normal force in mg that forces can give which balance the pile and only push; proved, 'yes' if both
are attained, else no forces pass them. Answers are formulas proved for all L, of straight piles, or were checked exactly.

Examples:
  cannonpile bounds --layers 10
  cannonpile bounds --stacking=++-+ --at=0,1 --certificate both.json
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
    /// Write the proofs of both bounds to this file, for the command check; with --at
    #[arg(long, value_name = "FILE", help_heading = "Output", requires = "at")]
    certificate: Option<PathBuf>,
}

impl Bounds {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read_whole()?;
        scene.check_touching()?;
        let selection = self.part.selection(&pile)?;
        self.output.format()?;
        let progress = Progress::begin("bounds of bottom spheres");
        let table = match (&self.certificate, selection) {
            (Some(file), Selection::One(site)) => {
                let found = bounds(&pile, site)?;
                write_proofs(&found, file)?;
                tables::bounds_of(&pile, once(Ok((site, found))))
            }
            _ => tables::bounds(&pile, selection).map_err(|error| narrower(error, selection))?,
        };
        self.output.write_table(table, self.number, &progress)?;
        Ok(true)
    }
}

fn write_proofs(bounds: &NormalBounds, file: &Path) -> Result<(), Failure> {
    let both = [&bounds.least, &bounds.greatest].map(|bound| bound.certificate.clone());
    let both: Option<Vec<_>> = both.into_iter().collect();
    let both = both.ok_or_else(|| {
        Failure::Message(
            "--certificate: these bounds are formulas proved for all L, and a file for this pile would be too long: leave it \
             out, or use fewer layers"
                .to_owned(),
        )
    })?;
    write_to("certificate", Some(file), |mut out| {
        Ok(write_certificates(&both, &mut out)?)
    })
}
