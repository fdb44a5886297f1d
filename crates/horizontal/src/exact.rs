//! Exact factors of sparse linear equations, by Gaussian elimination.
//!
//! Row operations bring the equations into triangular form: each pivot row determines its pivot from unknowns with later
//! pivots and from free unknowns. The factors store the operations and the rows. They serve any right-hand side, and
//! also the transposed equations.
//!
//! Example: x + y = 1 and x − y = 0. The pivot of the first row is x, and −1 times this row is added to the second one:
//! −2y = −1. So y = 1/2, and x = 1 − 1/2.

use core::cmp::{Ordering, Reverse};
use core::mem;
use std::collections::BinaryHeap;

use cannonpile::engine::check_interrupt;
use cannonpile::scalar::{Field, FixedInteger, FixedRational};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

/// The numbers that are not zero, with their indices, in ascending order of the indices.
pub(crate) type Sparse<T = BigRational> = Vec<(usize, T)>;

/// A linear equation: coefficients by unknown, and the right-hand side.
pub(crate) type Equation = (Sparse, BigRational);

/// A scalar of exact arithmetic: a rational in machine words, or of any length.
pub(crate) trait Exact: Field {
    /// Returns the value, or `None` if it overflowed.
    fn value(&self) -> Option<BigRational>;

    /// Compares the value with zero. `None` if it overflowed.
    fn sign(&self) -> Option<Ordering>;
}

impl Exact for BigRational {
    fn value(&self) -> Option<BigRational> {
        Some(self.clone())
    }

    fn sign(&self) -> Option<Ordering> {
        Some(self.numer().cmp(&BigInt::ZERO))
    }
}

impl<I: FixedInteger> Exact for FixedRational<I> {
    fn value(&self) -> Option<BigRational> {
        self.to_rational()
    }

    fn sign(&self) -> Option<Ordering> {
        self.parts().map(|(numer, _)| numer.cmp(&I::zero()))
    }
}

/// Equations in triangular form.
pub(crate) struct Factors<T> {
    /// The row operations: a multiple of the first equation, by the factor, was subtracted from the second one.
    steps: Vec<(usize, usize, T)>,
    rows: Vec<Row<T>>,
}

/// A row of the triangular form, and the unknown that it determines.
struct Row<T> {
    equation: usize,
    pivot: usize,
    of_pivot: T,
    others: Sparse<T>,
}

/// Returns the solution of nonsingular equations, or `None` if they are singular or cancellation was requested.
///
/// Most coefficients are ±1 and stay short. So the elimination uses machine words if they suffice, and big rationals
/// otherwise.
pub(crate) fn solution(equations: &[Equation]) -> Option<Vec<BigRational>> {
    solution_in::<FixedRational<i64>>(equations).or_else(|| solution_in::<BigRational>(equations))
}

fn solution_in<T: Exact>(equations: &[Equation]) -> Option<Vec<BigRational>> {
    let factors = factors::<T>(equations)?;
    let sums = equations.iter().map(|(_, sum)| T::from_rational(sum));
    let is_regular = factors.rows.len() == equations.len();
    let solution = factors.solve(sums.collect(), vec![T::zero(); equations.len()])?;
    solution
        .iter()
        .map(T::value)
        .collect::<Option<_>>()
        .filter(|_| is_regular)
}

/// Returns a basis of the null space of square equations. `None` if cancellation was requested.
pub(crate) fn null_space(equations: &[Equation]) -> Option<Vec<Vec<BigRational>>> {
    let unknowns = equations.len();
    let zeros = vec![BigRational::default(); unknowns];
    let factors = factors::<BigRational>(equations)?;
    let mut is_free = vec![true; unknowns];
    for pivot in factors.pivots() {
        is_free[pivot] = false;
    }
    let free = (0..unknowns).filter(|unknown| is_free[*unknown]);
    free.map(|unknown| {
        let mut vector = zeros.clone();
        vector[unknown] = BigRational::one();
        factors.solve(zeros.clone(), vector)
    })
    .collect()
}

fn factors<T: Exact>(equations: &[Equation]) -> Option<Factors<T>> {
    let rows = equations.iter().map(|(row, _)| sparse(row));
    Factors::of(rows.collect(), |_| true)
}

/// Returns the numbers in another scalar.
pub(crate) fn sparse<T: Exact>(numbers: &Sparse) -> Sparse<T> {
    let numbers = numbers.iter();
    numbers.map(|(n, c)| (*n, T::from_rational(c))).collect()
}

impl<T: Exact> Factors<T> {
    /// Eliminates with the Markowitz rule: it takes the shortest equation, and as its pivot the unknown that occurs in
    /// the fewest other equations. Other unknowns become pivots only in equations without preferred ones.
    ///
    /// Equations that depend on others have no pivot. `None` on overflow or cancellation.
    pub(crate) fn of(
        mut equations: Vec<Sparse<T>>,
        is_preferred: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        // The equations with each unknown, in any order.
        let mut with: Vec<Vec<usize>> = Vec::new();
        for (number, coefficients) in equations.iter().enumerate() {
            for (unknown, coefficient) in coefficients {
                coefficient.is_defined().then_some(())?;
                with.resize(with.len().max(unknown + 1), Vec::new());
                with[*unknown].push(number);
            }
        }
        let mut is_left = vec![true; equations.len()];
        let (mut steps, mut rows) = (Vec::new(), Vec::new());
        for only_preferred in [true, false] {
            let lengths = equations.iter().map(Vec::len).zip(0..);
            let mut queue: BinaryHeap<_> = lengths.map(Reverse).collect();
            while let Some(Reverse((length, number))) = queue.pop() {
                // An equation is in the queue once for each length that it had.
                if !is_left[number] || equations[number].len() != length {
                    continue;
                }
                check_interrupt().ok()?;
                let unknowns = equations[number].iter().enumerate();
                let pivots = unknowns.filter(|(_, (u, _))| !only_preferred || is_preferred(*u));
                let Some((entry, _)) = pivots.min_by_key(|(_, (u, _))| with[*u].len()) else {
                    continue;
                };
                is_left[number] = false;
                let mut others = mem::take(&mut equations[number]);
                for (unknown, _) in &others {
                    remove(&mut with[*unknown], number);
                }
                let (pivot, of_pivot) = others.remove(entry);
                for other in mem::take(&mut with[pivot]) {
                    let coefficients = &mut equations[other];
                    let entry = place(coefficients, pivot).ok()?;
                    let factor = coefficients.remove(entry).1.checked_div(&of_pivot)?;
                    let mut is_defined = true;
                    merge(coefficients, &others, |unknown, entry, coefficient| {
                        let was_zero = entry.is_none();
                        // A coefficient that is not listed is 0.
                        let mut entry = entry.unwrap_or_else(T::zero);
                        subtract(&mut entry, coefficient, &factor);
                        is_defined &= entry.is_defined();
                        match (was_zero, entry.is_zero()) {
                            (true, false) => with[unknown].push(other),
                            (false, true) => remove(&mut with[unknown], other),
                            _ => {}
                        }
                        Some(entry).filter(|entry| !entry.is_zero())
                    });
                    is_defined.then_some(())?;
                    queue.push(Reverse((coefficients.len(), other)));
                    steps.push((number, other, factor));
                }
                rows.push(Row {
                    equation: number,
                    pivot,
                    of_pivot,
                    others,
                });
            }
        }
        Some(Self { steps, rows })
    }

    /// Returns the unknowns that are pivots.
    pub(crate) fn pivots(&self) -> impl Iterator<Item = usize> {
        self.rows.iter().map(|row| row.pivot)
    }

    /// Returns the solution for given right-hand sides, and for the given values of free unknowns.
    pub(crate) fn solve(&self, mut sums: Vec<T>, mut unknowns: Vec<T>) -> Option<Vec<T>> {
        for (from, to, factor) in &self.steps {
            if !sums[*from].is_zero() {
                let sum = sums[*from].clone();
                subtract(&mut sums[*to], &sum, factor);
            }
        }
        for row in self.rows.iter().rev() {
            let mut rest = mem::replace(&mut sums[row.equation], T::zero());
            for (unknown, coefficient) in &row.others {
                subtract(&mut rest, coefficient, &unknowns[*unknown]);
            }
            unknowns[row.pivot] = if rest.is_zero() {
                rest
            } else {
                rest.checked_div(&row.of_pivot)?
            };
        }
        Some(unknowns)
    }

    /// Returns the multiplier of each equation for which the combined equation has the given coefficients at the pivots.
    ///
    /// The coefficients of free unknowns are ignored.
    pub(crate) fn solve_transposed(
        &self,
        mut coefficients: Vec<T>,
        equations: usize,
    ) -> Option<Vec<T>> {
        let mut multipliers = vec![T::zero(); equations];
        for row in &self.rows {
            let rest = &coefficients[row.pivot];
            if rest.is_zero() {
                continue;
            }
            let multiplier = rest.checked_div(&row.of_pivot)?;
            for (unknown, coefficient) in &row.others {
                subtract(&mut coefficients[*unknown], coefficient, &multiplier);
            }
            multipliers[row.equation] = multiplier;
        }
        for (from, to, factor) in self.steps.iter().rev() {
            if !multipliers[*to].is_zero() {
                let multiplier = multipliers[*to].clone();
                subtract(&mut multipliers[*from], &multiplier, factor);
            }
        }
        Some(multipliers)
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

/// Subtracts a product from a number.
pub(crate) fn subtract<T: Exact>(from: &mut T, one: &T, other: &T) {
    if !(one.is_zero() || other.is_zero()) {
        let number = mem::replace(from, T::zero());
        *from = number - &(one.clone() * other);
    }
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
        let found = solution(&chain()).unwrap();
        let power = |exponent: u32| {
            BigRational::from_integer(num_bigint::BigInt::from(great).pow(exponent))
        };
        assert_eq!(found, [power(2), power(1), power(0), power(1).recip()]);
        let mut singular = chain();
        singular[3] = singular[2].clone();
        assert_eq!(solution(&singular), None);
        let beyond = vec![(vec![(0, power(3))], power(4))];
        assert_eq!(solution(&beyond).unwrap(), [power(1)]);
    }
}
