//! `check`: a certificate, checked anew.

use core::fmt::Display;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use cannonpile_horizontal::certificate::{Certificate, Refusal, read_certificates};
use clap::Args;

use crate::output::{A_FILE_OR_STDIN, Failure, unreadable, write_to};
use crate::progress::Progress;

const HELP: &str = "\
A certificate says what a pile bears at a = R, where the spheres of a layer touch, and has all that is needed to check it:
forces of horizontal contacts, in mg/(3 cosθ), a field with three numbers for each sphere above the floor, or both. It is
accepted if these forces and those that balance them push, and the field proves that no others do better; if it is refused,
the exit status is 1, and the first equation that does not hold is named. The equations are in the documentation of the
module 'certificate'; crates/horizontal/check_certificate.py is another program that checks them.

  {
    \"pile\": {\"dimension\": 3, \"sin_phi\": \"1/2\", \"stacking\": \"++\", \"anchor\": {\"top\": \"hexagon:1\"},
             \"weightless\": false, \"weights\": [], \"loads\": []},
    \"claim\": {\"greatest\": {\"site\": {\"i\": 0, \"j\": 0, \"k\": 2}, \"normal\": \"7/3\", \"attained\": true}},
    \"horizontal\": [{\"site\": {\"i\": 0, \"j\": 0, \"k\": 1}, \"axis\": \"alpha-beta\", \"force\": \"1\"},
                   {\"site\": {\"i\": 0, \"j\": 0, \"k\": 1}, \"axis\": \"alpha-gamma\", \"force\": \"1\"}],
    \"field\": [{\"site\": {\"i\": 0, \"j\": 0, \"k\": 0}, \"alpha\": \"1\", \"beta\": \"0\", \"gamma\": \"0\"},
              {\"site\": {\"i\": 0, \"j\": 0, \"k\": 1}, \"alpha\": \"1\", \"beta\": \"1\", \"gamma\": \"1\"}]
  }

The claim is \"stands\", \"cannot-stand\", {\"least\": …}, {\"greatest\": …} or {\"elastic\": {\"stiffness_ratio\": \"1\"}}.

Examples:
  cannonpile check certificate.json
  cannonpile check - < certificate.json";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Check {
    /// A certificate, or an array of them, as JSON; - for stdin
    #[arg(value_name = "FILE")]
    certificate: PathBuf,
}

impl Check {
    /// Checks, and returns whether all certificates are accepted.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let progress = Progress::begin("reading FILE");
        let certificates = self.read().map_err(|error| self.unread(&error))?;
        drop(progress);
        let mut all = true;
        for certificate in certificates {
            all &= self.judge(&certificate)?;
        }
        Ok(all)
    }

    /// Says what is claimed, and whether it is accepted.
    fn judge(&self, certificate: &Certificate) -> Result<bool, Failure> {
        let progress = Progress::begin("checking");
        let checked = certificate.check();
        drop(progress);
        let verdict = match &checked {
            Ok(()) => "accepted".to_owned(),
            Err(refusal) => match &**refusal {
                Refusal::Pile(error) => return Err(self.refused(error)),
                equation => format!("refused: {equation}"),
            },
        };
        let Certificate { pile, claim, .. } = certificate;
        let (spheres, layers) = (pile.sphere_count(), pile.layers());
        let name = pile.shape().stacking().name();
        let stacking = name.map_or_else(|| pile.shape().stacking().to_string(), str::to_owned);
        write_to("output", None, |out| {
            writeln!(
                out,
                "claimed of {spheres} spheres in {layers} layers, {stacking}: {claim}"
            )?;
            Ok(writeln!(out, "{verdict}")?)
        })?;
        Ok(checked.is_ok())
    }

    fn read(&self) -> io::Result<Vec<Certificate>> {
        if self.certificate == Path::new("-") {
            read_certificates(io::stdin().lock())
        } else {
            read_certificates(File::open(&self.certificate)?)
        }
    }

    fn name(&self) -> String {
        if self.certificate == Path::new("-") {
            "stdin".into()
        } else {
            self.certificate.display().to_string()
        }
    }

    /// Says why there is no certificate to check.
    fn unread(&self, error: &io::Error) -> Failure {
        let name = self.name();
        Failure::Message(match error.kind() {
            io::ErrorKind::FileTooLarge => format!("FILE: {name}: {error}"),
            io::ErrorKind::InvalidData | io::ErrorKind::UnexpectedEof => {
                format!(
                    "FILE: {name} is no certificate: {error}; 'cannonpile check --help' shows one"
                )
            }
            _ => return unreadable(name, error, A_FILE_OR_STDIN),
        })
    }

    /// Says why the pile is not asked.
    fn refused(&self, error: &impl Display) -> Failure {
        Failure::Message(format!("FILE: {}: {error}", self.name()))
    }
}
