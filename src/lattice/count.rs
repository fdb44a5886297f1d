//! Counts of spheres above a site on its lines, of all spheres, of all contacts, and of contacts with a given force.
//!
//! Each count is one generic function. With `i128` it returns a number, with big rationals a number of any size, and
//! with polynomials a formula for proofs.

use core::num::{NonZeroI64, NonZeroU32};
use core::ops::Sub;

use super::Sign;
use crate::scalar::Algebra;

/// Returns the numbers of spheres above (i, j, k) on its lines of contacts: (N_α, N_β, N_γ) = (k−i−j, i, j).
///
/// See (9) and the appendix of the paper. The counts are the barycentric coordinates of the site: they sum to k, and
/// they are not negative in the pile. They are exact in exact scalars.
///
/// # Examples
/// ```
/// use cannonpile::lattice::count;
///
/// assert_eq!(count::above(&2_i128, &1, &5), [2, 2, 1]);
/// ```
#[must_use]
pub fn above<T>(i: &T, j: &T, k: &T) -> [T; 3]
where
    T: Clone + for<'a> Sub<&'a T, Output = T>,
{
    [k.clone() - i - j, i.clone(), j.clone()]
}

/// Returns four upper bounds for each count of spheres above (i, j) on its lines α, β, γ, within a run. The minimum of
/// each four is the count N. The site lies `steps` steps below the first layer of the run, and the layer may be any
/// region.
///
/// Here `lower` = (x₀, y₀, s₀) and `upper` = (x₁, y₁, s₁) bound i, j and i+j in that layer, and m = `steps`. For +
/// steps N_α = min(m, x₁−i, y₁−j, s₁−i−j), N_β = min(m, i−x₀, y₁−j, i+j−s₀), N_γ = min(m, j−y₀, x₁−i, i+j−s₀). For −
/// steps the upper and lower bounds are interchanged. In the paper's pile this is (9), [`above`]. See
/// [`paper`](crate::paper#lines).
///
/// # Examples
/// ```
/// use cannonpile::lattice::{count, Sign};
///
/// // Layer 5 of the paper's pile: (k−i−j, i, j) = (2, 1, 2).
/// let bounds = count::bounds_above(&1_i128, &2, &[0, 0, 0], &[5, 5, 5], &5, Sign::Plus);
/// assert_eq!(bounds.map(|bounds| bounds.into_iter().min()), [Some(2), Some(1), Some(2)]);
/// ```
#[must_use]
pub fn bounds_above<T>(
    i: &T,
    j: &T,
    lower: &[T; 3],
    upper: &[T; 3],
    steps: &T,
    sign: Sign,
) -> [[T; 4]; 3]
where
    T: Clone + for<'a> Sub<&'a T, Output = T>,
{
    let ([x0, y0, s0], [x1, y1, s1]) = (lower, upper);
    // The distances of the site from each bound. The third one avoids the sum i + j.
    let from_lower = [
        i.clone() - x0,
        j.clone() - y0,
        i.clone() - &(s0.clone() - j),
    ];
    let from_upper = [x1.clone() - i, y1.clone() - j, s1.clone() - i - j];
    let ([left, low, inner], [right, high, outer]) = match sign {
        Sign::Plus => (from_lower, from_upper),
        Sign::Minus => (from_upper, from_lower),
    };
    [
        [steps.clone(), right.clone(), high.clone(), outer],
        [steps.clone(), left, high, inner.clone()],
        [steps.clone(), low, right, inner],
    ]
}

/// Returns the number of spheres in a straight pile of `layers` layers in d dimensions: C(L+d−1, d).
///
/// For d = 3 this is L(L+1)(L+2)/6. The domain is L ≥ 0.
///
/// # Examples
/// ```
/// use cannonpile::lattice::count;
///
/// assert_eq!(count::spheres(&10.0, 3), 220.0);
/// assert_eq!(count::spheres(&10.0, 2), 55.0);
/// ```
#[must_use]
pub fn spheres<T: Algebra>(layers: &T, d: u32) -> T {
    binomial(&shifted(layers, i128::from(d) - 1), d)
}

/// Returns the number of spheres in layer k: C(k+d−1, d−1). The domain is k ≥ 0, d ≥ 1.
///
/// # Examples
/// ```
/// use cannonpile::lattice::count;
///
/// assert_eq!(count::spheres_in_layer(&9.0, 3), 55.0);
/// ```
#[must_use]
pub fn spheres_in_layer<T: Algebra>(k: &T, d: u32) -> T {
    let below = d.saturating_sub(1);
    binomial(&shifted(k, below.into()), below)
}

/// Returns the number of contacts between spheres, d·C(L+d−2, d): each sphere above the bottom layer has d supports.
///
/// For d = 3 this is L(L−1)(L+1)/2. The domain is L ≥ 1.
///
/// # Examples
/// ```
/// use cannonpile::lattice::count;
///
/// assert_eq!(count::contacts(&10.0, 3), 495.0);
/// assert_eq!(count::contacts(&1.0, 3), 0.0);
/// ```
#[must_use]
pub fn contacts<T: Algebra>(layers: &T, d: u32) -> T {
    spheres(&shifted(layers, -1), d) * &T::from_integer(d.into())
}

/// Returns the number of contacts in one direction that carry n increments, for n = 1 … L−1: C(L−n+d−2, d−1).
///
/// For d = 3 this is (L−n)(L−n+1)/2.
///
/// # Examples
/// ```
/// use cannonpile::lattice::count;
///
/// assert_eq!(count::contacts_of_strength(&10.0, &1.0, 3), 45.0);
/// assert_eq!(count::contacts_of_strength(&10.0, &9.0, 3), 1.0);
/// ```
#[must_use]
pub fn contacts_of_strength<T: Algebra>(layers: &T, n: &T, d: u32) -> T {
    spheres_in_layer(&(shifted(layers, -1) - n), d)
}

/// Returns `n + by`.
fn shifted<T: Algebra>(n: &T, by: i128) -> T {
    n.clone() + &T::from_integer(by)
}

/// Returns the binomial coefficient C(x, n) = x(x−1)…(x−n+1)/n!, a polynomial in x.
fn binomial<T: Algebra>(x: &T, n: u32) -> T {
    let mut product = T::one();
    for t in 0..n {
        let divisor = NonZeroU32::MIN.saturating_add(t);
        let factor = x.clone() - &T::from_integer(t.into());
        product = (product * &factor).div_int(NonZeroI64::from(divisor));
    }
    product
}
