//! `summary`: one pile in one row.

use std::path::PathBuf;

use cannonpile::geometry::LayerGap;
use cannonpile::{Pile, Verdict};
use cannonpile_dem::scene::{Floor, Scene};
use cannonpile_dem::table;
use cannonpile_horizontal::certificate::write_certificate;
use cannonpile_horizontal::equilibrium;
use clap::Args;

use super::{CERTIFICATE_ON_ROUGH_FLOOR, write_accepted};
use crate::args::{ExplainOption, Numbers, Output, SceneOptions};
use crate::output::{Failure, print_message};
use crate::progress::Progress;
use crate::tables::Work;

const HELP: &str = "\
Columns:
  layers, stacking           number of layers; Hägg signs or name of the stacking
  spheres, contacts, weight  of the whole pile; the weight in mg
  stands                     yes: stable; no: some contact needs tension; undetermined: further contacts may support the pile
  min_contact                smallest force between layers, in mg/(3cosθ), without horizontal contacts
  base_spheres               number of bottom spheres
  normal_min, normal_max     range of the base normal forces, in mg
  max_shear_ratio            largest ratio of shear to normal force at the base, as magnitudes, in tanθ; empty if a bottom
                             sphere has a shear, but no normal force
  touching                   spheres that touch at --spacing in addition to those of adjacent layers
  plan                       method that computes the forces
  margin_squared             t_c², the square of the least tilt at which a contact opens (see stability), in tan²θ, without
                             horizontal contacts; empty if the pile needs these, is unstable, or has no weight above the floor

At a = R neighbours in a layer touch, and stands takes these horizontal contacts into account. The exit status is 1 unless
the pile is stable. The table shows - for a value that takes too long to compute, and a note gives the reason. With
--units si forces are in N, and the ratios are plain numbers. Otherwise csv and json name their units:
max_shear_ratio_over_tan_theta, margin_squared_over_tan2_theta, and friction_needed_over_tan_half_theta below.

With --floor rough the columns are layers, spheres, contacts, weight, base_spheres, normal_min, normal_max, and
  friction_needed            least coefficient of friction of a contact with a force, in tan(θ/2)
  floor_friction_needed      least coefficient of friction of the floor, in the same unit
  stands                     no if --friction or --floor-friction is less, yes if not; empty if neither is given

Examples:
  cannonpile summary --stacking hcp --layers 7
  cannonpile summary --layers 2 --floor rough --friction 0.41 --units si --number f64
  cannonpile summary --stacking=++--+ --spacing 1 --certificate c.json
  cannonpile summary --top hexagon:3 --stacking=++-+ --units si --gravity 9.81";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Summary {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    explain: ExplainOption,
    /// File for the certificate that the pile is stable or unstable at a = R, which the command check reads
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    certificate: Option<PathBuf>,
}

impl Summary {
    fn write_rough(&self, scene: &Scene, pile: &Pile) -> Result<bool, Failure> {
        if self.certificate.is_some() {
            return Err(Failure::Message(CERTIFICATE_ON_ROUGH_FLOOR.to_owned()));
        }
        let progress = Progress::begin("computing the extreme forces");
        let stands = scene.stands_with_friction(&scene.packing(pile)?)?;
        let table = table::rough_summary(&self.numbers.units.of(scene, pile)?, stands)?;
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        Ok(stands != Some(false))
    }

    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read_any()?;
        self.output.format()?;
        if scene.floor == Floor::Rough {
            return self.write_rough(&scene, &pile);
        }
        let units = self.numbers.units.of(&scene, &pile)?;
        self.scene.refuse_elastic(&scene)?;
        // The default spacing may be invalid for this pile.
        let touching = pile.clearance().check(&scene.spacing()?);
        if self.certificate.is_some() && touching.as_deref() != Ok(&[LayerGap { layers: 0 }]) {
            return Err(Failure::Message(
                "--certificate: certificates are for horizontal contacts, at a = R: add --spacing 1"
                    .to_owned(),
            ));
        }
        let progress = Progress::begin("computing the extreme forces");
        let summary = table::Summary::new(&units, touching.clone().ok())?;
        if let Some(file) = &self.certificate {
            let known = summary.certificate().cloned();
            let certificate = known.map_or_else(|| equilibrium(&pile), Ok)?;
            write_accepted(file, |out| write_certificate(&certificate, out))?;
        }
        let table = summary.table();
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        drop(progress);
        self.explain.print(|| {
            let is_straight = pile.shape().stacking().is_straight();
            Ok(
                if is_straight && pile.loads().next().is_none() && pile.weights().next().is_none() {
                    Work::of_formulas(&pile, "formulas give the extremes of a straight pile")
                } else {
                    Work::of_whole(&pile, "the extremes are over all contacts")
                },
            )
        })?;
        let touching = touching.err().map(|error| ("touching", error.to_string()));
        for (columns, reason) in summary.left_out().into_iter().chain(touching) {
            print_message(&format!("note: no {columns}: {reason}"));
        }
        Ok(matches!(summary.verdict(), None | Some(Verdict::Yes)))
    }
}
