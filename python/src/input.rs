//! Conversion of Python arguments to the types of the library.

use cannonpile::lattice::Site;
use num_bigint::BigInt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::Error;
use crate::exception::of_argument;

/// Parses the text of an option with the parser of the library.
pub(crate) fn read<T, E: Into<Error>>(
    name: &str,
    text: &str,
    parse: impl FnOnce(&str) -> Result<T, E>,
) -> PyResult<T> {
    parse(text).map_err(|error| of_argument(name, &error.into()))
}

/// Returns a coordinate of a sphere or the number of a layer.
pub(crate) fn coordinate(name: &str, number: &BigInt) -> PyResult<i128> {
    i128::try_from(number).map_err(|_| {
        PyValueError::new_err(format!(
            "{name}: {number} is outside every pile; coordinates lie within ±10^36"
        ))
    })
}

/// Returns the site of a sphere.
pub(crate) fn site(k: &BigInt, i: &BigInt, j: &BigInt) -> PyResult<Site> {
    Ok(Site {
        i: coordinate("i", i)?,
        j: coordinate("j", j)?,
        k: coordinate("k", k)?,
    })
}
