//! Means over random stackings.

use cannonpile::lattice::{Dimension, Region};
use cannonpile_dem::scene::parse;
use cannonpile_disorder::{Error, FirstSign, RandomPiles, RandomStackings};
use num_bigint::BigInt;
use num_rational::BigRational;
use pyo3::prelude::*;

use crate::exception::Raised;
use crate::input::read;
use crate::work::work;

/// The mean at a position: a, b, probability, normal force, shear along x and along y.
type Row = (BigInt, BigInt, [BigRational; 4]);

/// Return the means over random stackings at every position of the base.
#[pyfunction]
pub(crate) fn mean(
    py: Python<'_>,
    layers: &str,
    top: Option<&str>,
    base: Option<&str>,
    loads: Vec<(String, String)>,
    weightless: bool,
    fault_probability: &str,
    first: &str,
    given_sphere: bool,
) -> PyResult<Vec<Row>> {
    let layers = read("layers", layers, parse::layers)?;
    let q = read("fault_probability", fault_probability, parse::rational)?;
    let first = read("first", first, str::parse::<FirstSign>)?;
    let region = |name, text: &str| read(name, text, str::parse::<Region>);
    let refused = |error: Error| Raised::from(error).into_exception();
    let stackings = RandomStackings::new(layers, first).map_err(refused)?;
    let mut piles = match (top, base) {
        (None, Some(base)) => RandomPiles::on(region("base", base)?, stackings),
        (Some("plane"), _) => RandomPiles::plane(stackings),
        (Some(top), _) => RandomPiles::under(region("top", top)?, stackings),
        (None, None) => RandomPiles::under(Region::SITE, stackings),
    };
    if weightless {
        piles = piles.weightless();
    }
    for (at, weight) in &loads {
        let at = read("loads", at, |at| parse::at(at, Dimension::Three))?;
        let weight = read("loads", weight, parse::rational)?;
        piles = piles.with_load(at.site(layers), weight).map_err(refused)?;
    }
    let mean = work(py, || piles.exact(&q))?;
    let mean = if given_sphere {
        mean.given_sphere()
    } else {
        mean
    };
    let rows = mean.into_rows().into_iter().map(|row| {
        let numbers = [row.probability, row.normal, row.shear_x, row.shear_y];
        (row.place.a.into(), row.place.b.into(), numbers)
    });
    Ok(rows.collect())
}
