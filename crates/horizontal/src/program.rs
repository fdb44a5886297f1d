//! Linear and quadratic programs over compressive forces: a float solution, then an exact one.

use std::borrow::Cow;

use cannonpile::engine::{bug, check_interrupt};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolution, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus,
    SupportedConeT, ZeroConeT,
};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use crate::Error;
use crate::certificate::{Certificate, Refusal};
use crate::exact::{Equation, Sparse, near};
use crate::network::MAX_EQUATIONS;

/// A program: minimise the objective over x ≥ 0 with Σ column · x = sums.
pub(crate) struct Program<'n> {
    /// The columns of the matrix, by unknown: coefficients by equation.
    pub(crate) columns: Cow<'n, [Sparse]>,
    /// The right-hand sides, by equation.
    pub(crate) sums: Vec<BigRational>,
    pub(crate) objective: Objective,
}

/// The objective to minimise.
pub(crate) enum Objective {
    /// Σ cost · x, with the costs by unknown.
    LinearCost(Vec<BigRational>),
    /// ½ Σ x².
    SumOfSquares,
}

/// The tolerance of the float solver, relative to the optimum.
#[derive(Clone, Copy)]
pub(crate) enum Tolerance {
    /// This usually suffices to identify the forces that are zero.
    Loose,
    /// The tightest tolerance that the solver reaches reliably.
    Tight,
}

/// A float solution of a program.
pub(crate) struct Guess {
    /// The primal solution, by unknown.
    pub(crate) unknowns: Vec<f64>,
    /// The dual solution y, by equation, with Σ column · y ≤ cost.
    pub(crate) multipliers: Vec<f64>,
    /// The slack of the dual inequality, by unknown.
    pub(crate) slacks: Vec<f64>,
    /// The predicted active set, by unknown: `true` if the unknown is positive, so that its dual inequality is an
    /// equality.
    pub(crate) positive: Vec<bool>,
}

impl Program<'_> {
    /// Returns the solution of an interior-point solver, or `None` if it fails.
    pub(crate) fn guess(&self, tolerance: Tolerance) -> Option<Guess> {
        // A pile of one layer has no unknown forces.
        if self.columns.is_empty() {
            return Some(Guess {
                unknowns: Vec::new(),
                multipliers: Vec::new(),
                slacks: Vec::new(),
                positive: Vec::new(),
            });
        }
        let sums = floats(&self.sums)?;
        match &self.objective {
            Objective::LinearCost(cost) => self.guess_of_cost(&floats(cost)?, &sums, tolerance),
            Objective::SumOfSquares => self.guess_of_squares(sums, tolerance),
        }
    }

    /// Solves the linear program through its dual, which is smaller: maximise Σ sums · y with Σ column · y ≤ cost.
    /// The unknowns are the dual variables of that program.
    fn guess_of_cost(&self, cost: &[f64], sums: &[f64], tolerance: Tolerance) -> Option<Guess> {
        let (equations, unknowns) = (sums.len(), self.columns.len());
        let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (unknown, column) in self.columns.iter().enumerate() {
            for (equation, coefficient) in column {
                rows.push(unknown);
                columns.push(*equation);
                values.push(coefficient.to_f64()?);
            }
        }
        let matrix = CscMatrix::new_from_triplets(unknowns, equations, rows, columns, values);
        let negated: Vec<f64> = sums.iter().map(|sum| -sum).collect();
        let found = tolerance.solve(
            &CscMatrix::zeros((equations, equations)),
            &negated,
            &matrix,
            cost,
            &[NonnegativeConeT(unknowns)],
        )?;
        Some(Guess::new(found.z, found.x, found.s))
    }

    fn guess_of_squares(&self, mut sums: Vec<f64>, tolerance: Tolerance) -> Option<Guess> {
        let (equations, unknowns) = (sums.len(), self.columns.len());
        let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (unknown, column) in self.columns.iter().enumerate() {
            for (equation, coefficient) in column {
                rows.push(*equation);
                columns.push(unknown);
                values.push(coefficient.to_f64()?);
            }
            rows.push(equations + unknown);
            columns.push(unknown);
            values.push(-1.0);
        }
        let matrix =
            CscMatrix::new_from_triplets(equations + unknowns, unknowns, rows, columns, values);
        sums.resize(equations + unknowns, 0.0);
        let mut found = tolerance.solve(
            &CscMatrix::identity(unknowns),
            &vec![0.0; unknowns],
            &matrix,
            &sums,
            &[ZeroConeT(equations), NonnegativeConeT(unknowns)],
        )?;
        let slacks = found.z.split_off(equations);
        // The solver's Lagrangian has the opposite sign.
        let multipliers = found.z.iter().map(|y| -y).collect();
        Some(Guess::new(found.x, multipliers, slacks))
    }

    /// Returns an exact primal solution x ≥ 0 with support in the predicted active set.
    pub(crate) fn exact_unknowns(&self, guess: &Guess) -> Option<Vec<BigRational>> {
        let mut equations: Vec<Equation> = self
            .sums
            .iter()
            .map(|sum| (Vec::new(), sum.clone()))
            .collect();
        let positive = || self.columns.iter().zip(&guess.positive).enumerate();
        for (unknown, (column, _)) in positive().filter(|(_, (_, positive))| **positive) {
            for (equation, coefficient) in column {
                equations[*equation].0.push((unknown, coefficient.clone()));
            }
        }
        let unknowns = guess.unknowns.iter().zip(&guess.positive);
        let unknowns: Vec<f64> = unknowns
            .map(|(x, positive)| if *positive { *x } else { 0.0 })
            .collect();
        near(equations, &unknowns, &|unknowns| {
            !unknowns.iter().any(Signed::is_negative)
        })
    }

    /// Returns an exact dual solution: Σ column · y ≤ cost, with equality on the predicted active set.
    pub(crate) fn exact_multipliers(&self, guess: &Guess) -> Option<Vec<BigRational>> {
        let Objective::LinearCost(cost) = &self.objective else {
            return None;
        };
        let of_positive = self.columns.iter().zip(cost).zip(&guess.positive);
        let equations = of_positive.filter(|(_, positive)| **positive);
        let equations = equations.map(|((column, cost), _)| (column.clone(), cost.clone()));
        near(equations.collect(), &guess.multipliers, &|multipliers| {
            self.columns.iter().zip(cost).all(|(column, cost)| {
                let terms = column
                    .iter()
                    .map(|(equation, c)| c * &multipliers[*equation]);
                terms.fold(BigRational::zero(), |sum, term| sum + term) <= *cost
            })
        })
    }

    /// Returns the program with right-hand sides of order 1, and the scale factor.
    pub(crate) fn scaled(mut self) -> (Self, BigRational) {
        let greatest = self
            .sums
            .iter()
            .max()
            .filter(|greatest| greatest.is_positive());
        // If all right-hand sides are zero, no scaling is needed.
        let scale = greatest
            .cloned()
            .unwrap_or_else(|| BigRational::from_integer(1.into()));
        for sum in &mut self.sums {
            *sum /= &scale;
        }
        (self, scale)
    }
}

impl Guess {
    fn new(unknowns: Vec<f64>, multipliers: Vec<f64>, slacks: Vec<f64>) -> Self {
        let positive = unknowns.iter().zip(&slacks).map(|(x, slack)| x > slack);
        Self {
            positive: positive.collect(),
            unknowns,
            multipliers,
            slacks,
        }
    }
}

impl Tolerance {
    /// Minimises q·x + ½ x·Px subject to A x + s = b, with s in the cones.
    fn solve(
        self,
        p: &CscMatrix,
        q: &[f64],
        a: &CscMatrix,
        b: &[f64],
        cones: &[SupportedConeT<f64>],
    ) -> Option<DefaultSolution<f64>> {
        let mut settings = DefaultSettings {
            verbose: false,
            presolve_enable: false,
            ..DefaultSettings::default()
        };
        if let Self::Loose = self {
            settings.tol_gap_abs = LOOSE;
            settings.tol_gap_rel = LOOSE;
            settings.tol_feas = LOOSE;
        }
        let mut solver = DefaultSolver::new(p, q, a, b, cones, settings).ok()?;
        solver.set_termination_callback(|_| check_interrupt().is_err());
        solver.solve();
        let found = solver.solution;
        let is_solved = matches!(
            found.status,
            SolverStatus::Solved | SolverStatus::AlmostSolved
        );
        is_solved.then_some(found)
    }
}

/// This tolerance saves a third of the iterations of clarabel's default.
const LOOSE: f64 = 1e-5;

fn floats(numbers: &[BigRational]) -> Option<Vec<f64>> {
    numbers.iter().map(BigRational::to_f64).collect()
}

/// Returns a certificate if the checker accepts it.
///
/// # Errors
/// [`TooLarge`](cannonpile::Error::TooLarge) if the check needs too much memory, and `refused` if the certificate
/// is rejected.
pub(crate) fn accepted(
    certificate: Certificate,
    refused: impl FnOnce() -> Error,
) -> Result<Certificate, Error> {
    match certificate.check() {
        Ok(()) => Ok(certificate),
        Err(refusal) => Err(match *refusal {
            Refusal::Pile(error) => error.into(),
            _ => refused(),
        }),
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
    fn refusal_distinguishes_size_from_error() {
        let stands = claimed(4, Claim::Stands);
        let refused = || Error::NotSolved { equations: 7 };
        assert_eq!(accepted(stands.clone(), refused), Ok(stands));
        let cannot_stand = accepted(claimed(4, Claim::CannotStand), refused);
        assert_eq!(cannot_stand, Err(refused()));
        // 4.5 million spheres.
        let large = accepted(claimed(300, Claim::Stands), refused);
        assert!(
            matches!(large, Err(Error::Core(cannonpile::Error::TooLarge { .. }))),
            "{large:?}"
        );
    }
}
