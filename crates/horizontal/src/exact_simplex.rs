//! An exact simplex method: linear programs over compressive forces, solved in rationals.
//!
//! # Program
//! Minimise Σ cost · x over x ≥ 0 with Σ column · x = sums. The columns of the sloping forces are a triangular, so
//! nonsingular, matrix. Hence a basis always exists, no equation is redundant, and no artificial unknowns are needed.
//! Each program of this crate has a lower bound, so it is either infeasible or has an optimal vertex.
//!
//! # Start
//! A float solver suggests the unknowns that are positive. Gaussian elimination makes as many of them basic as are
//! independent, and completes them to a basis by others. This basis can be neither primal nor dual feasible. Usually it
//! is optimal or a few steps away. Without a suggestion the basis is that of the isostatic forces: all sloping ones.
//!
//! # Steps
//! 1. *Dual steps* until no basic unknown is negative. Reduced costs that are not positive are replaced by small
//!    positive ones meanwhile, so the basis is dual feasible for changed costs, and ties are rare. If a row of the
//!    tableau has a negative value and no negative entry, the program is infeasible, whatever the costs.
//! 2. *Primal steps* with the given costs, until no reduced cost is negative.
//!
//! The entering or leaving unknown is the most negative one. After [`MAX_STALLED`] steps that leave the objective
//! unchanged, Bland's rule takes the first one. It prevents cycling, so the method ends for every input.
//!
//! # Arithmetic
//! [`Factors`] of the basis serve its equations and the transposed ones. Each step adds an elementary matrix. The numbers
//! are fractions in machine words. After an overflow the method continues from the last basis in longer ones, and at last
//! in big rationals.

use std::borrow::Cow;
use std::sync::atomic::{AtomicU64, Ordering};

use cannonpile::engine::{bug, check_interrupt};
use cannonpile::scalar::FixedRational;
use num_rational::BigRational;

use crate::Error;
use crate::exact::{Exact, Factors, Sparse, sparse, subtract};

/// The exact result of a linear program.
pub(crate) enum Solution {
    /// An optimal vertex x, by unknown, and optimal multipliers y, by equation, with Σ column · y ≤ cost.
    Optimal {
        unknowns: Vec<BigRational>,
        multipliers: Vec<BigRational>,
    },
    /// No x ≥ 0 satisfies the equations.
    Infeasible,
}

/// The number of steps in a row that leave the objective unchanged, after which Bland's rule applies.
const MAX_STALLED: usize = 200;

/// The number of steps after which the basis is factored again.
const MAX_STEPS: usize = 40;

/// The steps of all exact programs of this process.
static PIVOTS: AtomicU64 = AtomicU64::new(0);

/// Returns the number of exact simplex steps (pivots) that this process has made so far.
///
/// Most programs need none: the basis that the float solver suggests is optimal.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_horizontal::{equilibrium, exact_pivots};
///
/// let before = exact_pivots();
/// // The isostatic forces decide, and no program is solved.
/// equilibrium(&Pile::triangular(4)?)?;
/// assert_eq!(exact_pivots(), before);
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[must_use]
pub fn exact_pivots() -> u64 {
    PIVOTS.load(Ordering::Relaxed)
}

/// A linear program: minimise Σ cost · x over x ≥ 0 with Σ column · x = sums.
pub(crate) struct Program<'n> {
    /// The columns of the matrix, by unknown: coefficients by equation. Those of the sloping forces come first, and are
    /// nonsingular.
    pub(crate) columns: Cow<'n, [Sparse]>,
    /// The right-hand sides, by equation.
    pub(crate) sums: Vec<BigRational>,
    /// The costs, by unknown.
    pub(crate) cost: Vec<BigRational>,
}

/// Solves a linear program, from a basis with as many of the suggested unknowns as possible.
///
/// # Errors
/// [`Interrupted`](cannonpile::Error::Interrupted).
pub(crate) fn solve(program: &Program<'_>, mut suggested: Vec<bool>) -> Result<Solution, Error> {
    let solution = Tableau::<FixedRational<i64>>::solution(program, &mut suggested)
        .or_else(|| Tableau::<FixedRational<i128>>::solution(program, &mut suggested))
        .or_else(|| Tableau::<BigRational>::solution(program, &mut suggested));
    check_interrupt()?;
    Ok(solution.ok_or_else(|| bug("the program has a lower bound"))?)
}

struct Tableau<T> {
    columns: Vec<Sparse<T>>,
    sums: Vec<T>,
    cost: Vec<T>,
    factors: Factors<T>,
    changes: Vec<Change<T>>,
    is_basic: Vec<bool>,
    /// The values of all unknowns, zero if not basic.
    values: Vec<T>,
    /// The reduced costs of all unknowns, zero if basic.
    reduced: Vec<T>,
    stalled: usize,
}

/// A change of the basis.
struct Change<T> {
    leaving: usize,
    entering: usize,
    /// The entry of the leaving unknown in the column of the entering one.
    pivot: T,
    /// The other entries of this column.
    others: Sparse<T>,
}

impl<T: Exact> Tableau<T> {
    /// Returns the solution, or `None` on overflow or cancellation. Then `suggested` contains the last basis.
    fn solution(program: &Program<'_>, suggested: &mut Vec<bool>) -> Option<Solution> {
        let mut tableau = Self {
            columns: program.columns.iter().map(sparse).collect(),
            sums: program.sums.iter().map(T::from_rational).collect(),
            cost: program.cost.iter().map(T::from_rational).collect(),
            factors: Factors::of(Vec::new(), |_| true)?,
            changes: Vec::new(),
            is_basic: suggested.clone(),
            values: Vec::new(),
            reduced: Vec::new(),
            stalled: 0,
        };
        tableau.factor()?;
        let solution = tableau.solved();
        suggested.clone_from(&tableau.is_basic);
        solution
    }

    fn solved(&mut self) -> Option<Solution> {
        let exact = |numbers: &[T]| numbers.iter().map(T::value).collect::<Option<Vec<_>>>();
        if !self.make_feasible()? {
            return Some(Solution::Infeasible);
        }
        let mut multipliers = self.price()?;
        // An overflow of a reduced cost would hide that it is negative, so they are computed anew after all steps.
        while self.minimise()? {
            multipliers = self.price()?;
        }
        let unknowns = exact(&self.values)?;
        exact(&self.reduced)?;
        Some(Solution::Optimal {
            unknowns,
            multipliers: exact(&multipliers)?,
        })
    }

    /// Factors the basis, after completing it, and computes the values of the unknowns.
    fn factor(&mut self) -> Option<()> {
        let mut rows = vec![Sparse::new(); self.sums.len()];
        let is_complete = self.changes.len() == MAX_STEPS;
        for (unknown, column) in self.columns.iter().enumerate() {
            if self.is_basic[unknown] || (!is_complete && unknown < rows.len()) {
                for (equation, coefficient) in column {
                    rows[*equation].push((unknown, coefficient.clone()));
                }
            }
        }
        self.factors = Factors::of(rows, |unknown| self.is_basic[unknown])?;
        self.is_basic.fill(false);
        for pivot in self.factors.pivots() {
            self.is_basic[pivot] = true;
        }
        self.changes.clear();
        self.values = self.basic(self.sums.clone())?;
        Some(())
    }

    fn zeros(&self) -> Vec<T> {
        vec![T::zero(); self.columns.len()]
    }

    /// Returns the values of the basic unknowns for which the columns add up to the given sums.
    fn basic(&self, sums: Vec<T>) -> Option<Vec<T>> {
        let mut values = self.factors.solve(sums, self.zeros())?;
        for change in &self.changes {
            let value = core::mem::replace(&mut values[change.leaving], T::zero());
            let value = value.checked_div(&change.pivot)?;
            for (unknown, entry) in &change.others {
                subtract(&mut values[*unknown], entry, &value);
            }
            values[change.entering] = value;
        }
        Some(values)
    }

    /// Returns the multipliers for which the columns of the basic unknowns have the given products.
    fn multipliers(&self, mut products: Vec<T>) -> Option<Vec<T>> {
        for change in self.changes.iter().rev() {
            let mut product = products[change.entering].clone();
            for (unknown, entry) in &change.others {
                subtract(&mut product, entry, &products[*unknown]);
            }
            products[change.leaving] = product.checked_div(&change.pivot)?;
        }
        self.factors.solve_transposed(products, self.sums.len())
    }

    /// Returns the negative products of the multipliers with the columns of the unknowns that are not basic.
    fn products(&self, multipliers: &[T]) -> Vec<T> {
        let mut products = self.zeros();
        for (unknown, column) in self.columns.iter().enumerate() {
            if !self.is_basic[unknown] {
                for (equation, coefficient) in column {
                    subtract(&mut products[unknown], coefficient, &multipliers[*equation]);
                }
            }
        }
        products
    }

    /// Computes the reduced costs, and returns the multipliers.
    fn price(&mut self) -> Option<Vec<T>> {
        let multipliers = self.multipliers(self.cost.clone())?;
        self.reduced = self.products(&multipliers);
        for (unknown, cost) in self.cost.iter().enumerate() {
            if !self.is_basic[unknown] {
                subtract(&mut self.reduced[unknown], &-T::one(), cost);
            }
        }
        Some(multipliers)
    }

    /// Returns the row of a basic unknown.
    fn row(&self, unknown: usize) -> Option<Vec<T>> {
        let mut unit = self.zeros();
        unit[unknown] = -T::one();
        Some(self.products(&self.multipliers(unit)?))
    }

    /// Makes dual steps until no basic unknown is negative. Returns `false` if a row proves that this is impossible.
    fn make_feasible(&mut self) -> Option<bool> {
        self.price()?;
        for (unknown, reduced) in self.reduced.iter_mut().enumerate() {
            if !self.is_basic[unknown] && !is_positive(reduced) {
                // Between 1/64 and 1/32.
                let numerator = 64 + 37 * unknown % 64;
                *reduced = T::from_rational(&BigRational::new(numerator.into(), 4096.into()));
            }
        }
        while let Some(leaving) = self.most_negative(&self.values) {
            let row = self.row(leaving)?;
            let falling = (0..row.len()).filter(|unknown| is_negative(&row[*unknown]));
            let falling: Vec<usize> = falling.collect();
            if falling.is_empty() {
                return row.iter().all(T::is_defined).then_some(false);
            }
            let ratio = |unknown: usize| self.reduced[unknown].checked_div(&-row[unknown].clone());
            let entering = first(falling, ratio)?;
            self.exchange(leaving, entering, self.column(entering)?, &row)?;
        }
        self.values.iter().all(T::is_defined).then_some(true)
    }

    /// Makes primal steps until no reduced cost is negative. Returns whether there was any.
    fn minimise(&mut self) -> Option<bool> {
        let mut has_changed = false;
        while let Some(entering) = self.most_negative(&self.reduced) {
            has_changed = true;
            let column = self.column(entering)?;
            let falling = (0..column.len()).filter(|unknown| is_positive(&column[*unknown]));
            let leaving = first(falling, |unknown| {
                self.values[unknown].checked_div(&column[unknown])
            })?;
            let row = self.row(leaving)?;
            self.exchange(leaving, entering, column, &row)?;
        }
        Some(has_changed)
    }

    /// Returns the most negative number, or the first one if the objective does not change any more.
    fn most_negative(&self, numbers: &[T]) -> Option<usize> {
        let mut negative = (0..numbers.len()).filter(|unknown| is_negative(&numbers[*unknown]));
        if self.stalled > MAX_STALLED {
            return negative.next();
        }
        first(negative, |unknown| Some(numbers[unknown].clone()))
    }

    /// Returns the column of an unknown in terms of the basis.
    fn column(&self, unknown: usize) -> Option<Vec<T>> {
        let mut sums = vec![T::zero(); self.sums.len()];
        for (equation, coefficient) in &self.columns[unknown] {
            sums[*equation] = coefficient.clone();
        }
        self.basic(sums)
    }

    /// Exchanges a basic unknown and another one, with its column and the row of the basic one.
    fn exchange(
        &mut self,
        leaving: usize,
        entering: usize,
        mut column: Vec<T>,
        row: &[T],
    ) -> Option<()> {
        check_interrupt().ok()?;
        PIVOTS.fetch_add(1, Ordering::Relaxed);
        let pivot = core::mem::replace(&mut column[leaving], T::zero());
        let value = core::mem::replace(&mut self.values[leaving], T::zero()).checked_div(&pivot)?;
        let rate = core::mem::replace(&mut self.reduced[entering], T::zero())
            .checked_div(&row[entering])?;
        let has_stalled = value.is_zero() || rate.is_zero();
        self.stalled = usize::from(has_stalled) * (self.stalled + 1);
        let others: Vec<_> = column
            .into_iter()
            .enumerate()
            .filter(|(_, entry)| !entry.is_zero())
            .collect();
        for (unknown, entry) in &others {
            subtract(&mut self.values[*unknown], entry, &value);
            self.values[*unknown].is_defined().then_some(())?;
        }
        for (unknown, entry) in row.iter().enumerate() {
            if unknown != entering {
                subtract(&mut self.reduced[unknown], entry, &rate);
            }
        }
        self.reduced[leaving] = -rate;
        self.values[entering] = value;
        self.is_basic[leaving] = false;
        self.is_basic[entering] = true;
        let change = Change {
            leaving,
            entering,
            pivot,
            others,
        };
        self.changes.push(change);
        if self.changes.len() < MAX_STEPS {
            return Some(());
        }
        self.factor()
    }
}

fn is_negative<T: Exact>(number: &T) -> bool {
    number.sign().is_some_and(core::cmp::Ordering::is_lt)
}

fn is_positive<T: Exact>(number: &T) -> bool {
    number.sign().is_some_and(core::cmp::Ordering::is_gt)
}

/// Returns the candidate with the smallest ratio, and the first one of several. `None` on overflow or without candidates.
fn first<T: Exact>(
    candidates: impl IntoIterator<Item = usize>,
    ratio: impl Fn(usize) -> Option<T>,
) -> Option<usize> {
    let mut found: Option<(usize, T)> = None;
    for candidate in candidates {
        let ratio = ratio(candidate)?;
        let is_less = |(_, least): &(usize, T)| is_negative(&(ratio.clone() - least));
        if found.as_ref().is_none_or(is_less) {
            found = Some((candidate, ratio));
        }
    }
    found.map(|(candidate, _)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    /// Returns the solution with the given columns and costs, from the first columns.
    fn solved(columns: &[&[i64]], sums: &[i64], cost: &[i64]) -> Solution {
        let column = |column: &&[i64]| -> Sparse {
            let entries = column.iter().enumerate().filter(|(_, c)| **c != 0);
            entries
                .map(|(equation, c)| (equation, ratio(*c, 1)))
                .collect()
        };
        let whole = |numbers: &[i64]| numbers.iter().map(|n| ratio(*n, 1)).collect::<Vec<_>>();
        let columns: Vec<Sparse> = columns.iter().map(column).collect();
        let suggested: Vec<bool> = (0..columns.len())
            .map(|unknown| unknown < sums.len())
            .collect();
        let program = Program {
            columns: columns.into(),
            sums: whole(sums),
            cost: whole(cost),
        };
        solve(&program, suggested).unwrap()
    }

    fn optimum(solution: Solution) -> [Vec<BigRational>; 2] {
        match solution {
            Solution::Optimal {
                unknowns,
                multipliers,
            } => [unknowns, multipliers],
            Solution::Infeasible => panic!("the program is feasible"),
        }
    }

    /// Minimises 2x + 3y + z with x + z = 4 and x + y − z = 1. On the line x = 4 − z, y = 2z − 3 the cost is 5z − 1, with
    /// z ≥ 3/2.
    #[test]
    fn optimum_has_both_solutions() {
        let columns: [&[i64]; 3] = [&[1, 1], &[0, 1], &[1, -1]];
        let before = exact_pivots();
        let [unknowns, multipliers] = optimum(solved(&columns, &[4, 1], &[2, 3, 1]));
        assert_eq!(unknowns, [ratio(5, 2), ratio(0, 1), ratio(3, 2)]);
        assert_eq!(multipliers, [ratio(3, 2), ratio(1, 2)]);
        assert!(exact_pivots() > before);
    }

    #[test]
    fn program_can_be_infeasible() {
        // x + z = 1 and y + z = −1: the second equation has no solution.
        let columns: [&[i64]; 3] = [&[1, 0], &[0, 1], &[1, 1]];
        let solution = solved(&columns, &[1, -1], &[0; 3]);
        assert!(matches!(solution, Solution::Infeasible));
    }

    /// With words of 128 bits these numbers overflow.
    #[test]
    fn long_numbers_are_solved_too() {
        let great = i64::MAX;
        let columns: [&[i64]; 4] = [
            &[great, 0, 0],
            &[1 - great, great - 2, 0],
            &[0, 3 - great, great - 4],
            &[1, 1, 1],
        ];
        let [unknowns, multipliers] = optimum(solved(&columns, &[1, 1, 1], &[1, 1, 1, 1]));
        assert_eq!(unknowns[3], ratio(0, 1));
        let product = |column: &[i64]| -> BigRational {
            column
                .iter()
                .zip(&multipliers)
                .map(|(c, y)| ratio(*c, 1) * y)
                .sum()
        };
        assert!(columns.iter().all(|column| product(column) <= ratio(1, 1)));
    }

    /// The example of E. M. L. Beale on which the simplex method with the most negative price cycles.
    #[test]
    fn degenerate_program_ends() {
        let columns: [&[i64]; 7] = [
            &[1, 0, 0],
            &[0, 1, 0],
            &[0, 0, 1],
            &[1, 2, 0],
            &[-32, -48, 0],
            &[-4, -2, 4],
            &[36, 12, 0],
        ];
        // Both rows are multiplied by 4, and the third one too.
        let cost = [0, 0, 0, -3, 80, -2, 24];
        let [unknowns, _] = optimum(solved(&columns, &[0, 0, 4], &cost));
        let cost: BigRational = unknowns
            .iter()
            .zip(cost)
            .map(|(x, c)| x * ratio(c, 1))
            .sum();
        assert_eq!(cost, ratio(-5, 1));
    }
}
