//! `bounds`: the range of each base normal force, with horizontal contacts.

use std::io::Write;
use std::iter::once;
use std::path::PathBuf;

use cannonpile::shape::Selection;
use cannonpile_horizontal::certificate::{Certificate, write_certificates};
use cannonpile_horizontal::{NormalBounds, bounds};
use clap::Args;

use super::write_accepted;
use crate::args::{BasePart, ExplainOption, Number, Output, SceneOptions, with_row_options};
use crate::output::Failure;
use crate::progress::Progress;
use crate::tables::{self, Work};

const HELP: &str = "\
At a = R neighbours in a layer touch, and the contact forces are no longer unique. All compressive forces in equilibrium
give a range of base normal forces.

Columns:
  i, j                    bottom sphere
  normal_min, normal_max  ends of the range, in mg
  proved                  yes: both ends are attained; no: they are certified outer bounds

For straight piles the bounds are formulas, proved for every L. For other piles an exact certificate proves each bound.

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
    part: BasePart,
    /// Format of numbers
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    explain: ExplainOption,
    /// File for the certificates of both bounds, which the command check reads; requires --at
    #[arg(long, value_name = "FILE", help_heading = "Output", requires = "at")]
    certificate: Option<PathBuf>,
}

impl Bounds {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read_whole()?;
        scene.check_touching()?;
        let selection = self.part.selection(&pile)?;
        self.output.format()?;
        let progress = Progress::begin("computing the bounds");
        if let (Some(file), Selection::One(site)) = (&self.certificate, selection) {
            let found = bounds(&pile, site)?;
            let proofs = proofs(&found)?;
            let table = tables::bounds_of(&pile, once(Ok((site, found))));
            let format = self.output.format()?;
            let content = |out: &mut dyn Write| table.write(format.into(), self.number.into(), out);
            self.output.write_with(&progress, content, None, || {
                write_accepted(file, |out| write_certificates(&proofs, out))
            })?;
        } else {
            let table = tables::bounds(&pile, selection)
                .map_err(|error| with_row_options(error, selection))?;
            self.output.write_table(table, self.number, &progress)?;
        }
        drop(progress);
        let reason = "horizontal contacts couple all forces";
        self.explain.print(|| Ok(Work::of_whole(&pile, reason)))?;
        Ok(true)
    }
}

/// Returns the certificates of both bounds.
fn proofs(bounds: &NormalBounds) -> Result<Vec<Certificate>, Failure> {
    let both = [&bounds.least, &bounds.greatest].map(|bound| bound.certificate.clone());
    let both: Option<Vec<_>> = both.into_iter().collect();
    both.ok_or_else(|| {
        Failure::Message(
            "--certificate: the certificate of this pile would be too large (the bounds of straight piles are proved for \
             every L): leave it out, or use fewer layers"
                .to_owned(),
        )
    })
}
