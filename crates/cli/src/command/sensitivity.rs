//! `sensitivity`: the changes of the contact forces if spheres are unequal.

use clap::Args;

use super::instability;
use crate::args::{ExplainOption, Number, Output, SceneOptions, parse_site};
use crate::output::{Failure, print_message};
use crate::progress::Progress;
use crate::tables::{self, Work};

const HELP: &str = "\
Real spheres differ in size. Let the radius of the sphere at --at be R(1 + δ) for a small δ. The spheres above it move, the
directions of contacts turn, and every contact force changes by δ times its change. All weights and loads stay as they are,
and so do the centres of the bottom spheres.

Columns of --at, a row for each contact:
  k, i, j, direction  upper sphere and direction of the contact
  force               force among equal spheres, in mg/(3cosθ)
  change              change of the force per relative growth δ, exact to first order in δ, in the same unit
Columns of --spread, one row:
  k, i, j, direction  contact that opens first if all radii deviate independently with the relative standard deviation r
  force               force among equal spheres
  force_deviation     standard deviation of this force, divided by r
  radius_deviation    r at which this force is three standard deviations above zero: force/(3·force_deviation)

If the spheres vary by radius_deviation or more, some contacts probably open, and the forces are others. The answer is without
the contacts of further spheres that touch at --spacing, such as neighbours in a layer at a = R. An unstable pile has no
spread, and the exit status is 1.

Examples:
  cannonpile sensitivity --layers 4 --at 3,0,0
  cannonpile sensitivity --layers 6 --spread --number f64";

#[derive(Args)]
#[command(after_help = HELP)]
#[group(id = "question", args = ["at", "spread"], required = true, multiple = false)]
pub(crate) struct Sensitivity {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// Larger sphere: K,I,J with k from 0 at the top, or I,J on the base (discs: K,I or I)
    #[arg(long, value_name = "K,I,J", allow_hyphen_values = true)]
    at: Option<String>,
    /// Find the contact that opens first if all radii deviate, and the deviation at which it does
    #[arg(long)]
    spread: bool,
    /// Format of numbers
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    explain: ExplainOption,
}

const NO_CHANGE: &str =
    "no radius changes a contact force: use two or more layers, and give the pile weight or loads";

const FURTHER_CONTACTS: &str = "note: further spheres touch at this spacing, and a larger sphere may push them apart: this answer is without their contacts";

impl Sensitivity {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        let site = parse_site(self.at.as_deref(), &pile)?;
        self.output.format()?;
        let packing = scene.packing(&pile)?;
        let progress = Progress::begin("computing the changes of the forces");
        let table = match site {
            Some(site) => {
                tables::sensitivity(&pile, cannonpile_stability::sensitivity(&packing, site)?)
            }
            None => match cannonpile_stability::spread(&packing)? {
                Some(spread) => tables::spread(&pile, spread),
                None if pile.first_failure()?.is_some() => {
                    drop(progress);
                    print_message(&format!("no spread: {}", instability(&pile, "")));
                    return Ok(false);
                }
                None => return Err(Failure::Message(NO_CHANGE.to_owned())),
            },
        };
        self.output.write_table(table, self.number, &progress)?;
        drop(progress);
        self.explain.print(|| {
            Ok(Work::of_whole(
                &pile,
                "a radius moves all spheres above, and changes forces below too",
            ))
        })?;
        if !packing.touching().is_empty() {
            print_message(FURTHER_CONTACTS);
        }
        Ok(true)
    }
}
