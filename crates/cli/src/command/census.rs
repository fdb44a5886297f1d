//! `census`: the stable stackings.

use cannonpile::Pile;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::Region;
use cannonpile::stacking::Stacking;
use cannonpile_dem::Key;
use cannonpile_dem::scene::parse;
use cannonpile_dem::table::Table;
use cannonpile_horizontal::census as horizontal;
use cannonpile_stability::census::{self, Entry};
use clap::Args;

use super::has_horizontal_contacts;
use crate::Error;
use crate::args::{Number, Output, shape};
use crate::output::{Failure, InputError};
use crate::progress::Progress;
use crate::tables;

const HELP: &str = "\
The census lists one of two mirror images. An unstable stacking is listed once, at the number of layers where it first
becomes unstable, with the tensile contact. For L >= 6 there are 11L - 50 rows, and the time grows like L^3.

Columns:
  stacking, layers         Hägg signs from the top; number of layers
  stands                   yes if the pile is stable
  min_contact              smallest contact force, in mg/(3cosθ)
  base_spheres             number of bottom spheres
  normal_min, normal_max   range of the base normal forces, in mg; empty for unstable stackings
  k, i, j, direction       contact with the smallest force
  margin_squared           t_c², the square of the least tilt at which a contact opens (see stability), without horizontal
                           contacts; empty for stackings that need these, for unstable ones, and for a single layer

With --spacing 1 horizontal contacts may support the pile, and decided_by names the proof:
  sloping     no contact between layers needs tension
  horizontal  horizontal forces make all contacts compressive
  run         more than 3 equal signs from the top, or 4 after a sign change, then another sign change: unstable
  work        another virtual displacement proves that the pile is unstable
The columns after decided_by are without horizontal contacts. For L >= 6 there are 12L - 56 rows. To write the proof:
  cannonpile summary --spacing 1 --stacking=STACKING --certificate FILE

A spacing above 1 and below 3/2 adds no contacts. There is no census from 3/2 on: spheres two layers apart touch there.

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
    /// Bottom layer, for all its stackings up to the greatest height: hexagon:P,Q, hexagon:N, triangle:N or
    /// region:x0..x1,y0..y1,s0..s1 [default: piles under one sphere]
    #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = shape, conflicts_with = "layers")]
    base: Option<Region>,
    /// Half the distance between horizontal neighbours over the radius, a/R, such as 6/5 or sqrt(2): 1 includes horizontal contacts [default: no horizontal contacts]
    #[arg(long, value_name = "Q", allow_hyphen_values = true, value_parser = str::parse::<Spacing>)]
    spacing: Option<Spacing>,
    /// List the stable stackings only
    #[arg(long)]
    standing: bool,
    /// Format of numbers
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

    /// Returns whether neighbours in a layer touch at `--spacing`.
    fn has_horizontal_contacts(&self) -> Result<bool, Failure> {
        // Some bases support no pile with a sign change.
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
        let progress = Progress::begin("checking stackings");
        self.output
            .write_table(self.table()?, self.number, &progress)?;
        Ok(true)
    }
}

fn of_base(error: impl Into<Error>) -> InputError {
    InputError::of(Key::Base, error)
}

fn too_many(error: impl Into<Error>) -> InputError {
    InputError::of_rows(error, "--standing")
}
