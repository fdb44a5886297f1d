//! `check`: verifies a certificate.

use core::fmt::Display;
use std::io;
use std::path::PathBuf;

use cannonpile_horizontal::certificate::{Certificate, Refusal, read_certificates};
use clap::Args;

use crate::input::{Input, name_of};
use crate::output::{Failure, READABLE_FILE_OR_STDIN, unusable, write_to};
use crate::progress::Progress;

const HELP: &str = "\
A certificate claims a property of a pile at a = R, where the spheres of a layer touch, and contains its proof: the forces
of the horizontal contacts in mg/(3cosθ), a virtual displacement field with three numbers for each sphere above the floor,
or both. The check accepts the claim if all contact forces are compressive and the field proves that the claim is optimal.
If it rejects the claim, it prints the first violated equation, and the exit status is 1. The documentation of the module
'certificate' lists the equations. A second checker is crates/horizontal/check_certificate.py, and a third one is proved by
Coq: crates/proof/checker.

  {
    \"pile\": {\"dimension\": 3, \"sin_phi\": \"1/2\", \"stacking\": \"++\", \"anchor\": {\"top\": \"hexagon:1\"},
             \"weightless\": false, \"weights\": [], \"loads\": []},
    \"claim\": {\"greatest\": {\"site\": {\"i\": 0, \"j\": 0, \"k\": 2}, \"normal\": \"7/3\", \"attained\": true}},
    \"horizontal\": [{\"site\": {\"i\": 0, \"j\": 0, \"k\": 1}, \"axis\": \"alpha-beta\", \"force\": \"1\"},
                   {\"site\": {\"i\": 0, \"j\": 0, \"k\": 1}, \"axis\": \"alpha-gamma\", \"force\": \"1\"}],
    \"field\": [{\"site\": {\"i\": 0, \"j\": 0, \"k\": 0}, \"alpha\": \"1\", \"beta\": \"0\", \"gamma\": \"0\"},
              {\"site\": {\"i\": 0, \"j\": 0, \"k\": 1}, \"alpha\": \"1\", \"beta\": \"1\", \"gamma\": \"1\"}]
  }

The claim is \"stands\", \"cannot-stand\", {\"least\": …}, {\"greatest\": …}, {\"elastic\": {\"stiffness_ratio\": \"1\"}}, or
{\"forces\": …} with all forces of any pile.

Examples:
  cannonpile check certificate.json
  cannonpile check - < certificate.json";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Check {
    /// Certificate, or array of certificates, as JSON; - for stdin
    #[arg(value_name = "FILE")]
    certificate: PathBuf,
}

impl Check {
    /// Checks the certificates and returns whether all are accepted.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let progress = Progress::begin("reading the certificate");
        let certificates = Input::open(&self.certificate, false).and_then(read_certificates);
        let certificates = certificates.map_err(|error| self.unreadable_certificate(&error))?;
        drop(progress);
        let mut all = true;
        for certificate in certificates {
            all &= self.judge(&certificate)?;
        }
        Ok(all)
    }

    /// Prints the claim and the verdict.
    fn judge(&self, certificate: &Certificate) -> Result<bool, Failure> {
        let progress = Progress::begin("checking");
        let checked = certificate.check();
        drop(progress);
        let verdict = match &checked {
            Ok(()) => "accepted".to_owned(),
            Err(Refusal::Pile(error)) => return Err(self.refused(error)),
            Err(violated) => format!("refused: {violated}"),
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

    /// Returns the reason why the file contains no certificate.
    fn unreadable_certificate(&self, error: &io::Error) -> Failure {
        let expected = ["a certificate", "'cannonpile check --help' shows one"];
        unusable(
            name_of(&self.certificate),
            error,
            expected,
            READABLE_FILE_OR_STDIN,
        )
    }

    /// Returns the reason why the pile of a certificate is invalid.
    fn refused(&self, error: &impl Display) -> Failure {
        Failure::Message(format!("{}: {error}", name_of(&self.certificate)))
    }
}
