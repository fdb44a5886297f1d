//! Definite sums of polynomials by Faulhaber's formula. The results are polynomials.

use alloc::vec::Vec;
use core::num::{NonZeroI64, NonZeroU32};

use num_traits::{One, Zero};

use super::{Polynomial, Symbol};
use crate::each::Each;
use crate::scalar::Algebra;

impl Polynomial {
    /// Returns Σ `self` over the integers `symbol` = `from` … `to`, as a polynomial in the other symbols.
    ///
    /// The result is F(`to` + 1) − F(`from`), where F(x+1) − F(x) = `self`. For `to` ≥ `from` − 1 it equals the sum
    /// term by term, which is empty for `to` = `from` − 1. For smaller `to` it is the analytic continuation. The bounds
    /// may contain any symbols. If they contain `symbol`, it denotes the symbol outside the sum.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::scalar::{Polynomial, Ring, Symbol};
    /// use num_traits::{One, Zero};
    ///
    /// let [k, l] = ["k", "L"].map(|name| Polynomial::from(Symbol(name)));
    /// let last = l - &Polynomial::one();
    /// let sum = k.sum(Symbol("k"), &Polynomial::zero(), &last);
    /// assert_eq!(sum.to_string(), "(L^2 - L)/2");
    /// ```
    #[must_use]
    pub fn sum(&self, symbol: Symbol, from: &Self, to: &Self) -> Self {
        if !(from.is_defined() && to.is_defined()) {
            return Self::fault();
        }
        let end = to.clone() + &Self::one();
        let degree = self.degree_in(symbol);
        let (ends, starts) = (power_sums(&end, degree), power_sums(from, degree));
        self.coefficients(symbol)
            .into_iter()
            .fold(Self::zero(), |sum, (power, coefficient)| {
                let [end, start] = [&ends, &starts].each(|sums| &sums[power as usize]);
                sum + &(coefficient * &(end.clone() - start))
            })
    }
}

/// Returns S_p(n) = 0^p + 1^p + … + (n−1)^p for p = 0 … `degree`.
///
/// From n^(p+1) = Σ_{m ≤ p} C(p+1, m) S_m(n): S_p = (n^(p+1) − Σ_{m < p} C(p+1, m) S_m)/(p+1).
fn power_sums(n: &Polynomial, degree: u32) -> Vec<Polynomial> {
    let mut sums: Vec<Polynomial> = Vec::new();
    let mut power = Polynomial::one();
    let mut divisor = NonZeroU32::MIN;
    // C(p+1, m) for m = 0 … p, a row of Pascal's triangle.
    let mut row: Vec<Polynomial> = Vec::from([Polynomial::one()]);
    for _ in 0..=degree {
        power = power * n;
        let known = row
            .iter()
            .zip(&sums)
            .fold(Polynomial::zero(), |known, (binomial, sum)| {
                known + &(binomial.clone() * sum)
            });
        sums.push((power.clone() - &known).div_int(NonZeroI64::from(divisor)));
        divisor = divisor.saturating_add(1);
        row = next_row(&row);
    }
    sums
}

/// Returns C(p+1, 0 … p), from C(p, 0 … p−1).
fn next_row(row: &[Polynomial]) -> Vec<Polynomial> {
    let mut next = Vec::with_capacity(row.len() + 1);
    let mut left = Polynomial::zero();
    for right in row {
        next.push(left + right);
        left = right.clone();
    }
    next.push(left + &Polynomial::one());
    next
}
