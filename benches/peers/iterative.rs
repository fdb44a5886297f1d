//! Conjugate gradients on the least-squares problem (CGLS: Hestenes and Stiefel 1952, §10).

use num_traits::Float;

use super::equations::Equations;

/// The result of an iteration.
pub(crate) struct Iterated<F> {
    pub(crate) forces: Vec<F>,
    pub(crate) iterations: usize,
    /// True if the residual of the recurrence is at most `tolerance`·‖b‖.
    pub(crate) converged: bool,
}

/// Iterates from f = 0 until ‖b − A f‖ ≤ `tolerance`·‖b‖, for at most `most` iterations.
pub(crate) fn forces<F: Float>(equations: &Equations<F>, tolerance: F, most: usize) -> Iterated<F> {
    let matrix = &equations.matrix;
    let mut forces = vec![F::zero(); matrix.size()];
    let mut residual = equations.loads.clone();
    let mut gradient = matrix.transposed_times(&residual);
    let mut search = gradient.clone();
    let mut steepness = squared(&gradient);
    let enough = tolerance * tolerance * squared(&residual);

    let mut iterations = 0;
    let mut converged = false;
    while !converged && iterations < most && steepness > F::zero() {
        let image = matrix.times(&search);
        let step = steepness / squared(&image);
        add_multiple(&mut forces, step, &search);
        add_multiple(&mut residual, -step, &image);
        gradient = matrix.transposed_times(&residual);
        let before = std::mem::replace(&mut steepness, squared(&gradient));
        for (s, &g) in search.iter_mut().zip(&gradient) {
            *s = g + steepness / before * *s;
        }
        iterations += 1;
        converged = squared(&residual) <= enough;
    }
    Iterated {
        forces,
        iterations,
        converged,
    }
}

/// Returns ‖x‖².
pub(crate) fn squared<F: Float>(x: &[F]) -> F {
    x.iter().fold(F::zero(), |sum, &x| sum + x * x)
}

/// Replaces x by x + factor·y.
fn add_multiple<F: Float>(x: &mut [F], factor: F, y: &[F]) {
    for (x, &y) in x.iter_mut().zip(y) {
        *x = *x + factor * y;
    }
}
