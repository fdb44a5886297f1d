//! Linear and quadratic programs over compressive forces: an interior-point solver in floats suggests which forces are zero.

use std::iter::repeat_n;

use cannonpile::engine::{bug, check_interrupt};
use cannonpile::scalar::ByValue;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive};

use crate::Error;
use crate::certificate::{Certificate, Refusal};
use crate::exact::Sparse;
use crate::exact_simplex::{Program, Solution, solve};
use crate::network::MAX_EQUATIONS;

impl Program<'_> {
    /// Returns the exact solution. The basis is suggested by an interior-point solver in floats.
    ///
    /// # Errors
    /// As for [`solve`].
    pub(crate) fn solve(&self) -> Result<Solution, Error> {
        solve(self, self.suggested())
    }

    /// Returns the unknowns of a basis: those that are positive in floats, or all sloping forces.
    pub(crate) fn suggested(&self) -> Vec<bool> {
        let (unknowns, equations) = (self.columns.len(), self.sums.len());
        // Without horizontal forces there is only one basis.
        let found = (unknowns > equations)
            .then(|| in_floats(&self.columns, &self.sums, &self.cost, false))
            .flatten();
        match found {
            Some(found) => found.iter().map(|[x, slack]| x > slack).collect(),
            None => (0..unknowns).map(|unknown| unknown < equations).collect(),
        }
    }
}

/// Minimises Σ cost · x, or Σ cost · x + ½ Σ x², over x ≥ 0 with Σ column · x = sums. Returns each x, with the slack of its
/// dual inequality. `None` if the solver fails.
///
/// The dual program is solved, because it is smaller: maximise Σ sums · y with Σ column · y + slack = cost. If the program
/// is quadratic: maximise Σ sums · y − ½ Σ x² with Σ column · y + slack = cost + x. In both, x is the multiplier of the
/// inequality.
pub(crate) fn in_floats(
    columns: &[Sparse],
    sums: &[BigRational],
    cost: &[BigRational],
    is_quadratic: bool,
) -> Option<Vec<[f64; 2]>> {
    let (equations, unknowns) = (sums.len(), columns.len());
    let (squares, tolerance) = if is_quadratic {
        (unknowns, TIGHT)
    } else {
        (0, LOOSE)
    };
    let (mut rows, mut numbers, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for (unknown, column) in columns.iter().enumerate() {
        for (equation, coefficient) in column {
            rows.push(unknown);
            numbers.push(*equation);
            values.push(coefficient.to_f64()?);
        }
    }
    let square = |number| equations + number;
    rows.extend(0..squares);
    numbers.extend((0..squares).map(square));
    values.extend(repeat_n(-1.0, squares));
    let all = equations + squares;
    let matrix = CscMatrix::new_from_triplets(unknowns, all, rows, numbers, values);
    let diagonal: Vec<usize> = (0..squares).map(square).collect();
    let quadratic =
        CscMatrix::new_from_triplets(all, all, diagonal.clone(), diagonal, vec![1.0; squares]);
    // The right-hand sides are scaled to order 1.
    let greatest = sums.iter().max_by_key(|sum| ByValue(sum));
    let greatest = greatest.filter(|greatest| greatest.is_positive());
    // Sums that are all zero need no scale.
    let unit = greatest.cloned().unwrap_or_else(BigRational::one);
    let mut linear = Vec::with_capacity(all);
    for sum in sums {
        linear.push(-(sum / &unit).to_f64()?);
    }
    linear.resize(all, 0.0);
    let right: Option<Vec<f64>> = cost.iter().map(BigRational::to_f64).collect();
    let settings = DefaultSettings {
        verbose: false,
        presolve_enable: false,
        tol_gap_abs: tolerance,
        tol_gap_rel: tolerance,
        tol_feas: tolerance,
        ..DefaultSettings::default()
    };
    let cones = [NonnegativeConeT(unknowns)];
    let mut solver =
        DefaultSolver::new(&quadratic, &linear, &matrix, &right?, &cones, settings).ok()?;
    solver.set_termination_callback(|_| check_interrupt().is_err());
    solver.solve();
    let found = solver.solution;
    let is_solved = matches!(
        found.status,
        SolverStatus::Solved | SolverStatus::AlmostSolved
    );
    let both = found.z.iter().zip(&found.s);
    is_solved.then(|| both.map(|(x, slack)| [*x, *slack]).collect())
}

/// The tolerance for the basis of a linear program. A tighter one would cost more iterations than it saves exact steps.
const LOOSE: f64 = 1e-4;

/// The tightest tolerance that the float solver reaches reliably.
const TIGHT: f64 = 1e-8;

/// Returns a certificate after its check.
///
/// # Errors
/// [`TooLarge`](cannonpile::Error::TooLarge) if the check needs too much memory, and [`Bug`](cannonpile::Error::Bug) if
/// the checker rejects the certificate.
pub(crate) fn accepted(certificate: Certificate) -> Result<Certificate, Error> {
    match certificate.check() {
        Ok(()) => Ok(certificate),
        Err(Refusal::Pile(error)) => Err(error.into()),
        Err(Refusal::Violated(..)) => Err(bug("the checker accepts exact solutions").into()),
    }
}

/// Returns a certificate that formulas produced.
///
/// It is checked up to the size at which programs are solved. For larger piles theorems prove the formulas.
///
/// # Errors
/// [`Bug`](cannonpile::Error::Bug) if the checker rejects it.
pub(crate) fn of_formulas(certificate: Certificate) -> Result<Certificate, cannonpile::Error> {
    let directions = certificate.pile.dimension().number();
    let is_small = certificate.pile.sphere_count() * directions <= MAX_EQUATIONS.into();
    if is_small && certificate.check().is_err() {
        return Err(bug("the checker accepts certificates of formulas"));
    }
    Ok(certificate)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beginning::certified;
    use crate::certificate::Claim;
    use cannonpile::Pile;

    fn claimed(layers: i128, claim: Claim) -> Certificate {
        certified(Pile::triangular(layers).unwrap(), claim)
    }

    /// A pile of 40 layers has 34,440 equations; theorems prove its certificate.
    #[test]
    fn certificates_of_formulas_are_accepted() {
        for made in [claimed(7, Claim::Stands), claimed(40, Claim::CannotStand)] {
            assert_eq!(of_formulas(made.clone()), Ok(made));
        }
    }

    #[test]
    #[cfg_attr(
        debug_assertions,
        should_panic(expected = "accepts certificates of formulas")
    )]
    fn small_certificates_of_formulas_are_checked() {
        let refused = of_formulas(claimed(7, Claim::CannotStand));
        assert!(matches!(refused, Err(cannonpile::Error::Bug { .. })));
    }

    #[test]
    fn refusal_for_size_is_no_bug() {
        let stands = claimed(4, Claim::Stands);
        assert_eq!(accepted(stands.clone()), Ok(stands));
        // 4.5 million spheres.
        let large = accepted(claimed(300, Claim::Stands));
        assert!(
            matches!(large, Err(Error::Core(cannonpile::Error::TooLarge { .. }))),
            "{large:?}"
        );
    }
}
