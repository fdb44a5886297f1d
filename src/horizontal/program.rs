//! Programs over forces that only push: a guess in floats, then exact.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT,
};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use super::exact::{Equation, near};
use super::network::{Column, MOST_EQUATIONS};
use crate::Error;
use crate::certificate::{Certificate, Refusal};
use crate::error::bug;

/// Minimise Σ cost x + ½ Σ curvature x² over x ≥ 0 with Σ column x = sums.
pub(super) struct Program<'n> {
    /// By unknown.
    pub(super) columns: &'n [Column],
    /// By equation.
    pub(super) sums: Vec<BigRational>,
    /// By unknown.
    pub(super) cost: Vec<BigRational>,
    /// By unknown.
    pub(super) curvature: Vec<f64>,
}

/// What floats make of a program.
pub(super) struct Guess {
    /// By unknown.
    pub(super) unknowns: Vec<f64>,
    /// By equation: the multipliers y of a minimum, with Σ column y ≤ cost.
    pub(super) multipliers: Vec<f64>,
    /// By unknown: what is left of its inequality.
    pub(super) slacks: Vec<f64>,
    /// By unknown: whether it is positive, and its inequality an equality.
    pub(super) positive: Vec<bool>,
}

impl Program<'_> {
    /// Returns what an interior point finds; `None` if it finds nothing.
    pub(super) fn guess(&self) -> Option<Guess> {
        let (equations, unknowns) = (self.sums.len(), self.columns.len());
        // A layer that is on the floor has no forces to find.
        if unknowns == 0 {
            return Some(Guess {
                unknowns: Vec::new(),
                multipliers: Vec::new(),
                slacks: Vec::new(),
                positive: Vec::new(),
            });
        }
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
        let places: Vec<usize> = (0..unknowns).collect();
        let curvature = CscMatrix::new_from_triplets(
            unknowns,
            unknowns,
            places.clone(),
            places,
            self.curvature.clone(),
        );
        let floats = |numbers: &[BigRational]| -> Option<Vec<f64>> {
            numbers.iter().map(BigRational::to_f64).collect()
        };
        let (cost, mut sums) = (floats(&self.cost)?, floats(&self.sums)?);
        sums.resize(equations + unknowns, 0.0);
        let cones = [ZeroConeT(equations), NonnegativeConeT(unknowns)];
        let settings = DefaultSettings {
            verbose: false,
            presolve_enable: false,
            ..DefaultSettings::default()
        };
        let mut solver =
            DefaultSolver::new(&curvature, &cost, &matrix, &sums, &cones, settings).ok()?;
        solver.solve();
        let solution = &solver.solution;
        if !matches!(
            solution.status,
            SolverStatus::Solved | SolverStatus::AlmostSolved
        ) {
            return None;
        }
        let (multipliers, slacks) = solution.z.split_at(equations);
        let positive = solution.x.iter().zip(slacks).map(|(x, slack)| x > slack);
        Some(Guess {
            positive: positive.collect(),
            unknowns: solution.x.clone(),
            slacks: slacks.to_vec(),
            // Of the program as it is posed there, with the other sign.
            multipliers: multipliers.iter().map(|y| -y).collect(),
        })
    }

    /// Returns exact x ≥ 0 of which only those are positive that the guess says.
    pub(super) fn exact_unknowns(&self, guess: &Guess) -> Option<Vec<BigRational>> {
        let mut equations: Vec<Equation> = self
            .sums
            .iter()
            .map(|sum| (<_>::default(), sum.clone()))
            .collect();
        let positive = || self.columns.iter().zip(&guess.positive).enumerate();
        for (unknown, (column, _)) in positive().filter(|(_, (_, positive))| **positive) {
            for (equation, coefficient) in column {
                equations[*equation].0.insert(unknown, coefficient.clone());
            }
        }
        let unknowns = guess.unknowns.iter().zip(&guess.positive);
        let unknowns: Vec<f64> = unknowns
            .map(|(x, positive)| if *positive { *x } else { 0.0 })
            .collect();
        near(equations, &unknowns, |unknowns| {
            !unknowns.iter().any(Signed::is_negative)
        })
    }

    /// Returns exact multipliers y with Σ column y ≤ cost, and equality where the guess says so.
    pub(super) fn exact_multipliers(&self, guess: &Guess) -> Option<Vec<BigRational>> {
        let of_positive = self.columns.iter().zip(&self.cost).zip(&guess.positive);
        let equations = of_positive.filter(|(_, positive)| **positive);
        let equations =
            equations.map(|((column, cost), _)| (column.iter().cloned().collect(), cost.clone()));
        near(equations.collect(), &guess.multipliers, |multipliers| {
            self.columns.iter().zip(&self.cost).all(|(column, cost)| {
                let terms = column
                    .iter()
                    .map(|(equation, c)| c * &multipliers[*equation]);
                terms.fold(BigRational::zero(), |sum, term| sum + term) <= *cost
            })
        })
    }

    /// The program with sums of order 1, and what they were divided by.
    pub(super) fn scaled(mut self) -> (Self, BigRational) {
        let greatest = self
            .sums
            .iter()
            .max()
            .filter(|greatest| greatest.is_positive());
        // Not a default: sums that are all zero need no scale.
        let scale = greatest
            .cloned()
            .unwrap_or_else(|| BigRational::from_integer(1.into()));
        for sum in &mut self.sums {
            *sum /= &scale;
        }
        (self, scale)
    }
}

/// Returns a certificate if the checker accepts it.
///
/// # Errors
/// [`Error::TooLarge`] if it would not fit into memory; [`Error::NotSolved`] if it is refused.
pub(super) fn accepted(certificate: Certificate, equations: usize) -> Result<Certificate, Error> {
    match certificate.check() {
        Ok(()) => Ok(certificate),
        Err(refusal) => Err(match *refusal {
            Refusal::Pile(error) => error,
            _ => Error::NotSolved { equations },
        }),
    }
}

/// Returns a certificate that formulas have made, checked where programs are solved too; of larger piles theorems vouch for
/// the formulas.
///
/// # Errors
/// [`Error::Bug`] if it is refused.
pub(super) fn of_formulas(certificate: Certificate) -> Result<Certificate, Error> {
    let directions = certificate.pile.dimension().number();
    let is_small = certificate.pile.sphere_count() * directions <= MOST_EQUATIONS.into();
    if is_small && certificate.check().is_err() {
        return Err(bug("a certificate that formulas have made is accepted"));
    }
    Ok(certificate)
}
