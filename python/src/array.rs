//! NumPy arrays, filled in place.

use numpy::{Element, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

use crate::exception::Raised;
use crate::work::work;

/// A number type of NumPy arrays.
pub(crate) trait Number: Element + Send {
    /// The name of the type in NumPy.
    const NAME: &'static str;
}

impl Number for f64 {
    const NAME: &'static str = "float64";
}

impl Number for i64 {
    const NAME: &'static str = "int64";
}

/// Allocates a NumPy array. NumPy raises MemoryError if the memory is too small.
fn zeros<'py>(
    py: Python<'py>,
    shape: impl IntoPyObject<'py>,
    name: &str,
) -> PyResult<Bound<'py, PyAny>> {
    static ZEROS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    ZEROS.import(py, "numpy", "zeros")?.call1((shape, name))
}

/// Creates a one-dimensional array and fills it with the interpreter lock released.
pub(crate) fn column<V: Number, E: From<cannonpile::Error> + Into<Raised> + Send>(
    py: Python<'_>,
    length: usize,
    fill: impl FnOnce(&mut [V]) -> Result<(), E> + Send,
) -> PyResult<Bound<'_, PyArray1<V>>> {
    let array = zeros(py, length, V::NAME)?.cast_into::<PyArray1<V>>()?;
    {
        let mut memory = array.readwrite();
        let numbers = memory.as_slice_mut()?;
        work(py, || fill(numbers))?;
    }
    Ok(array)
}

/// Creates an array of rows with a given number of columns.
pub(crate) fn rows<V: Number, E: From<cannonpile::Error> + Into<Raised> + Send, const N: usize>(
    py: Python<'_>,
    length: usize,
    fill: impl FnOnce(&mut [[V; N]]) -> Result<(), E> + Send,
) -> PyResult<Bound<'_, PyArray2<V>>> {
    let array = zeros(py, (length, N), V::NAME)?.cast_into::<PyArray2<V>>()?;
    {
        let mut memory = array.readwrite();
        let (numbers, _) = memory.as_slice_mut()?.as_chunks_mut::<N>();
        work(py, || fill(numbers))?;
    }
    Ok(array)
}
