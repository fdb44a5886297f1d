//! `verify`: measured forces against the exact ones.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

use cannonpile::Packing;
use cannonpile::verify::{self, Reading, Refusal, Report};
use clap::Args;

use crate::options::{Output, Refused, SceneOptions};
use crate::{Failure, complain, warn_if_it_falls, write};

#[derive(Args)]
pub(crate) struct Verify {
    /// A csv table with columns id1, id2, force, and fx, fy, fz if there are vectors; or a LAMMPS dump local file with these
    /// columns, of which the last snapshot counts. - for stdin
    #[arg(value_name = "FILE")]
    measured: PathBuf,
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// The greatest relative error accepted; 0 for forces that are the nearest floats
    #[arg(long, value_name = "E", default_value = "1e-6", allow_hyphen_values = true, value_parser = tolerance, help_heading = "Output")]
    accept: f64,
    #[command(flatten)]
    pub(crate) output: Output,
}

impl Verify {
    /// Compares, and tells whether the file is accepted.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        if self.measured == Path::new("-") && self.scene.is_from_stdin() {
            let reason = "FILE and --scene are both -: only one of them can come from stdin, name a file for the other";
            return Err(Failure::Told(reason.into()));
        }
        let (scene, pile) = self.scene.read()?;
        let packing = scene.packing(&pile)?;
        let reading = self
            .read(&packing)
            .map_err(|refusal| self.refused(refusal))?;
        let comparison = reading.compare(&packing);
        let comparison = comparison.map_err(|refusal| self.refused(refusal))?;
        let report = Report::new(&comparison, self.accept);
        write(&self.output, |out| {
            report.write(self.output.format.into(), out)
        })?;
        if reading.snapshots() > 1 {
            complain(&format!("note: {}", self.judged(&reading)));
        }
        warn_if_it_falls(&pile);
        Ok(comparison.accepted(self.accept))
    }

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

    fn refused(&self, refusal: Refusal) -> Failure {
        let name = self.name();
        match refusal {
            Refusal::Scene(error) => Refused::from(error).into(),
            Refusal::OutOfRange => Failure::Told(format!("--mass: {refusal}")),
            Refusal::Io(error) => Failure::Told(format!(
                "FILE: {name} cannot be read: {}; name a file that is there, or - for stdin",
                // Without the number that the system gives it.
                error.kind()
            )),
            refusal => Failure::Told(format!("FILE: {name}, {refusal}")),
        }
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
