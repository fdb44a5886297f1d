//! The tables of a pile: base, contacts and spheres.

mod base;
mod contacts;
mod spheres;

pub use base::base;
pub use contacts::{contacts, touching_contacts};
pub use spheres::spheres;

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

/// The most rows that are written.
pub const MAX_ROWS: u64 = 100_000_000_000;

/// The floats that many rows are rounded to at once. One sphere is answered exactly, and rounded as it is shown.
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

/// A float that a cell holds.
trait Float: CorrectlyRounded + Default + Into<Cell> + 'static {}

impl Float for f64 {}
impl Float for f32 {}

/// The question that has fewer answers, unless it is the narrowest.
pub(crate) fn narrower(selection: Selection) -> &'static str {
    match selection {
        Selection::Layer(_) | Selection::Base => "ask for one sphere",
        _ => "ask for one layer or one sphere",
    }
}

/// A row that no row of the table exceeds, for the columns that hold forces and places.
fn bounds(columns: &[Column], units: &Units<'_>, selection: Selection) -> Result<Vec<Cell>, Error> {
    // The rows of one sphere are few enough to be looked at themselves.
    if let Selection::One(_) = selection {
        return Ok(Vec::new());
    }
    let force = units.greatest_force(selection)?;
    let bound = |column: &Column| match (column.unit, units) {
        ("", _) => Cell::Missing,
        ("m", Units::Si(packing)) => greatest_place(packing).into(),
        _ => force.clone().into(),
    };
    Ok(columns.iter().map(bound).collect())
}

/// A length that no coordinate of a centre exceeds: from the origin on it takes as many steps of 2R as layers, and as
/// i and j of the base count.
fn greatest_place(packing: &Packing<'_>) -> BigRational {
    let shape = packing.pile().shape();
    let corners = shape.base().corners();
    let farthest = corners.iter().flatten().map(|x| x.unsigned_abs()).max();
    let steps = BigUint::from(farthest.unwrap_or(0)) * 2_u32
        + BigUint::from(shape.layers().unsigned_abs()) * 3_u32;
    packing.radius() * BigRational::from(BigInt::from(steps * 2_u32))
}

/// The columns that say where a sphere is: those named first, then i, and j in space.
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

/// i, and j in space.
pub fn places(pile: &Pile, site: Site) -> impl Iterator<Item = Cell> + use<> {
    let j = (pile.dimension() == Dimension::Three).then_some(site.j);
    core::iter::once(site.i).chain(j).map(Cell::from)
}

/// Refuses more than [`MAX_ROWS`] rows.
///
/// # Errors
/// [`Error::TooManyRows`](cannonpile::Error::TooManyRows), with `remedy` as the last words.
pub fn refuse_beyond(rows: &BigUint, remedy: &'static str) -> Result<(), Error> {
    if *rows <= BigUint::from(MAX_ROWS) {
        return Ok(());
    }
    Err(cannonpile::Error::too_many_rows(rows.clone(), MAX_ROWS, remedy).into())
}
