//! Exact solutions of sparse equations, near a guess.

use std::collections::{BTreeMap, BTreeSet};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use crate::engine::check_interrupt;

/// The greatest denominators to which free numbers are rounded, one after the other.
const DENOMINATORS: [i64; 6] = [1, 2, 12, 1000, 1_000_000, 1_000_000_000];

/// An equation: coefficients by unknown, and what they sum to.
pub(super) type Equation = (BTreeMap<usize, BigRational>, BigRational);

/// Equations in triangular form: each gives one unknown by those that are given after it, or by none.
struct Triangular(Vec<(usize, Equation)>);

/// Returns exact numbers that solve the equations and are accepted, close to the guess; `None` if there are none, or none
/// was found.
///
/// What the equations leave free is rounded to fractions, at first of small denominators, so that the exact numbers are
/// short. Unknowns that are in no equation are rounded too.
pub(super) fn near(
    equations: Vec<Equation>,
    guess: &[f64],
    accepted: impl Fn(&[BigRational]) -> bool,
) -> Option<Vec<BigRational>> {
    let triangular = Triangular::of(equations)?;
    DENOMINATORS.into_iter().find_map(|most| {
        let solution = triangular.solution(guess, most)?;
        accepted(&solution).then_some(solution)
    })
}

impl Triangular {
    /// By elimination: always the shortest equation is solved for the unknown that stands in fewest others. `None` if they
    /// contradict each other.
    fn of(mut equations: Vec<Equation>) -> Option<Self> {
        let mut with: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for (number, (coefficients, _)) in equations.iter().enumerate() {
            for unknown in coefficients.keys() {
                with.entry(*unknown).or_default().insert(number);
            }
        }
        let lengths = equations.iter().map(|(coefficients, _)| coefficients.len());
        let mut queue: BTreeSet<(usize, usize)> = lengths.zip(0..).collect();
        let mut solved = Vec::new();
        while let Some((_, number)) = queue.pop_first() {
            check_interrupt().ok()?;
            let (coefficients, sum) = core::mem::take(&mut equations[number]);
            for unknown in coefficients.keys() {
                with.get_mut(unknown)?.remove(&number);
            }
            let Some(pivot) = coefficients
                .keys()
                .copied()
                .min_by_key(|unknown| with[unknown].len())
            else {
                if sum.is_zero() {
                    continue;
                }
                return None;
            };
            for other in core::mem::take(with.get_mut(&pivot)?) {
                let (coefficients_of_other, sum_of_other) = &mut equations[other];
                queue.remove(&(coefficients_of_other.len(), other));
                let factor = coefficients_of_other.remove(&pivot)? / &coefficients[&pivot];
                for (unknown, coefficient) in coefficients
                    .iter()
                    .filter(|(unknown, _)| **unknown != pivot)
                {
                    let entry = coefficients_of_other
                        .entry(*unknown)
                        .or_insert_with(BigRational::zero);
                    *entry -= coefficient * &factor;
                    if entry.is_zero() {
                        coefficients_of_other.remove(unknown);
                        with.get_mut(unknown)?.remove(&other);
                    } else {
                        with.get_mut(unknown)?.insert(other);
                    }
                }
                *sum_of_other -= &factor * &sum;
                queue.insert((coefficients_of_other.len(), other));
            }
            solved.push((pivot, (coefficients, sum)));
        }
        Some(Self(solved))
    }

    /// With what is free rounded to fractions of denominators up to `most`. `None` if the guess is not finite.
    fn solution(&self, guess: &[f64], most: i64) -> Option<Vec<BigRational>> {
        let rounded = guess.iter().map(|guess| simple_fraction(*guess, most));
        let mut solution: Vec<BigRational> = rounded.collect::<Option<_>>()?;
        for (pivot, (coefficients, sum)) in self.0.iter().rev() {
            check_interrupt().ok()?;
            let others = coefficients.iter().filter(|(unknown, _)| *unknown != pivot);
            let rest = others.fold(sum.clone(), |rest, (unknown, coefficient)| {
                rest - coefficient * &solution[*unknown]
            });
            solution[*pivot] = rest / &coefficients[pivot];
        }
        Some(solution)
    }
}

/// Returns the first convergent of the continued fraction of a number that is as good as floats, or else the last with
/// a denominator up to `most`; with `most` = 1 the nearest integer. `None` if it is not finite, or too great for this.
fn simple_fraction(number: f64, most: i64) -> Option<BigRational> {
    const GREATEST: f64 = 1e15;
    const CLOSE: f64 = 1e-12;
    if !number.is_finite() || number.abs() > GREATEST {
        return None;
    }
    let (mut before, mut last) = ((0_i64, 1_i64), (1_i64, 0_i64));
    let mut rest = if most == 1 { number.round() } else { number };
    loop {
        let floor = rest.floor().to_i64()?;
        let next = |before: i64, last: i64| floor.checked_mul(last)?.checked_add(before);
        let (Some(numerator), Some(denominator)) = (next(before.0, last.0), next(before.1, last.1))
        else {
            break;
        };
        if denominator > most {
            break;
        }
        (before, last) = (last, (numerator, denominator));
        rest = (rest - rest.floor()).recip();
        if rest.recip() < CLOSE || !rest.is_finite() {
            break;
        }
    }
    let (numerator, denominator) = last;
    Some(BigRational::new(
        BigInt::from(numerator),
        BigInt::from(denominator),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    fn equation(coefficients: &[(usize, i64)], sum: i64) -> Equation {
        let coefficients = coefficients
            .iter()
            .map(|(unknown, c)| (*unknown, ratio(*c, 1)));
        (coefficients.collect(), ratio(sum, 1))
    }

    #[test]
    fn fractions_are_simple() {
        let found = [
            (0.333_333_333_4, 12),
            (2.5, 1),
            (-0.25, 12),
            (7.0, 1),
            (0.1428, 12),
        ];
        let found = found.map(|(number, most)| simple_fraction(number, most).unwrap());
        assert_eq!(
            found,
            [
                ratio(1, 3),
                ratio(3, 1),
                ratio(-1, 4),
                ratio(7, 1),
                ratio(1, 7)
            ]
        );
        assert_eq!(simple_fraction(f64::NAN, 12), None);
        assert_eq!(simple_fraction(1e300, 12), None);
    }

    #[test]
    fn solutions_solve() {
        let equations = || {
            vec![
                equation(&[(0, 2), (1, 1), (2, -1)], 3),
                equation(&[(1, 3), (2, 1)], 1),
                equation(&[(0, 4), (1, 5), (2, -1)], 7),
            ]
        };
        let guess = [1.4, 0.07, 0.8];
        let solution = near(equations(), &guess, |_| true).unwrap();
        for (coefficients, sum) in equations() {
            let total: BigRational = coefficients
                .iter()
                .map(|(unknown, c)| c * &solution[*unknown])
                .sum();
            assert_eq!(total, sum);
        }
        let mut contradiction = equations();
        contradiction.push(equation(&[(0, 4), (1, 5), (2, -1)], 8));
        assert_eq!(near(contradiction, &guess, |_| true), None);
    }
}
