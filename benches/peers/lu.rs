//! The equations solved by a sparse LU factorisation, step by step.
//!
//! The pattern depends on the pile alone, the factors on its shape, the right-hand side on its weights: who has many
//! right-hand sides pays the first two steps once.

use faer::Col;
use faer::linalg::solvers::Solve;
use faer::prelude::Reborrow;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::traits::ComplexField;

use super::equations::{Columns, Equations};

/// The matrix, as the solver wants it.
pub(crate) fn matrix<F: ComplexField>(columns: &Columns<F>) -> SparseColMat<usize, F> {
    let (size, starts) = (columns.starts.len() - 1, columns.starts.clone());
    let pattern = SymbolicSparseColMat::new_checked(size, size, starts, None, columns.rows.clone());
    SparseColMat::new(pattern, columns.values.clone())
}

/// An order of elimination that keeps the factors sparse, and where they will have entries.
pub(crate) fn analyse<F>(matrix: &SparseColMat<usize, F>) -> SymbolicLu<usize> {
    SymbolicLu::try_new(matrix.symbolic()).expect("room for the pattern")
}

/// The factors.
pub(crate) fn factorise<F: ComplexField>(
    pattern: SymbolicLu<usize>,
    matrix: &SparseColMat<usize, F>,
) -> Lu<usize, F> {
    Lu::try_new_with_symbolic(pattern, matrix.rb()).expect("a regular matrix")
}

/// The forces under these loads.
pub(crate) fn solve<F: ComplexField + Copy>(factors: &Lu<usize, F>, loads: &[F]) -> Vec<F> {
    let mut forces = Col::from_fn(loads.len(), |row| loads[row]);
    factors.solve_in_place(forces.as_mut());
    forces.iter().copied().collect()
}

/// All steps, one after the other.
pub(crate) fn forces<F: ComplexField + Copy>(equations: &Equations<F>) -> Vec<F> {
    let matrix = matrix(&equations.matrix);
    let factors = factorise(analyse(&matrix), &matrix);
    solve(&factors, &equations.loads)
}
