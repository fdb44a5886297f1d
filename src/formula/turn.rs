//! Transfer of forces across a sign change.

use crate::scalar::{Algebra, Numerators};

/// Returns G g, the contribution of the forces g from above to the forces that a sphere at a sign change transmits.
/// Here G = (2/3)J − I with J all ones, so G g = (2/3)(g_α + g_β + g_γ)(1, 1, 1) − g. For the numerators of rationals,
/// which are integers, the result is 3G g, and the denominator is three times that of g.
///
/// G is the half-turn about (1, 1, 1): orthogonal, symmetric and its own inverse. So a sign change does not amplify
/// errors. The result is exact in exact scalars. Integers use [`tripled_half_turn`](super::tripled_half_turn). Bounds use
/// [`tripled_apart`](super::tripled_apart) and a division by 3. All other scalars use a single division, unless they
/// override [`Algebra::half_turn`].
///
/// # Examples
/// ```
/// use cannonpile::formula::half_turn;
/// use num_bigint::BigInt;
/// use num_rational::BigRational;
///
/// assert_eq!(half_turn::<f64>(&[3.0, 0.0, 0.0]), [-1.0, 2.0, 2.0]);
/// assert_eq!(half_turn::<f64>(&[-1.0, 2.0, 2.0]), [3.0, 0.0, 0.0]);
/// // The numerators of rationals are integers. Their common denominator grows by a factor of 3.
/// let tripled = half_turn::<BigRational>(&[1, 0, 0].map(BigInt::from));
/// assert_eq!(tripled, [-1, 2, 2].map(BigInt::from));
/// ```
#[inline]
#[must_use]
pub fn half_turn<T: Algebra>(g: &[T::Numerator; 3]) -> [T::Numerator; 3] {
    T::Numerator::half_turn(g)
}
