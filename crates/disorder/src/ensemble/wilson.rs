//! What samples say of a probability.

use cannonpile::scalar::Algebra;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::Zero;

use super::{By, Choice, Tally};

/// 1.96², in 10⁻⁴: the square of what a normal variable exceeds in 2.5 % of cases.
const SQUARE: u32 = 38_416;

/// 10⁻¹⁸, of what is under the root; its own root is a power of ten.
const DIGITS: u32 = 18;

impl Tally {
    /// Returns bounds of the probability that a stacking stands, at the fault probability that the samples were drawn with:
    /// Wilson's interval, which holds the true value in about 95 % of cases. `None` of all stackings, where the probability
    /// [is known](Self::standing_probability), and with horizontal contacts where that was not asked.
    ///
    /// With k of n samples standing and z = 1.96 it is (k + z²/2 ± z√(k(n−k)/n + z²/4))/(n + z²). Rounded: the floats are those
    /// nearest to the bounds, but for errors of 10⁻⁹/n in the root.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{By, Choice, Ensemble, FirstSign, RandomStackings, Samples, Shard};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(6, FirstSign::Random)?;
    /// let half = BigRational::new(1.into(), 2.into());
    /// let drawn = Choice::Drawn(Samples::new(1000, 1, half)?);
    /// let tally = Ensemble::under(Region::SITE, stackings)?.run(&drawn, Shard::WHOLE)?;
    /// let [lower, upper] = tally.standing_interval(By::Sloping).unwrap();
    /// // 11 of 16.
    /// assert!(lower < 0.6875 && 0.6875 < upper && upper - lower < 0.06);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn standing_interval(&self, by: By) -> Option<[f64; 2]> {
        if self.choice == Choice::All {
            return None;
        }
        interval(&self.standing(by)?, &self.stackings())
    }
}

/// Wilson's interval for k of n; none of none.
fn interval(k: &BigUint, n: &BigUint) -> Option<[f64; 2]> {
    if n.is_zero() || k > n {
        return None;
    }
    // All over 2n(n + z²): n(2k + z²) ± z√(n(4k(n−k) + z²n)), with z² and the square of z in 10⁻⁴.
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
    fn intervals_are_those_of_the_formula() {
        for (k, n) in [
            (0_u32, 10_u32),
            (10, 10),
            (3, 7),
            (500, 1000),
            (1, 1_000_000),
        ] {
            let [lower, upper] = interval(&k.into(), &n.into()).unwrap();
            let (x, m, z) = (f64::from(k), f64::from(n), 1.96_f64);
            // Within the interval and nowhere else |k − np|² ≤ z² n p(1−p).
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
