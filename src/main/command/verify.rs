//! `verify`: measured forces against the exact ones.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

use cannonpile::Packing;
use cannonpile::scene::Scene;
use cannonpile::verify::{self, Reading, Refusal, Report};
use clap::Args;

use super::note_if_it_falls;
use crate::args::{Output, SceneOptions};
use crate::output::{Failure, complain, reason};
use crate::progress::Progress;

const HELP: &str = "\
Errors are relative to the exact force of the contact; where that is 0, to the largest exact force. Pairs that are no
contact are extra, or noise if their force is below --accept times the largest; pairs of bottom spheres are fixed, and not
judged.

Examples:
  cannonpile verify pile/forces.dump --layers 10 --spacing 1.2
  cannonpile verify measured.csv --scene pile.toml --accept 1e-3";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Verify {
    /// A csv table with columns id1, id2, force, and fx, fy, fz if there are vectors; or a LAMMPS dump local file with these
    /// columns, of which the last snapshot counts; - for stdin
    #[arg(value_name = "FILE")]
    measured: PathBuf,
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// The greatest relative error accepted; 0 for forces that are the nearest floats
    #[arg(long, value_name = "E", default_value = "1e-6", allow_hyphen_values = true, value_parser = tolerance, help_heading = "Output")]
    accept: f64,
    #[command(flatten)]
    output: Output,
}

impl Verify {
    /// Compares, and returns whether the file is accepted.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        if self.measured == Path::new("-") && self.scene.is_from_stdin() {
            let reason = "FILE and --scene are both -: only one of them can come from stdin, name a file for the other";
            return Err(Failure::Message(reason.into()));
        }
        let (scene, pile) = self.scene.read_state()?;
        let packing = scene.packing(&pile)?;
        let format = self.output.format()?;
        let refused = |refusal| self.refused(refusal, &scene);
        let progress = Progress::begin("reading FILE");
        let reading = self.read(&packing).map_err(refused)?;
        drop(progress);
        let progress = Progress::begin("comparing with the exact forces");
        let comparison = reading.compare(&packing).map_err(refused)?;
        let report = Report::new(&comparison, self.accept);
        self.output
            .write(&progress, |out| report.write(format.into(), out))?;
        drop(progress);
        if reading.snapshots() > 1 {
            complain(&format!("note: {}", self.judged(&reading)));
        }
        note_if_it_falls(&pile);
        Ok(comparison.accepted(self.accept))
    }
}

impl Verify {
    fn read(&self, packing: &Packing<'_>) -> Result<Reading, Refusal> {
        if self.measured == Path::new("-") {
            verify::read_for(packing, io::stdin().lock())
        } else {
            verify::read_for(packing, BufReader::new(File::open(&self.measured)?))
        }
    }

    fn name(&self) -> String {
        if self.measured == Path::new("-") {
            "stdin".into()
        } else {
            self.measured.display().to_string()
        }
    }

    fn refused(&self, refusal: Refusal, scene: &Scene) -> Failure {
        let name = self.name();
        Failure::Message(match refusal {
            Refusal::Scene(error) => return error.into(),
            Refusal::OutOfRange => format!("{}: {refusal}", self.scene.place_of_size(scene)),
            Refusal::Io(error) => format!(
                "FILE: {name} cannot be read: {}; name a file that is there, or - for stdin",
                reason(&error)
            ),
            refusal => format!("FILE: {name}, {refusal}"),
        })
    }

    fn judged(&self, reading: &Reading) -> String {
        let (name, snapshots) = (self.name(), reading.snapshots());
        let step = reading
            .timestep()
            .map(|step| format!(", of time step {step},"))
            .unwrap_or_default();
        format!("{name} has {snapshots} snapshots; the last{step} is judged")
    }
}

/// An accepted error.
fn tolerance(text: &str) -> Result<f64, String> {
    let given = text.parse::<f64>().ok();
    // Not -0 either: it would be shown.
    let given = given.filter(|error| error.is_finite() && error.is_sign_positive());
    given.ok_or_else(|| "not a relative error such as 1e-6, or 0".to_owned())
}
