//! A sparse LU factorisation of the equations, step by step.
//!
//! The sparsity pattern and the factors depend on the pile, and the right-hand side on its weights. For several right-hand
//! sides the first two steps run once.

use faer::Col;
use faer::linalg::solvers::Solve;
use faer::prelude::Reborrow;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::traits::ComplexField;

use super::equations::{Columns, Equations};

/// Returns the matrix in the format of the solver.
pub(crate) fn matrix<F: ComplexField>(columns: &Columns<F>) -> SparseColMat<usize, F> {
    let (size, starts) = (columns.starts.len() - 1, columns.starts.clone());
    let pattern = SymbolicSparseColMat::new_checked(size, size, starts, None, columns.rows.clone());
    SparseColMat::new(pattern, columns.values.clone())
}

/// Returns the symbolic factorisation: an elimination order with little fill-in, and the pattern of the factors.
pub(crate) fn analyse<F>(matrix: &SparseColMat<usize, F>) -> SymbolicLu<usize> {
    SymbolicLu::try_new(matrix.symbolic()).expect("room for the pattern")
}

/// Returns the numeric factors.
pub(crate) fn factorise<F: ComplexField>(
    pattern: SymbolicLu<usize>,
    matrix: &SparseColMat<usize, F>,
) -> Lu<usize, F> {
    Lu::try_new_with_symbolic(pattern, matrix.rb()).expect("a regular matrix")
}

/// Returns the forces for a right-hand side.
pub(crate) fn solve<F: ComplexField + Copy>(factors: &Lu<usize, F>, loads: &[F]) -> Vec<F> {
    let mut forces = Col::from_fn(loads.len(), |row| loads[row]);
    factors.solve_in_place(forces.as_mut());
    forces.iter().copied().collect()
}

/// Runs all steps.
pub(crate) fn forces<F: ComplexField + Copy>(equations: &Equations<F>) -> Vec<F> {
    let matrix = matrix(&equations.matrix);
    let factors = factorise(analyse(&matrix), &matrix);
    solve(&factors, &equations.loads)
}
