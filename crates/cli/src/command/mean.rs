//! `mean`: what the base bears in the mean over random stackings.

use cannonpile::scalar::Algebra;
use cannonpile_dem::table::{NumberFormat, Table};
use cannonpile_disorder::RandomPiles;
use clap::{Args, ValueEnum};
use num_rational::BigRational;

use super::fault_probability;
use crate::args::{Output, PilesOfStackings};
use crate::output::{Failure, complain};
use crate::progress::Progress;
use crate::tables;

const HELP: &str = "\
Of the L - 1 steps from layer to layer the first has the sign of --first; each later one differs from the one before with
the fault probability q, independently: q = 0 is FCC, q = 1 is HCP, and at q = 1/2 all stackings are equally likely. The mean
is over all of them, those included that cannot stand. So it is that of prestressed piles, whose contacts can pull because
they are glued, or pressed together by more than these forces; a negative normal is of such piles alone.

Columns, a row for each place of the bottom layer where some stacking has a sphere (in the plane: within reach of a load):
  a, b         the place a u_beta + b u_gamma, from that of the sphere (0,0) of the top layer (with --base: of the base); u_beta
               and u_gamma are the horizontal parts of the contacts beta and gamma below a + step, at 120 degrees, of the length
               2R sin(theta). The sphere (i,j) of a layer, s net + steps further down, is at a = 2i + j - s, b = i + 2j - s: a
               place has a sphere only in layers with s = a + b modulo 3
  probability  that a sphere is there
  normal       mean normal force on the floor in mg, its own weight included; a stacking without a sphere there counts as 0,
               with --given sphere it does not count
  shear_x      mean shear in mg tan(theta) along x, and
  shear_y      in sqrt(3) mg tan(theta) along y, as in the command base
With --by faults: faults, the number d of changes of sign; stackings, how many of those with d faults have a sphere there;
normal, the sum over these. The mean is the sum of normal q^d (1-q)^(L-2-d) over d, half that if the first sign is random.

With --base a stacking that the base does not carry to L layers counts as one without spheres.
The time grows like L^3 (exact numbers, also longer), with --symbolic and --by faults like L^4, with --base like one power more.

Examples:
  cannonpile mean --top plane --weightless --load 0,0,0=1 --layers 5 --symbolic
  cannonpile mean --layers 7 --fault-probability 1/3
  cannonpile mean --layers 81 --number f64 --top plane --weightless --load 0,0,0=1 --given sphere --output mean.csv
  cannonpile mean --base hexagon:4 --layers 4 --first random --by faults";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Mean {
    #[command(flatten)]
    scene: PilesOfStackings,
    /// The probability q that the sign changes, between 0 and 1 [default: 1/2]
    #[arg(long, value_name = "Q", allow_hyphen_values = true, value_parser = fault_probability, conflicts_with_all = ["symbolic", "by"], help_heading = "Random stackings")]
    fault_probability: Option<BigRational>,
    /// Polynomials in q, for every fault probability
    #[arg(long, conflicts_with = "by", help_heading = "Random stackings")]
    symbolic: bool,
    /// By the number of faults: sums over the stackings with so many
    #[arg(
        long,
        value_enum,
        value_name = "WHAT",
        help_heading = "Random stackings"
    )]
    by: Option<By>,
    /// Means over those stackings alone that have a sphere at the place
    #[arg(long, value_enum, value_name = "WHAT", conflicts_with_all = ["symbolic", "by"], help_heading = "Random stackings")]
    given: Option<Given>,
    /// How numbers are found and printed
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, ValueEnum)]
enum By {
    /// Changes of sign
    Faults,
}

#[derive(Clone, Copy, ValueEnum)]
enum Given {
    /// That a sphere is there
    Sphere,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Number {
    /// Rationals: 7/3
    Exact,
    /// Double-precision floats, to some 15 digits; with --by faults the nearest
    F64,
}

impl From<Number> for NumberFormat {
    fn from(number: Number) -> Self {
        match number {
            Number::Exact => Self::Exact,
            Number::F64 => Self::F64,
        }
    }
}

impl Mean {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let piles = self.scene.read()?;
        self.output.format()?;
        let progress = Progress::begin("adding up stackings");
        if self.by.is_some() {
            let by_faults = piles
                .by_faults()
                .map_err(|error| self.scene.refused(error))?;
            self.write(tables::by_faults(&by_faults), &progress)?;
        } else {
            self.write(self.table(&piles)?, &progress)?;
        }
        drop(progress);
        complain(
            "note: this is over all stackings, those that cannot stand included; where a normal is negative it is that of \
             prestressed piles alone, glued or pressed together",
        );
        Ok(true)
    }

    fn write(&self, table: Table<'_>, progress: &Progress) -> Result<(), Failure> {
        self.output.write_table(table, self.number, progress)
    }

    fn table(&self, piles: &RandomPiles) -> Result<Table<'static>, Failure> {
        let refused = |error: cannonpile_disorder::Error| self.scene.refused(error);
        if self.symbolic {
            if self.number == Number::F64 {
                return Err(Failure::Message(
                    "--number f64: polynomials have exact coefficients: leave it out, or use --fault-probability".to_owned(),
                ));
            }
            let polynomials = piles
                .by_faults()
                .and_then(|by_faults| by_faults.polynomial());
            return Ok(tables::mean_of_polynomials(polynomials.map_err(refused)?));
        }
        let half = || BigRational::new(1.into(), 2.into());
        let q = self.fault_probability.clone().unwrap_or_else(half);
        let given = self.given.is_some();
        Ok(match self.number {
            Number::Exact => {
                let mean = piles.exact(&q).map_err(refused)?;
                tables::mean(if given { mean.given_sphere() } else { mean }, given)
            }
            Number::F64 => {
                let q = f64::from_rational(&q);
                let mean = piles.mean(&q).map_err(refused)?;
                tables::mean(if given { mean.given_sphere() } else { mean }, given)
            }
        })
    }
}
