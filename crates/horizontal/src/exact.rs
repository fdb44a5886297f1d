//! Exact solution of sparse linear equations near a float solution.
//!
//! Example: the equation x + y = 1 with the float solution (0.3333, 0.6667) leaves one unknown free, say y. It is
//! rounded to fractions with growing denominators, and x follows exactly: first (0, 1), then (1/3, 2/3). The first
//! solution that the caller accepts is returned.

use core::cmp::Reverse;
use core::mem;
use core::num::NonZeroI64;
use std::collections::BinaryHeap;

use cannonpile::engine::check_interrupt;
use cannonpile::scalar::{Algebra, Field, FixedRational};
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use crate::ONE;

/// The limits for the denominators of rounded unknowns, tried in this order.
const DENOMINATORS: [i64; 6] = [1, 2, 12, 1000, 1_000_000, 1_000_000_000];

/// The numbers that are not zero, with their indices, in ascending order of the indices.
pub(crate) type Sparse<T = BigRational> = Vec<(usize, T)>;

/// A linear equation: coefficients by unknown, and the right-hand side.
pub(crate) type Equation<T = BigRational> = (Sparse<T>, T);

/// Equations in triangular form. Each one determines its pivot from unknowns with later pivots and free unknowns.
struct Triangular<T>(Vec<(usize, Equation<T>)>);

/// The reason why the elimination failed.
enum Failure {
    /// The equations are inconsistent.
    Contradiction,
    /// A value overflowed its scalar type.
    Overflow,
    /// Cancellation was requested.
    Interrupted,
}

/// Returns an exact solution of the equations that `accepted` accepts, close to `guess`, or `None` if none was
/// found.
///
/// Free unknowns, and unknowns that occur in no equation, are rounded to fractions, with small denominators first,
/// so that the exact numbers stay short.
///
/// Most coefficients are ±1 and stay short. So the elimination uses machine words if they suffice, and big
/// rationals otherwise.
pub(crate) fn near(
    equations: Vec<Equation>,
    guess: &[f64],
    accepted: &dyn Fn(&[BigRational]) -> bool,
) -> Option<Vec<BigRational>> {
    let in_words = match Triangular::of(equations.iter().map(in_words).collect()) {
        Ok(triangular) => Some(triangular),
        Err(Failure::Overflow) => None,
        Err(Failure::Contradiction | Failure::Interrupted) => return None,
    };
    let mut equations = Some(equations);
    let mut of_any_length = None;
    for most in DENOMINATORS {
        let rounded = guess.iter().map(|guess| simple_fraction(*guess, most));
        let rounded: Vec<(i64, NonZeroI64)> = rounded.collect::<Option<_>>()?;
        let short = in_words.as_ref().and_then(|t| t.solution(&rounded));
        let short = short.and_then(|solution| {
            let solution = solution.iter().map(FixedRational::to_rational);
            solution.collect::<Option<Vec<_>>>()
        });
        let solution = if let Some(solution) = short {
            solution
        } else {
            if let Some(equations) = equations.take() {
                of_any_length = Triangular::of(equations).ok();
            }
            of_any_length.as_ref()?.solution(&rounded)?
        };
        if accepted(&solution) {
            return Some(solution);
        }
    }
    None
}

/// Returns a basis of the null space of square equations. `None` if cancellation was requested.
pub(crate) fn null_space(mut equations: Vec<Equation>) -> Option<Vec<Vec<BigRational>>> {
    for (_, sum) in &mut equations {
        sum.set_zero();
    }
    let unknowns = equations.len();
    let triangular = Triangular::of(equations).ok()?;
    let free = triangular.free(unknowns).into_iter().map(|unknown| {
        let one = |other: usize| (i64::from(other == unknown), ONE);
        triangular.solution(&(0..unknowns).map(one).collect::<Vec<_>>())
    });
    free.collect()
}

/// Returns the equation in machine words. Values that do not fit become undefined.
fn in_words((coefficients, sum): &Equation) -> Equation<FixedRational<i64>> {
    let mut in_words = Vec::with_capacity(coefficients.len());
    for (unknown, coefficient) in coefficients {
        in_words.push((*unknown, FixedRational::from_rational(coefficient)));
    }
    (in_words, FixedRational::from_rational(sum))
}

impl<T: Field> Triangular<T> {
    /// Eliminates with the Markowitz rule: it takes the shortest equation, and as its pivot the unknown that occurs in
    /// the fewest other equations.
    fn of(mut equations: Vec<Equation<T>>) -> Result<Self, Failure> {
        // The equations with each unknown, in any order.
        let mut with: Vec<Vec<usize>> = Vec::new();
        let mut queue = BinaryHeap::with_capacity(equations.len());
        for (number, (coefficients, sum)) in equations.iter().enumerate() {
            let mut numbers = coefficients.iter().map(|(_, c)| c).chain([sum]);
            if !numbers.all(T::is_defined) {
                return Err(Failure::Overflow);
            }
            for (unknown, _) in coefficients {
                with.resize(with.len().max(unknown + 1), Vec::new());
                with[*unknown].push(number);
            }
            queue.push(Reverse((coefficients.len(), number)));
        }
        let mut is_left = vec![true; equations.len()];
        let mut solved = Vec::new();
        while let Some(Reverse((length, number))) = queue.pop() {
            // An equation is in the queue once for each length that it had.
            if !is_left[number] || equations[number].0.len() != length {
                continue;
            }
            check_interrupt().map_err(|_| Failure::Interrupted)?;
            is_left[number] = false;
            let (coefficients, sum) = mem::replace(&mut equations[number], (Vec::new(), T::zero()));
            for (unknown, _) in &coefficients {
                remove(&mut with[*unknown], number);
            }
            let rarest = coefficients.iter().min_by_key(|(u, _)| with[*u].len());
            let Some((pivot, of_pivot)) = rarest else {
                if sum.is_zero() {
                    continue;
                }
                return Err(Failure::Contradiction);
            };
            for other in mem::take(&mut with[*pivot]) {
                let (coefficients_of_other, sum_of_other) = &mut equations[other];
                let entry = place(coefficients_of_other, *pivot).ok();
                let entry = entry.map(|entry| &coefficients_of_other[entry].1);
                let factor = entry.and_then(|entry| entry.clone().checked_div(of_pivot));
                let factor = factor.ok_or(Failure::Overflow)?;
                let mut is_defined = true;
                merge(coefficients_of_other, &coefficients, |unknown, entry, c| {
                    if unknown == *pivot {
                        return None;
                    }
                    let was_zero = entry.is_none();
                    // A coefficient that is not listed is 0.
                    let entry = entry.unwrap_or_else(T::zero) - &(c.clone() * &factor);
                    is_defined &= entry.is_defined();
                    match (was_zero, entry.is_zero()) {
                        (true, false) => with[unknown].push(other),
                        (false, true) => remove(&mut with[unknown], other),
                        _ => {}
                    }
                    Some(entry).filter(|entry| !entry.is_zero())
                });
                *sum_of_other = mem::replace(sum_of_other, T::zero()) - &(sum.clone() * &factor);
                if !(is_defined && sum_of_other.is_defined()) {
                    return Err(Failure::Overflow);
                }
                queue.push(Reverse((coefficients_of_other.len(), other)));
            }
            solved.push((*pivot, (coefficients, sum)));
        }
        Ok(Self(solved))
    }

    /// Returns the free unknowns among `unknowns` unknowns.
    fn free(&self, unknowns: usize) -> Vec<usize> {
        let mut is_free = vec![true; unknowns];
        for (pivot, _) in &self.0 {
            is_free[*pivot] = false;
        }
        (0..unknowns).filter(|unknown| is_free[*unknown]).collect()
    }

    /// Returns the solution for given values of the free unknowns, as numerators and denominators. `None` on
    /// overflow or cancellation.
    fn solution(&self, free: &[(i64, NonZeroI64)]) -> Option<Vec<T>> {
        let fraction = |(n, d): &(i64, NonZeroI64)| T::from_i128((*n).into()).div_int(*d);
        let mut solution: Vec<T> = free.iter().map(fraction).collect();
        for (pivot, (coefficients, sum)) in self.0.iter().rev() {
            check_interrupt().ok()?;
            let (mut rest, mut of_pivot) = (sum.clone(), None);
            for (unknown, coefficient) in coefficients {
                if unknown == pivot {
                    of_pivot = Some(coefficient);
                } else {
                    rest = rest - &(coefficient.clone() * &solution[*unknown]);
                }
            }
            solution[*pivot] = rest.checked_div(of_pivot?)?;
        }
        Some(solution)
    }
}

/// Returns the position of the number at an index, or the position at which to insert it.
pub(crate) fn place<T>(numbers: &Sparse<T>, index: usize) -> Result<usize, usize> {
    numbers.binary_search_by_key(&index, |(index, _)| *index)
}

/// Replaces the number at each index of `from` by what `combine` returns for the index, this number, and that of `from`.
pub(crate) fn merge<T>(
    to: &mut Sparse<T>,
    from: &Sparse<T>,
    mut combine: impl FnMut(usize, Option<T>, &T) -> Option<T>,
) {
    let merged = Vec::with_capacity(to.len() + from.len());
    let mut before = mem::replace(to, merged).into_iter().peekable();
    for (index, number) in from {
        while let Some(entry) = before.next_if(|(at, _)| at < index) {
            to.push(entry);
        }
        let here = before.next_if(|(at, _)| at == index);
        let combined = combine(*index, here.map(|(_, number)| number), number);
        to.extend(combined.map(|number| (*index, number)));
    }
    to.extend(before);
}

/// Removes a number from a list that contains it once.
fn remove(list: &mut Vec<usize>, number: usize) {
    if let Some(place) = list.iter().position(|other| *other == number) {
        list.swap_remove(place);
    }
}

/// Returns numerator and denominator of a convergent of the continued fraction of a float.
///
/// The result is the first convergent that equals the float within its precision, or else the last one with a
/// denominator of at most `most`. For `most` = 1 it is the nearest integer. `None` if the number is not finite or
/// exceeds 10¹⁵.
pub(crate) fn simple_fraction(number: f64, most: i64) -> Option<(i64, NonZeroI64)> {
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
    Some((numerator, NonZeroI64::new(denominator)?))
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
    fn convergents_have_small_denominators() {
        let found = [
            (0.333_333_333_4, 12),
            (2.5, 1),
            (-0.25, 12),
            (7.0, 1),
            (0.1428, 12),
        ];
        let found = found.map(|(number, most)| {
            let (n, d) = simple_fraction(number, most).unwrap();
            ratio(n, d.get())
        });
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
        // The next partial quotient exceeds all machine integers.
        for tiny in [1e-20, -1e-20, 1e-300] {
            let (n, d) = simple_fraction(tiny, 12).unwrap();
            assert_eq!(ratio(n, d.get()), ratio(0, 1), "{tiny}");
        }
        assert_eq!(simple_fraction(f64::NAN, 12), None);
        assert_eq!(simple_fraction(1e300, 12), None);
        let one = NonZeroI64::new(1).unwrap();
        assert_eq!(
            simple_fraction(1e15, 12),
            Some((1_000_000_000_000_000, one))
        );
        assert_eq!(simple_fraction(-2e15, 12), None);
        assert_eq!(simple_fraction(f64::INFINITY, 12), None);
    }

    /// Numbers that exceed a machine word, from the start or during elimination, are handled in big rationals.
    #[test]
    fn overflow_falls_back_to_big_rationals() {
        let great = 1_i64 << 40;
        let chain = || {
            let link = |n: usize| equation(&[(n, 1), (n + 1, -great)], 0);
            let mut equations: Vec<Equation> = (0..3).map(link).collect();
            equations.push(equation(&[(3, great)], 1));
            equations
        };
        let solution = near(chain(), &[0.0; 4], &|_| true).unwrap();
        let power = |exponent: u32| {
            BigRational::from_integer(num_bigint::BigInt::from(great).pow(exponent))
        };
        assert_eq!(solution, [power(2), power(1), power(0), power(1).recip()]);
        let mut contradiction = chain();
        contradiction.push((
            vec![(0, power(0))],
            power(2) + BigRational::from_integer(1.into()),
        ));
        assert_eq!(near(contradiction, &[0.0; 4], &|_| true), None);
        let beyond = vec![(vec![(0, power(3))], power(4))];
        assert_eq!(near(beyond, &[0.0], &|_| true).unwrap(), [power(1)]);
    }

    #[test]
    fn solutions_satisfy_equations() {
        let equations = || {
            vec![
                equation(&[(0, 2), (1, 1), (2, -1)], 3),
                equation(&[(1, 3), (2, 1)], 1),
                equation(&[(0, 4), (1, 5), (2, -1)], 7),
            ]
        };
        let guess = [1.4, 0.07, 0.8];
        let solution = near(equations(), &guess, &|_| true).unwrap();
        for (coefficients, sum) in equations() {
            let total: BigRational = coefficients
                .iter()
                .map(|(unknown, c)| c * &solution[*unknown])
                .sum();
            assert_eq!(total, sum);
        }
        let mut contradiction = equations();
        contradiction.push(equation(&[(0, 4), (1, 5), (2, -1)], 8));
        assert_eq!(near(contradiction, &guess, &|_| true), None);
    }
}
