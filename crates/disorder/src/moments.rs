//! Moments of the response to a load, and the waves of the mean response.

use cannonpile::engine::refuse_beyond;
use cannonpile::scalar::{Algebra, ByValue};
use cannonpile::stacking::Stacking;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::stackings::{FirstSign, MAX_RANDOM_LAYERS, RandomStackings, check_fault_probability};
use crate::Error;
use crate::TWO;
use crate::formula::{
    fourth_moment, fourth_moment_of_pair, mean_fourth_moment_of_pairs, mean_third_moment,
    third_moment, wave,
};

/// The moments of the loads v that a unit load on a wide flat top layer causes on the bottom layer, in powers of ρ = 2R
/// sinθ.
///
/// ρ is the horizontal part of a contact, r the horizontal distance from the line of the load, and φ the azimuth from α
/// under a + step. The moments of orders 0 and 1 are Σv = 1 and Σv r = 0. All values are exact. Theorems `point-load`,
/// `third-moment` and `fourth-moment` prove them for every stacking and for the mean.
///
/// # Examples
/// ```
/// use cannonpile_disorder::Moments;
///
/// // FCC has three loads of 1/3 at r = n. HCP has the same second moment, but is more symmetric and more compact.
/// let fcc = Moments::of(&"+++".parse()?)?;
/// assert_eq!([fcc.second, fcc.third, fcc.fourth].map(|m| m.to_string()), ["9", "27", "81"]);
/// let hcp = Moments::of(&"+-+".parse()?)?;
/// assert_eq!([hcp.second, hcp.third, hcp.fourth].map(|m| m.to_string()), ["9", "1", "57"]);
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Moments {
    /// Σ v r² = n² in every stacking, with n the number of steps. Also Σ v r_i r_j = δ_ij n²/2.
    pub second: BigRational,
    /// Σ v r³cos3φ, the threefold asymmetry of the response.
    pub third: BigRational,
    /// Σ v r⁴.
    pub fourth: BigRational,
}

cannonpile::engine::equality!(Moments; |Self { second, third, fourth }| [second, third, fourth].map(ByValue));

impl Moments {
    /// Returns the moments of the response in one stacking.
    ///
    /// # Errors
    /// [`TooLarge`](cannonpile::Error::TooLarge) for more than 10⁴ layers.
    ///
    /// # Examples
    /// See [`Moments`].
    pub fn of(stacking: &Stacking) -> Result<Self, Error> {
        let n = steps(stacking.layers())?;
        let (mut third, mut fourth) = (BigRational::zero(), fourth_moment(&n));
        // Σσ_s(2s−1) over the steps before t.
        let mut before = BigRational::zero();
        let mut t = BigRational::zero();
        for sign in stacking.signs() {
            t += BigRational::one();
            let sigma = BigRational::from_integer(sign.factor().into());
            third += third_moment(&n, &t) * &sigma;
            // The formula is linear in 2s−1, so it applies to the sum.
            let s = (before.clone() + BigRational::one()).div_int(TWO);
            fourth += fourth_moment_of_pair(&n, &s, &t) * &sigma;
            before += (BigRational::from_integer(2.into()) * &t - BigRational::one()) * sigma;
        }
        Ok(Self {
            second: n.clone() * n,
            third,
            fourth,
        })
    }
}

impl RandomStackings {
    /// Returns the moments of the mean response at the fault probability `q`.
    ///
    /// With a random first sign the mean response is sixfold symmetric, and its third moment is 0.
    ///
    /// # Errors
    /// * [`Error::FaultProbability`] unless 0 ≤ `q` ≤ 1.
    /// * [`TooLarge`](cannonpile::Error::TooLarge) for more than 10⁴ layers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomStackings};
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(4, FirstSign::Plus)?;
    /// let half = BigRational::new(1.into(), 2.into());
    /// // At q = 1/2 the signs are independent. The moments of three steps are 3n − 2 and n(2n³+2n²−2n+1)/3.
    /// let moments = stackings.moments(&half)?;
    /// assert_eq!([moments.third, moments.fourth].map(|m| m.to_string()), ["7", "67"]);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn moments(&self, q: &BigRational) -> Result<Moments, Error> {
        check_fault_probability(q)?;
        let n = steps(self.layers())?;
        let one = BigRational::one();
        let mu = one.clone() - BigRational::from_integer(2.into()) * q;
        let gap = one - &mu;
        let square = n.clone() * &n;
        let straight = || Moments {
            second: square.clone(),
            third: square.clone() * &n,
            fourth: square.clone() * &square,
        };
        let mean = || {
            let power = (1..self.layers()).fold(BigRational::one(), |power, _| power * &mu);
            let cube = gap.clone() * &gap * &gap;
            let pairs = mean_fourth_moment_of_pairs(&n, &mu, &power);
            let pairs = pairs.checked_div(&(cube.clone() * &gap))?;
            Some(Moments {
                second: square.clone(),
                third: mean_third_moment(&n, &mu, &power).checked_div(&cube)?,
                fourth: fourth_moment(&n) + pairs,
            })
        };
        // For q = 0 the divisor 1−μ is 0, and no sign ever changes.
        let moments = mean().unwrap_or_else(straight);
        let third = match self.first() {
            FirstSign::Plus => moments.third,
            FirstSign::Minus => -moments.third,
            FirstSign::Random => BigRational::zero(),
        };
        Ok(Moments { third, ..moments })
    }
}

/// The damping a and the dispersion b of long waves in the mean response. Each layer multiplies a wave with κ = kρ by
/// exp(±iκ/√2·(1 + bκ²) − aκ² + …), where k is the wave number.
///
/// The speed is ρ/√2 per layer at every fault probability q > 0. At q = 0 the load follows three straight rays. For q >
/// 0 the mean response after n steps is a ring of radius r = nρ/√2, whose width follows from
/// [`squared_width`](Self::squared_width). Theorem `mean-spectrum` proves both numbers. Only one other mode does not
/// decay, and it alternates in sign from place to place. The proof of this statement, in words, is in
/// the [documentation of this crate](crate#what-is-proved).
///
/// # Examples
/// ```
/// use cannonpile_disorder::Wave;
/// use num_rational::BigRational;
///
/// let q = |n: i32, d: i32| BigRational::new(n.into(), d.into());
/// assert_eq!(Wave::at(&q(1, 2))?.unwrap().damping, q(1, 16));
/// assert_eq!(Wave::at(&q(0, 1))?, None);
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Wave {
    /// a = (1−q)/(16q).
    pub damping: BigRational,
    /// b = (13q²−42q+21)/(768q²).
    pub dispersion: BigRational,
}

cannonpile::engine::equality!(Wave; |Self { damping, dispersion }| [damping, dispersion].map(ByValue));

impl Wave {
    /// Returns damping and dispersion at the fault probability `q`. The result is `None` for q = 0, where the response
    /// is not a wave.
    ///
    /// # Errors
    /// [`Error::FaultProbability`] unless 0 ≤ `q` ≤ 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Wave;
    /// use num_rational::BigRational;
    ///
    /// // HCP has no damping, and the dispersion b = −1/96.
    /// let wave = Wave::at(&BigRational::from_integer(1.into()))?.unwrap();
    /// assert_eq!((wave.damping.to_string(), wave.dispersion.to_string()), ("0".into(), "-1/96".into()));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn at(q: &BigRational) -> Result<Option<Self>, Error> {
        check_fault_probability(q)?;
        let [damping, dispersion] = wave(q);
        let over = || {
            Some(Self {
                damping: damping.checked_div(q)?,
                dispersion: dispersion.checked_div(&(q.clone() * q))?,
            })
        };
        Ok(over())
    }

    /// Returns w² = 2an = (1−q)n/(8q), the square of the width of the front after `n` steps, in ρ².
    ///
    /// The front is the ring of a two-dimensional wave, convolved with a Gaussian of standard deviation w. At q = 1
    /// only dispersion widens it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Wave;
    /// use num_rational::BigRational;
    ///
    /// let wave = Wave::at(&BigRational::new(1.into(), 2.into()))?.unwrap();
    /// assert_eq!(wave.squared_width(16).to_string(), "2");
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn squared_width(&self, n: i128) -> BigRational {
        BigRational::from_integer(2.into()) * &self.damping * BigRational::from_integer(n.into())
    }
}

/// Returns the number of steps.
fn steps(layers: i128) -> Result<BigRational, Error> {
    refuse_beyond(
        "moments of the response to a load",
        layers.unsigned_abs(),
        MAX_RANDOM_LAYERS,
        "use fewer layers",
    )?;
    Ok(BigRational::from_integer((layers - 1).into()))
}
