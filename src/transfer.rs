//! How forces pass from layer to layer where the stacking changes.

use crate::scalar::Algebra;

/// Where a stacking changes its Hägg sign, a sphere passes on G g of the forces g that it receives, with
/// G = (2/3)J − I and J all ones: f_m = −g_m + (2/3)(g_α + g_β + g_γ), to which its weight adds (1, 1, 1).
///
/// THEORY §3. G is the half-turn about (1, 1, 1): orthogonal, symmetric, its own inverse, so that nothing is
/// amplified over a sign change. Exact in exact scalars.
///
/// # Examples
/// ```
/// use cannonpile::transfer::half_turn;
///
/// assert_eq!(half_turn(&[3.0, 0.0, 0.0]), [-1.0, 2.0, 2.0]);
/// assert_eq!(half_turn(&[-1.0, 2.0, 2.0]), [3.0, 0.0, 0.0]);
/// ```
#[must_use]
pub fn half_turn<T: Algebra>(g: &[T; 3]) -> [T; 3] {
    let [a, b, c] = g;
    let sum = a.clone() + b + c;
    let twice_mean = (sum.clone() + &sum).div_int(THREE);
    g.each_ref().map(|x| twice_mean.clone() - x)
}

// Unwrapped by the compiler: zero would not build.
const THREE: core::num::NonZeroI64 = core::num::NonZeroI64::new(3).unwrap();
