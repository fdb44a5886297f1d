//! `census`: which stackings stand.

use cannonpile::Pile;
use cannonpile::census;
use cannonpile::census::Entry;
use cannonpile::lattice::Region;
use cannonpile::stacking::Stacking;
use cannonpile_dem::Key;
use cannonpile_dem::scene::parse;
use cannonpile_dem::table::Table;
use cannonpile_horizontal::census as horizontal;
use clap::Args;
use num_rational::BigRational;

use super::has_horizontal_contacts;
use crate::Error;
use crate::args::{Number, Output};
use crate::output::{Failure, Refused};
use crate::progress::Progress;
use crate::tables;

const HELP: &str = "\
Of two mirror images one is listed. A stacking that fails is listed once, at the number of layers at which it first does,
with the contact that would have to pull. With these a census of L layers has 11L − 50 rows, from six layers on, and takes
a time that grows like L³.

With --spacing 1 horizontal contacts are counted in, and there is no 'undetermined': each verdict has a proof, and
decided_by says which: 'sloping', without them no contact pulls; 'horizontal', their forces hold the pile; 'run', one of more
than 3 steps from the top, or 4 after a change of sign, cannot end; 'work', other virtual displacements forbid it. Without --standing there are 12L − 56 rows, from six layers on. min_contact and all after it are without horizontal contacts. The proof itself:
  cannonpile summary --spacing 1 --stacking=STACKING --certificate FILE
Above 1 and below 3/2 nothing else touches, as without --spacing; at 3/2 spheres two layers apart do where the sign changes,
and there is no census, nor above it, where they overlap.

Examples:
  cannonpile census --layers 6
  cannonpile census --layers 12 --spacing 1 --standing
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
    /// a/R: at 1 neighbours of a layer touch, and horizontal contacts are counted in; above 1 and below 3/2 nothing but the
    /// contacts touches, as without this option
    #[arg(long, value_name = "Q", allow_hyphen_values = true, value_parser = parse::rational)]
    spacing: Option<BigRational>,
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
    fn table(&self) -> Result<Table<'_>, Failure> {
        Ok(match (self.base, self.has_horizontal_contacts()?) {
            (None, false) => tables::census(
                census::under_one_sphere(self.layers, !self.standing).map_err(too_many)?,
            ),
            (None, true) => tables::horizontal_census(
                horizontal::under_one_sphere(self.layers, !self.standing).map_err(too_many)?,
            ),
            (Some(base), false) => {
                let entries = census::on_base(base).map_err(of_base)?;
                tables::census(self.wanted(entries, Entry::stands))
            }
            (Some(base), true) => {
                let entries = horizontal::on_base(base).map_err(of_base)?;
                tables::horizontal_census(self.wanted(entries, horizontal::Entry::stands))
            }
        })
    }

    fn wanted<T, E>(
        &self,
        entries: impl Iterator<Item = Result<T, E>>,
        stands: impl Fn(&T) -> bool,
    ) -> impl Iterator<Item = Result<T, E>> {
        let all = !self.standing;
        entries.filter(move |entry| all || entry.as_ref().map_or(true, &stands))
    }

    /// Whether neighbours of a layer touch, at the spacing that is given; or why there is no census at it.
    fn has_horizontal_contacts(&self) -> Result<bool, Failure> {
        // Not every base carries a change of sign.
        let pile = |layers| {
            let stacking = Stacking::hcp(layers)?;
            match self.base {
                None => Pile::under(Region::SITE, stacking),
                Some(base) => Pile::on(base, stacking),
            }
        };
        has_horizontal_contacts(self.spacing.as_ref(), || match self.base {
            None => pile(self.layers.min(3)),
            Some(_) => pile(3).or_else(|_| pile(1)),
        })
    }

    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let progress = Progress::begin("trying stackings");
        self.output
            .write_table(self.table()?, self.number, &progress)?;
        Ok(true)
    }
}

fn of_base(error: impl Into<Error>) -> Refused {
    Refused::of(Key::Base, error)
}

fn too_many(error: impl Into<Error>) -> Refused {
    Refused::of_rows(error, "--standing")
}
