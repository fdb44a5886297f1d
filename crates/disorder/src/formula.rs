//! Formulas for the response to a load: in one stacking, and in the mean over random stackings.

use core::num::NonZeroI64;

use cannonpile::scalar::{Algebra, Ring};

use crate::THREE;

// The compiler evaluates the `unwrap`, and rejects zero.
const SIXTEEN: NonZeroI64 = NonZeroI64::new(16).unwrap();
const SEVEN_HUNDRED_SIXTY_EIGHT: NonZeroI64 = NonZeroI64::new(768).unwrap();

/// Returns 3(n−s)(2s−1) + 3s−2, the coefficient of the sign σ_s in the third moment of a unit load at depth n.
///
/// The third moment is Σ v r³cos3φ. It is the sum over the steps s of σ_s times this coefficient, 1 ≤ s ≤ n. The unit
/// is ρ³, with ρ = 2R sinθ the horizontal part of a contact. The v are the loads on the spheres n layers below the unit
/// load. Their distance from its vertical line is r, and their azimuth from the direction α under a + step is φ.
/// Theorem `third-moment`.
///
/// # Examples
/// ```
/// use cannonpile_disorder::formula::third_moment;
///
/// // In FCC three loads of 1/3 have r = n, so the moment is n³.
/// let n = 7.0;
/// assert_eq!((1..=7).map(|s| third_moment(&n, &f64::from(s))).sum::<f64>(), 343.0);
/// ```
#[must_use]
pub fn third_moment<T: Ring>(n: &T, s: &T) -> T {
    integer::<T>(3) * &deep(n, s) * &odd(s) + &(integer::<T>(3) * s) - &integer(2)
}

/// Returns n(2n³+2n²−2n+1)/3, the part of the fourth moment Σ v r⁴ of a unit load at depth n that does not depend on
/// the signs.
///
/// The unit is ρ⁴. [`fourth_moment_of_pair`] is the part that depends on two signs. Theorem `fourth-moment`.
///
/// # Examples
/// ```
/// use cannonpile_disorder::formula::fourth_moment;
///
/// // The first step leads to r = ρ for both signs.
/// assert_eq!(fourth_moment(&1.0), 1.0);
/// ```
#[must_use]
pub fn fourth_moment<T: Algebra>(n: &T) -> T {
    let square = n.clone() * n;
    let sum = integer::<T>(2) * &square * n + &(integer::<T>(2) * &square);
    ((sum - &(integer::<T>(2) * n) + &T::one()) * n).div_int(THREE)
}

/// Returns 2(2n−2t+1)(2s−1), the coefficient of the product σ_sσ_t of two signs, s < t, in the fourth moment Σ v r⁴ of
/// a unit load at depth n.
///
/// The unit is ρ⁴. Theorem `fourth-moment`.
///
/// # Examples
/// ```
/// use cannonpile_disorder::formula::{fourth_moment, fourth_moment_of_pair};
///
/// // In FCC three loads of 1/3 have r = n, so the moment is n⁴.
/// let pair = |s: i32, t: i32| fourth_moment_of_pair(&5.0, &f64::from(s), &f64::from(t));
/// let pairs: f64 = (1..=5).flat_map(|t| (1..t).map(move |s| pair(s, t))).sum();
/// assert_eq!(fourth_moment(&5.0) + pairs, 625.0);
/// ```
#[must_use]
pub fn fourth_moment_of_pair<T: Ring>(n: &T, s: &T, t: &T) -> T {
    integer::<T>(2) * &(integer::<T>(2) * &deep(n, t) + &T::one()) * &odd(s)
}

/// Returns (1−μ)³ times the mean third moment of a unit load at depth n, over random stackings whose first sign is +:
/// 3(1−μ)(1+μ)n(1+μⁿ) − 2(μ²+4μ+1)(1−μⁿ).
///
/// The unit is ρ³. μ is 1−2q with the fault probability q, and `power` is μⁿ. Theorem `third-moment`.
///
/// # Examples
/// ```
/// use cannonpile_disorder::formula::mean_third_moment;
///
/// // q = 1/2, μ = 0: 3n − 2.
/// assert_eq!(mean_third_moment(&4.0, &0.0, &0.0), 10.0);
/// ```
#[must_use]
pub fn mean_third_moment<T: Ring>(n: &T, mu: &T, power: &T) -> T {
    let (gap, sum) = (T::one() - mu, T::one() + mu);
    let whole = integer::<T>(3) * &gap * &sum * n * &(T::one() + power);
    let square = mu.clone() * mu + &(integer::<T>(4) * mu) + &T::one();
    whole - &(integer::<T>(2) * &square * &(T::one() - power))
}

/// Returns (1−μ)⁴ times the mean of the pair terms of the fourth moment of a unit load at depth n, over random
/// stackings: 4μn³(1−μ)³/3 − 4μn²(1−μ)² + 2μ(μ²+4μ+7)n(1−μ)/3 − 2μ(1+μ)²(1−μⁿ).
///
/// The unit is ρ⁴. The mean fourth moment is the sum of the pair terms and [`fourth_moment`]. As in
/// [`mean_third_moment`], μ is 1−2q and `power` is μⁿ. Theorem `fourth-moment`.
///
/// # Examples
/// ```
/// use cannonpile_disorder::formula::{fourth_moment_of_pair, mean_fourth_moment_of_pairs};
///
/// // The signs of two steps have the mean product μ.
/// let (n, mu) = (2.0, 0.5);
/// let mean = mu * fourth_moment_of_pair(&n, &1.0, &2.0);
/// assert_eq!(mean_fourth_moment_of_pairs(&n, &mu, &0.25) / (1.0_f64 - mu).powi(4), mean);
/// ```
#[must_use]
pub fn mean_fourth_moment_of_pairs<T: Algebra>(n: &T, mu: &T, power: &T) -> T {
    let gap = T::one() - mu;
    let deep = gap.clone() * n;
    let square = mu.clone() * mu + &(integer::<T>(4) * mu) + &integer(7);
    let odd = integer::<T>(4) * &deep * &deep * &deep + &(integer::<T>(2) * &square * &deep);
    let sum = T::one() + mu;
    let rest = integer::<T>(2) * &sum * &sum * &(T::one() - power);
    (odd.div_int(THREE) - &(integer::<T>(4) * &deep * &deep) - &rest) * mu
}

/// Returns q times the damping and q² times the dispersion of long waves in the mean response: (1−q)/16 and
/// (13q²−42q+21)/768.
///
/// With wave number k and κ = kρ each layer multiplies a wave by exp(±iκ/√2·(1 + bκ²) − aκ² + …). The damping a and the
/// dispersion b are dimensionless, and q > 0 is the fault probability. The speed is ρ/√2 for every q. The horizontal
/// force across the wave only decays, by exp(−2aκ²) in each layer. Theorem `mean-spectrum`.
///
/// # Examples
/// ```
/// use cannonpile_disorder::formula::wave;
///
/// // HCP has no damping, and b = −1/96.
/// assert_eq!(wave(&1.0), [0.0, -1.0 / 96.0]);
/// ```
#[must_use]
pub fn wave<T: Algebra>(q: &T) -> [T; 2] {
    let dispersion = integer::<T>(13) * q * q - &(integer::<T>(42) * q) + &integer(21);
    [
        (T::one() - q).div_int(SIXTEEN),
        dispersion.div_int(SEVEN_HUNDRED_SIXTY_EIGHT),
    ]
}

/// Returns the excess of the probability of a registry over ⅓ in the next layer: −(1−q)y − (1−2q)x.
///
/// The excess is y in the last layer and x in the layer above it. q is the fault probability. Theorem `registry`.
///
/// # Examples
/// ```
/// use cannonpile_disorder::formula::registry_excess;
///
/// // In FCC the registries are 0, 1, 2 in turn.
/// let [here, elsewhere] = [2.0_f64 / 3.0, -1.0 / 3.0];
/// assert_eq!(registry_excess(&here, &elsewhere, &0.0), elsewhere);
/// assert!((registry_excess(&elsewhere, &elsewhere, &0.0) - here).abs() < 1e-15);
/// ```
#[must_use]
pub fn registry_excess<T: Ring>(x: &T, y: &T, q: &T) -> T {
    let straight = T::one() - q;
    let memory = straight.clone() - q;
    -(straight * y) - &(memory * x)
}

fn integer<T: Ring>(n: i128) -> T {
    T::from_integer(n)
}

fn deep<T: Ring>(n: &T, s: &T) -> T {
    n.clone() - s
}

/// Returns 2s − 1.
fn odd<T: Ring>(s: &T) -> T {
    integer::<T>(2) * s - &T::one()
}
