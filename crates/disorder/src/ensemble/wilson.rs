//! Confidence intervals of probabilities from samples.

use cannonpile::scalar::Algebra;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::Zero;

use super::{Choice, ContactSet, Tally};

/// z² = 1.96², in units of 10⁻⁴. A standard normal variable exceeds z with probability 2.5 %.
const SQUARE: u32 = 38_416;

/// The number of decimal digits of the root.
const DIGITS: u32 = 18;

impl Tally {
    /// Returns a confidence interval for the probability that a random stacking stands, at the fault probability of the
    /// samples. It is Wilson's interval, which contains the true value in about 95 % of cases.
    ///
    /// Returns `None` if the run visited all stackings, because [the probability](Self::standing_probability) is then
    /// exact. Also returns `None` for horizontal contacts if the run did not count them.
    ///
    /// On a base only the samples that the base supports count, and the probability is that of a supported stacking. Without
    /// any of them the result is `None`.
    ///
    /// With k of n samples standing and z = 1.96 the bounds are (k + z²/2 ± z√(k(n−k)/n + z²/4))/(n + z²). The root has
    /// an error of at most 10⁻⁹/n. The bounds are then correctly rounded.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{ContactSet, Choice, Ensemble, FirstSign, RandomStackings, Samples, Shard};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(6, FirstSign::Random)?;
    /// let half = BigRational::new(1.into(), 2.into());
    /// let drawn = Choice::Drawn(Samples::new(1000, 1, half)?);
    /// let tally = Ensemble::under(Region::SITE, stackings)?.run(&drawn, Shard::WHOLE)?;
    /// let [lower, upper] = tally.standing_interval(ContactSet::Sloping).unwrap();
    /// // The probability is 11/16.
    /// assert!(lower < 0.6875 && 0.6875 < upper && upper - lower < 0.06);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn standing_interval(&self, by: ContactSet) -> Option<[f64; 2]> {
        if self.choice == Choice::All {
            return None;
        }
        interval(&self.standing(by)?, &self.stackings())
    }
}

/// Returns Wilson's interval for k of n samples, or `None` for n = 0.
fn interval(k: &BigUint, n: &BigUint) -> Option<[f64; 2]> {
    if n.is_zero() || k > n {
        return None;
    }
    // The common denominator is 2n(n + z²), and the numerators are n(2k + z²) ± z√(n(4k(n−k) + z²n)). All are scaled by
    // 10⁴, since z² is in units of 10⁻⁴.
    let unit = BigUint::from(10_000_u32);
    let others = n - k;
    let radicand = n * (k * others * 4_u32 * &unit + n * SQUARE) * SQUARE;
    let tens = |power| BigInt::from(num_traits::pow(BigUint::from(10_u32), power as usize));
    let root = (BigInt::from(radicand) * tens(2 * DIGITS)).sqrt();
    let middle = BigInt::from(n * (k * 2_u32 * &unit + SQUARE)) * tens(DIGITS);
    let all = BigInt::from(n * 2_u32 * (n * &unit + SQUARE)) * tens(DIGITS);
    let bound = |numerator: BigInt| f64::from_rational(&BigRational::new(numerator, all.clone()));
    Some([bound(&middle - &root), bound(&middle + &root)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_solve_the_equation_of_wilson() {
        for (k, n) in [
            (0_u32, 10_u32),
            (10, 10),
            (3, 7),
            (500, 1000),
            (1, 1_000_000),
        ] {
            let [lower, upper] = interval(&k.into(), &n.into()).unwrap();
            let (x, m, z) = (f64::from(k), f64::from(n), 1.96_f64);
            // The bounds p solve (k − np)² = z² n p(1−p).
            for p in [lower, upper] {
                let left = (x - m * p) * (x - m * p);
                let right = z * z * m * p * (1.0 - p);
                assert!((left - right).abs() < 1e-6 * (1.0 + m), "{k} of {n}: {p}");
            }
            assert!(lower <= x / m && x / m <= upper);
        }
        assert_eq!(interval(&0_u32.into(), &0_u32.into()), None);
    }
}
