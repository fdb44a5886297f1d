//! The tables of a pile: base, contacts and spheres.

mod base;
mod contacts;
mod friction;
mod spheres;

pub use base::base;
pub use contacts::{contacts, touching_contacts};
pub use friction::{rough_base, rough_contacts, rough_summary};
pub(crate) use spheres::in_dimension;
pub use spheres::{spheres, spheres_with_stress};

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

use super::cell::{Cell, NumberFormat};
use super::rows::Column;
use super::units::Units;
use crate::Error;
use cannonpile::lattice::{Dimension, Site};
use cannonpile::scalar::CorrectlyRounded;
use cannonpile::shape::Selection;
use cannonpile::{Packing, Pile};

/// The maximal number of rows of a table.
pub const MAX_ROWS: u64 = 100_000_000_000;

/// The float type for the joint rounding of many rows. A single sphere is evaluated exactly, and rounded when it is
/// shown.
enum Rounding {
    F64,
    F32,
}

fn rounding(numbers: NumberFormat, selection: Selection) -> Option<Rounding> {
    match (numbers, selection) {
        (NumberFormat::Exact | NumberFormat::Interval, _) | (_, Selection::One(_)) => None,
        (NumberFormat::F64, _) => Some(Rounding::F64),
        (NumberFormat::F32, _) => Some(Rounding::F32),
    }
}

/// A float type that a cell can store.
trait Float: CorrectlyRounded + Default + Into<Cell> + 'static {}

impl Float for f64 {}
impl Float for f32 {}

/// Returns a remedy: a selection with fewer rows, unless there is none.
pub(crate) fn narrower(selection: Selection) -> &'static str {
    match selection {
        Selection::Layer(_) | Selection::Base => "ask for one sphere",
        _ => "ask for one layer or one sphere",
    }
}

/// Returns a row that no row of the table exceeds, for the columns of forces and positions.
fn bounds(columns: &[Column], units: &Units<'_>, selection: Selection) -> Vec<Cell> {
    // One sphere has few rows, so each row is checked directly.
    if let Selection::One(_) = selection {
        return Vec::new();
    }
    let force = units.greatest_force();
    let bound = |column: &Column| match (column.unit, units) {
        ("", _) => Cell::Missing,
        ("m", Units::Si(packing)) => greatest_place(packing).into(),
        _ => force.clone().into(),
    };
    columns.iter().map(bound).collect()
}

/// Returns an upper bound of the coordinates of all centres: 2R times the number of steps of 2R on a path from the
/// origin. The path has at most three steps for each layer, and twice the greatest coordinate of a corner of the base.
fn greatest_place(packing: &Packing<'_>) -> BigRational {
    let shape = packing.pile().shape();
    let corners = shape.base().corners();
    let farthest = corners
        .iter()
        .flatten()
        .map(|x| x.unsigned_abs())
        .fold(0, u128::max);
    let steps =
        BigUint::from(farthest) * 2_u32 + BigUint::from(shape.layers().unsigned_abs()) * 3_u32;
    packing.radius() * BigRational::from(BigInt::from(steps * 2_u32))
}

/// Returns the columns of a site: the given ones, then i, and j in three dimensions.
#[must_use]
pub fn indices(pile: &Pile, first: &[&'static str]) -> Vec<Column> {
    let places: &[_] = if pile.dimension() == Dimension::Two {
        &["i"]
    } else {
        &["i", "j"]
    };
    first
        .iter()
        .chain(places)
        .copied()
        .map(Column::plain)
        .collect()
}

/// Returns the cells i, and j in three dimensions.
pub fn places(pile: &Pile, site: Site) -> impl Iterator<Item = Cell> + use<> {
    let j = (pile.dimension() == Dimension::Three).then_some(site.j);
    core::iter::once(site.i).chain(j).map(Cell::from)
}

/// Returns an error for more than [`MAX_ROWS`] rows.
///
/// # Errors
/// [`Error::TooManyRows`](cannonpile::Error::TooManyRows), which ends with `remedy`.
pub fn refuse_beyond(rows: &BigUint, remedy: &'static str) -> Result<(), Error> {
    if *rows <= BigUint::from(MAX_ROWS) {
        return Ok(());
    }
    Err(cannonpile::Error::TooManyRows {
        rows: rows.clone(),
        limit: MAX_ROWS,
        remedy,
    }
    .into())
}
