//! `census`: which stackings stand.

use cannonpile::census::{self, Entry};
use cannonpile::lattice::Region;
use cannonpile::scene::parse;
use cannonpile::table::{self, Table};
use cannonpile::{Culprit, Error};
use clap::Args;

use crate::args::{Number, Output};
use crate::output::{Failure, Refused};
use crate::progress::Progress;

const HELP: &str = "\
Of two mirror images one is listed. A stacking that fails is listed once, at the number of layers at which it first does,
with the contact that would have to pull. With these a census of L layers has 11L − 50 rows, from six layers on, and takes
a time that grows like L³.

Examples:
  cannonpile census --layers 6
  cannonpile census --layers 1000000 --standing
  cannonpile census --base hexagon:3 --output census.csv";

#[derive(Args)]
#[command(after_help = HELP)]
pub(crate) struct Census {
    /// Number of layers, 1 to 10^36
    #[arg(long, value_name = "L", default_value = "10", allow_hyphen_values = true, value_parser = parse::layers)]
    layers: i128,
    /// Every stacking of this base, carried as high as it goes: hexagon:P,Q, hexagon:N, triangle:N or
    /// region:x0..x1,y0..y1,s0..s1
    #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = str::parse::<Region>, conflicts_with = "layers")]
    base: Option<Region>,
    /// Only those that stand
    #[arg(long)]
    standing: bool,
    /// How numbers are printed
    #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
    number: Number,
    #[command(flatten)]
    output: Output,
}

impl Census {
    fn table(&self) -> Result<Table<'_>, Refused> {
        let Some(base) = self.base else {
            let entries = census::under_one_sphere(self.layers, !self.standing)
                .map_err(|error| Refused::of_rows(error, "--standing"))?;
            return Ok(table::census(entries));
        };
        let entries = census::on_base(base).map_err(|error| Refused::of(Culprit::Base, error))?;
        let wanted = |entry: &Result<Entry, Error>| {
            !self.standing || entry.as_ref().map_or(true, Entry::stands)
        };
        Ok(table::census(entries.filter(wanted)))
    }
}

impl Census {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let progress = Progress::begin("trying stackings");
        self.output
            .write_table(self.table()?, self.number, &progress)?;
        Ok(true)
    }
}
