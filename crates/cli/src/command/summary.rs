//! `summary`: the pile in one row.

use std::path::PathBuf;

use cannonpile::Verdict;
use cannonpile::geometry::LayerGap;
use cannonpile_dem::table;
use cannonpile_horizontal::certificate::write_certificate;
use cannonpile_horizontal::equilibrium;
use clap::Args;

use crate::args::{Numbers, Output, SceneOptions};
use crate::output::{Failure, complain, write_to};
use crate::progress::Progress;

const HELP: &str = "\
stands is 'no' if a contact would have to pull. Where spheres touch besides, at --spacing, 'touching' says where they are:
if they are neighbours of a layer, a = R, stands says whether the pile is held with them, and min_contact is without; if
they are others, which may hold the pile, it is 'undetermined'. Exit status 1 unless it stands. A force that would take too
long to find is shown as -, and a note says why. With --units si forces are in N, for R = 1 m, m = 1 kg and g = 1 m/s²
unless these are given.

Examples:
  cannonpile summary --stacking hcp --layers 7
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
    /// Write the proof that the pile stands at a = R, or cannot, to this file, for the command check
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    certificate: Option<PathBuf>,
}

impl Summary {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let (scene, pile) = self.scene.read()?;
        self.output.format()?;
        let units = self.numbers.units.of(&scene, &pile)?;
        // At the default spacing, where none is given: if that fits.
        let touching = pile.clearance().check(&scene.spacing()?);
        if self.certificate.is_some() && touching.as_deref() != Ok(&[LayerGap { layers: 0 }]) {
            return Err(Failure::Message(
                "--certificate: a proof is about horizontal contacts, and the row would not be: give --spacing 1, a = R"
                    .to_owned(),
            ));
        }
        let progress = Progress::begin("finding the extreme forces");
        let summary = table::Summary::new(&units, touching.clone().ok())?;
        if let Some(file) = &self.certificate {
            let known = summary.certificate().cloned();
            let certificate = known.map_or_else(|| equilibrium(&pile), Ok)?;
            write_to("certificate", Some(file), |mut out| {
                Ok(write_certificate(&certificate, &mut out)?)
            })?;
        }
        let table = summary.table();
        self.output
            .write_table(table, self.numbers.number, &progress)?;
        drop(progress);
        let touching = touching.err().map(|error| ("touching", error.to_string()));
        for (columns, reason) in summary.left_out().into_iter().chain(touching) {
            complain(&format!("note: no {columns}: {reason}"));
        }
        Ok(matches!(summary.verdict(), None | Some(Verdict::Yes)))
    }
}
