//! All spheres and contacts as NumPy arrays.

use num_bigint::{BigInt, Sign};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use super::Pile;
use crate::array::{column, rows};
use crate::error::Error;
use crate::exception::Raised;
use crate::numbers::Numbers;
use crate::work::work;

impl Pile {
    /// Returns the arrays of the pile, in SI units or in pile units.
    fn numbers(&self, si: bool) -> PyResult<Numbers<'_>> {
        let numbers = if si {
            self.packing().and_then(Numbers::of_packing)
        } else {
            Numbers::of_pile(&self.exact)
        };
        numbers.map_err(|error| Raised::from(error).into_exception())
    }

    /// Returns the number of bottom spheres, if arrays for them fit into memory.
    fn base_places(&self) -> PyResult<usize> {
        let count = self.exact.base_sphere_count();
        usize::try_from(&count).map_err(|_| {
            let error = cannonpile::Error::TooLarge {
                quantity: "the forces of all bottom spheres",
                needed: count,
                limit: usize::MAX as u64,
                remedy: "use fewer layers, or a smaller top or base",
            };
            Raised::from(error).into_exception()
        })
    }
}

/// The centres of all spheres.
#[pyfunction]
pub(crate) fn positions<'py>(pile: &Pile, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers = pile.numbers(true)?;
    rows(py, numbers.spheres, |centres| numbers.fill_centres(centres))
}

/// The stress of all spheres times the volume of a sphere.
#[pyfunction]
pub(crate) fn stresses<'py>(pile: &Pile, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers = pile.numbers(true)?;
    rows(py, numbers.spheres, |stresses| {
        numbers.fill_stresses(stresses)
    })
}

/// The sites of all spheres.
#[pyfunction]
pub(crate) fn sites<'py>(pile: &Pile, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let numbers = pile.numbers(false)?;
    rows(py, numbers.spheres, |sites| numbers.fill_sites(sites))
}

/// The ids of the spheres of all contacts.
#[pyfunction]
pub(crate) fn contact_ids<'py>(
    pile: &Pile,
    py: Python<'py>,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let numbers = pile.numbers(false)?;
    rows(py, numbers.contacts, |ids| numbers.fill_ids(ids))
}

/// The contact points of all contacts.
#[pyfunction]
pub(crate) fn contact_points<'py>(
    pile: &Pile,
    py: Python<'py>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers = pile.numbers(true)?;
    rows(py, numbers.contacts, |points| numbers.fill_points(points))
}

/// The forces of all contacts.
#[pyfunction]
pub(crate) fn forces<'py>(
    pile: &Pile,
    py: Python<'py>,
    si: bool,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let numbers = pile.numbers(si)?;
    column(py, numbers.contacts, |forces| numbers.fill_forces(forces))
}

/// The force vectors on the first spheres of all contacts.
#[pyfunction]
pub(crate) fn vectors<'py>(pile: &Pile, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers = pile.numbers(true)?;
    rows(py, numbers.contacts, |vectors| {
        numbers.fill_vectors(vectors)
    })
}

/// The forces of the base on the floor.
#[pyfunction]
pub(crate) fn base<'py>(
    pile: &Pile,
    py: Python<'py>,
    si: bool,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers = pile.numbers(si)?;
    rows(py, pile.base_places()?, |base| numbers.fill_base(base))
}

/// The numerators of the forces of all contacts, and their denominator. Raises OverflowError if some exceed int64.
#[pyfunction]
pub(crate) fn multiples<'py>(
    pile: &Pile,
    py: Python<'py>,
) -> PyResult<(Bound<'py, PyArray1<i64>>, BigInt)> {
    let numbers = pile.numbers(false)?;
    let mut denominator = BigInt::ZERO;
    let numerators = column(py, numbers.contacts, |numerators: &mut [i64]| {
        denominator = numbers.fill_multiples(numerators)?;
        Ok::<_, Error>(())
    })?;
    Ok((numerators, denominator))
}

/// The same numerators of any length, as signed little-endian integers of equal width, with this width in bytes and their
/// denominator.
#[pyfunction]
pub(crate) fn long_multiples<'py>(
    pile: &Pile,
    py: Python<'py>,
) -> PyResult<(Bound<'py, PyBytes>, usize, BigInt)> {
    let numbers = pile.numbers(false)?;
    let mut numerators = reserved(numbers.contacts)?;
    numerators.resize(numbers.contacts, BigInt::ZERO);
    let (numerators, denominator) = work(py, || {
        let denominator = numbers.fill_multiples(&mut numerators)?;
        Ok::<_, Error>((numerators, denominator))
    })?;
    // One more bit for the sign.
    let bytes = numerators.iter().map(|n| n.bits() / 8 + 1).max();
    let width = usize::try_from(bytes.unwrap_or(1))?;
    let mut data = reserved(numerators.len().saturating_mul(width))?;
    for numerator in numerators {
        let sign = if numerator.sign() == Sign::Minus {
            u8::MAX
        } else {
            0
        };
        let end = data.len() + width;
        data.extend(numerator.to_signed_bytes_le());
        data.resize(end, sign);
    }
    let bytes = PyBytes::new_with(py, data.len(), |bytes| {
        bytes.copy_from_slice(&data);
        Ok(())
    })?;
    Ok((bytes, width, denominator))
}

/// Returns an empty vector with room for this many values. Raises MemoryError if the memory is too small, like NumPy.
fn reserved<V>(values: usize) -> PyResult<Vec<V>> {
    let mut reserved = Vec::new();
    reserved.try_reserve_exact(values).map_err(|_| {
        PyMemoryError::new_err(format!(
            "not enough memory for {values} values; use fewer layers"
        ))
    })?;
    Ok(reserved)
}
