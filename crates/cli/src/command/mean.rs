//! `mean`: base forces, averaged over random stackings.

use cannonpile::scalar::Algebra;
use cannonpile_dem::table::{NumberFormat, Table};
use cannonpile_disorder::{FirstSign, RandomPiles};
use clap::{Args, ValueEnum};
use num_rational::BigRational;

use super::{TensionCheck, fault_probability};
use crate::args::{Output, SceneOptions};
use crate::output::{Failure, print_message};
use crate::progress::Progress;
use crate::tables;

const HELP: &str = "\
The first sign of a stacking is --first. Each later sign differs from the one before with the fault probability q: q = 0
gives FCC, q = 1 gives HCP, and with q = 1/2 all stackings are equally likely.

The mean is over all stackings, unstable ones included. Their tensile forces need a prestressed pile: one that is glued, or
compressed by larger forces. A negative normal force occurs in prestressed piles only.

Columns, a row for each position of the bottom layer where some stacking has a sphere. With --top plane only positions that
a load reaches have rows:
  a, b         horizontal position a u_beta + b u_gamma, from the sphere (0,0) of the top layer (with --base: of the base);
               u_beta and u_gamma are the horizontal parts of the contact directions beta and gamma below a + step. Their
               length is 2R sin(theta), and their angle is 120 degrees
  probability  probability of a sphere at this position
  normal       mean base normal force, in mg, with the weight of the sphere. A stacking without a sphere at this position
               counts as 0; with --given sphere it does not count
  shear_x      mean shear force along x, in mg tan(theta)
  shear_y      mean shear force along y, in sqrt(3) mg tan(theta)
The sphere (i,j) of a layer, s net + steps further down, is at a = 2i + j - s, b = i + 2j - s. So a layer has spheres only
at positions with s = a + b modulo 3.

Columns of --by faults:
  faults       number d of faults (sign changes)
  stackings    number of stackings with d faults and a sphere at this position
  normal       sum of the base normal force over these stackings. The mean is the sum over d of normal q^d (1-q)^(L-2-d);
               half of it with --first random

With --base a stacking that the base cannot support up to L layers counts as one without spheres.
The time grows like L^3 for floats, and faster for exact numbers. It has another factor of L with --symbolic, with --by
faults, and with --base.

Examples:
  cannonpile mean --top plane --weightless --load 0,0,0=1 --layers 5 --symbolic
  cannonpile mean --layers 7 --fault-probability 1/3
  cannonpile mean --layers 81 --number f64 --top plane --weightless --load 0,0,0=1 --given sphere --output mean.csv
  cannonpile mean --base hexagon:4 --layers 4 --first random --by faults";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Mean {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    /// Sign of the first step, below the top layer: +, - or random (probability 1/2 each)
    #[arg(long, value_name = "SIGN", default_value = "+", allow_hyphen_values = true, value_parser = str::parse::<FirstSign>, help_heading = "Random stackings")]
    first: FirstSign,
    /// Probability q that a sign differs from the one before, 0 to 1 [default: 1/2]
    #[arg(long, value_name = "Q", allow_hyphen_values = true, value_parser = fault_probability, conflicts_with_all = ["symbolic", "by"], help_heading = "Random stackings")]
    fault_probability: Option<BigRational>,
    /// Print polynomials in q, valid for every fault probability
    #[arg(long, conflicts_with = "by", help_heading = "Random stackings")]
    symbolic: bool,
    /// Print sums over stackings, grouped by this number
    #[arg(
        long,
        value_enum,
        value_name = "WHAT",
        help_heading = "Random stackings"
    )]
    by: Option<By>,
    /// Average only over stackings with this property
    #[arg(long, value_enum, value_name = "WHAT", conflicts_with_all = ["symbolic", "by"], help_heading = "Random stackings")]
    given: Option<Given>,
    /// Format of numbers, in computation and output
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
}

#[derive(Clone, Copy, ValueEnum)]
enum By {
    /// Number of faults (sign changes)
    Faults,
}

#[derive(Clone, Copy, ValueEnum)]
enum Given {
    /// A sphere at the position
    Sphere,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Number {
    /// Rationals: 7/3
    Exact,
    /// Double-precision floats with about 15 correct digits; with --by faults correctly rounded
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
        let piles = self.scene.read_random(self.first)?;
        self.output.format()?;
        let progress = Progress::begin("averaging over stackings");
        let tension = TensionCheck::in_column("normal");
        let write = |table: Table<'_>| {
            let watched = tension.watch(table);
            self.output.write_table(watched, self.number, &progress)
        };
        if self.by.is_some() {
            write(tables::by_faults(&piles.by_faults()?))?;
        } else {
            write(self.table(&piles, &tension)?)?;
        }
        drop(progress);
        if tension.seen.get() {
            print_message(
                "note: the mean is over all stackings, unstable ones included; a negative normal force occurs in prestressed \
                 or glued piles only",
            );
        }
        Ok(true)
    }

    /// Returns the table of means. Polynomials show no sign, so their coefficients by number of faults are looked at here.
    fn table(
        &self,
        piles: &RandomPiles,
        tension: &TensionCheck,
    ) -> Result<Table<'static>, Failure> {
        if self.symbolic {
            if self.number == Number::F64 {
                return Err(Failure::Message(
                    "--number f64: polynomials always have exact coefficients: leave it out, or use --fault-probability".to_owned(),
                ));
            }
            let by_faults = piles.by_faults()?;
            for row in by_faults.rows() {
                tension.find(&row?.normal);
            }
            let polynomials = by_faults.polynomial()?;
            return Ok(tables::mean_of_polynomials(polynomials));
        }
        let half = || BigRational::new(1.into(), 2.into());
        let q = self.fault_probability.clone().unwrap_or_else(half);
        let given = self.given.is_some();
        Ok(match self.number {
            Number::Exact => {
                let mean = piles.exact(&q)?;
                tables::mean(if given { mean.given_sphere() } else { mean }, given)
            }
            Number::F64 => {
                let q = f64::from_rational(&q);
                let mean = piles.mean(&q)?;
                tables::mean(if given { mean.given_sphere() } else { mean }, given)
            }
        })
    }
}
