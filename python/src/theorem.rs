//! Theorems and their proofs.

use cannonpile::Error;
use cannonpile_proof::Theorem;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::work::work;

/// A theorem: name, statement, hypotheses, symbols, method, and the result of the proof.
type Row = (
    &'static str,
    &'static str,
    &'static str,
    &'static str,
    &'static str,
    bool,
);

/// Run the proofs of all theorems, or of the theorem with a given name.
#[pyfunction]
pub(crate) fn prove(py: Python<'_>, name: Option<&str>) -> PyResult<Vec<Row>> {
    let wanted = |theorem: &Theorem| name.is_none_or(|name| theorem.name == name);
    let theorems: Vec<_> = cannonpile_proof::all().filter(wanted).collect();
    if theorems.is_empty() {
        let names: Vec<_> = cannonpile_proof::all()
            .map(|theorem| theorem.name)
            .collect();
        return Err(PyValueError::new_err(format!(
            "name: unknown theorem; the theorems are {}",
            names.join(", ")
        )));
    }
    let prove = |theorem: Theorem| {
        let holds = work(py, || Ok::<_, Error>(theorem.prove().holds()))?;
        let Theorem {
            name,
            statement,
            hypotheses,
            symbols,
            method,
            ..
        } = theorem;
        Ok((name, statement, hypotheses, symbols, method.name(), holds))
    };
    theorems.into_iter().map(prove).collect()
}
