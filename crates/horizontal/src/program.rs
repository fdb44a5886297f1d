//! Programs over forces that only push: a guess in floats, then exact.

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
use crate::exact::{Equation, near};
use crate::network::{Column, MOST_EQUATIONS};

/// Minimise over x ≥ 0 with Σ column x = sums.
pub(crate) struct Program<'n> {
    /// By unknown.
    pub(crate) columns: Cow<'n, [Column]>,
    /// By equation.
    pub(crate) sums: Vec<BigRational>,
    pub(crate) aim: Aim,
}

/// What is to be least.
pub(crate) enum Aim {
    /// Σ cost x: the costs by unknown.
    Cost(Vec<BigRational>),
    /// ½ Σ x².
    Squares,
}

/// How close floats come to a minimum before they are made exact, as a share of it.
#[derive(Clone, Copy)]
pub(crate) enum Closeness {
    /// Enough, as a rule, to say which forces are zero.
    Loose,
    /// As close as floats come with certainty.
    Tight,
}

/// What floats make of a program.
pub(crate) struct Guess {
    /// By unknown.
    pub(crate) unknowns: Vec<f64>,
    /// By equation: the multipliers y of a minimum, with Σ column y ≤ cost.
    pub(crate) multipliers: Vec<f64>,
    /// By unknown: what is left of its inequality.
    pub(crate) slacks: Vec<f64>,
    /// By unknown: whether it is positive, and its inequality an equality.
    pub(crate) positive: Vec<bool>,
}

impl Program<'_> {
    /// Returns what an interior point finds; `None` if it finds nothing.
    pub(crate) fn guess(&self, closeness: Closeness) -> Option<Guess> {
        // A layer that is on the floor has no forces to find.
        if self.columns.is_empty() {
            return Some(Guess {
                unknowns: Vec::new(),
                multipliers: Vec::new(),
                slacks: Vec::new(),
                positive: Vec::new(),
            });
        }
        let sums = floats(&self.sums)?;
        match &self.aim {
            Aim::Cost(cost) => self.guess_of_cost(&floats(cost)?, &sums, closeness),
            Aim::Squares => self.guess_of_squares(sums, closeness),
        }
    }

    /// By the program of the multipliers, which is the smaller one: Σ sums y is greatest with Σ column y ≤ cost, and the
    /// unknowns are its multipliers.
    fn guess_of_cost(&self, cost: &[f64], sums: &[f64], closeness: Closeness) -> Option<Guess> {
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
        let lowered: Vec<f64> = sums.iter().map(|sum| -sum).collect();
        let found = closeness.solve(
            &CscMatrix::zeros((equations, equations)),
            &lowered,
            &matrix,
            cost,
            &[NonnegativeConeT(unknowns)],
        )?;
        Some(Guess::new(found.z, found.x, found.s))
    }

    fn guess_of_squares(&self, mut sums: Vec<f64>, closeness: Closeness) -> Option<Guess> {
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
        let mut found = closeness.solve(
            &CscMatrix::identity(unknowns),
            &vec![0.0; unknowns],
            &matrix,
            &sums,
            &[ZeroConeT(equations), NonnegativeConeT(unknowns)],
        )?;
        let slacks = found.z.split_off(equations);
        // Of the program as it is posed there, with the other sign.
        let multipliers = found.z.iter().map(|y| -y).collect();
        Some(Guess::new(found.x, multipliers, slacks))
    }

    /// Returns exact x ≥ 0 of which only those are positive that the guess says.
    pub(crate) fn exact_unknowns(&self, guess: &Guess) -> Option<Vec<BigRational>> {
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
    pub(crate) fn exact_multipliers(&self, guess: &Guess) -> Option<Vec<BigRational>> {
        let Aim::Cost(cost) = &self.aim else {
            return None;
        };
        let of_positive = self.columns.iter().zip(cost).zip(&guess.positive);
        let equations = of_positive.filter(|(_, positive)| **positive);
        let equations =
            equations.map(|((column, cost), _)| (column.iter().cloned().collect(), cost.clone()));
        near(equations.collect(), &guess.multipliers, |multipliers| {
            self.columns.iter().zip(cost).all(|(column, cost)| {
                let terms = column
                    .iter()
                    .map(|(equation, c)| c * &multipliers[*equation]);
                terms.fold(BigRational::zero(), |sum, term| sum + term) <= *cost
            })
        })
    }

    /// The program with sums of order 1, and what they were divided by.
    pub(crate) fn scaled(mut self) -> (Self, BigRational) {
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

impl Closeness {
    /// Minimises q x + ½ x P x over A x + s = b, with s in the cones.
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

/// A third of the iterations less than what clarabel holds to be close.
const LOOSE: f64 = 1e-5;

fn floats(numbers: &[BigRational]) -> Option<Vec<f64>> {
    numbers.iter().map(BigRational::to_f64).collect()
}

/// Returns a certificate if the checker accepts it.
///
/// # Errors
/// [`TooLarge`](cannonpile::Error::TooLarge) if it would not fit into memory; `refused` if it is refused.
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

/// Returns a certificate that formulas have made, checked where programs are solved too; of larger piles theorems vouch for
/// the formulas.
///
/// # Errors
/// [`Bug`](cannonpile::Error::Bug) if it is refused.
pub(crate) fn of_formulas(certificate: Certificate) -> Result<Certificate, cannonpile::Error> {
    let directions = certificate.pile.dimension().number();
    let is_small = certificate.pile.sphere_count() * directions <= MOST_EQUATIONS.into();
    if is_small && certificate.check().is_err() {
        return Err(bug("a certificate that formulas have made is accepted"));
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

    /// Of forty layers, 34,440 equations, theorems vouch for what is claimed.
    #[test]
    fn what_formulas_have_made_is_accepted() {
        for made in [claimed(7, Claim::Stands), claimed(40, Claim::CannotStand)] {
            assert_eq!(of_formulas(made.clone()), Ok(made));
        }
    }

    #[test]
    #[cfg_attr(
        debug_assertions,
        should_panic(expected = "formulas have made is accepted")
    )]
    fn what_formulas_have_made_is_checked_where_programs_are_solved() {
        let refused = of_formulas(claimed(7, Claim::CannotStand));
        assert!(matches!(refused, Err(cannonpile::Error::Bug { .. })));
    }

    #[test]
    fn a_refusal_says_whether_the_pile_is_too_large() {
        let stands = claimed(4, Claim::Stands);
        let refused = || Error::NotSolved { equations: 7 };
        assert_eq!(accepted(stands.clone(), refused), Ok(stands));
        let cannot_stand = accepted(claimed(4, Claim::CannotStand), refused);
        assert_eq!(cannot_stand, Err(refused()));
        // Four and a half million spheres.
        let large = accepted(claimed(300, Claim::Stands), refused);
        assert!(
            matches!(large, Err(Error::Core(cannonpile::Error::TooLarge { .. }))),
            "{large:?}"
        );
    }
}
