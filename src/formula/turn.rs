//! Transfer of forces across a sign change.

use core::ops::{Add, Sub};

use num_traits::One;

use crate::each::Each;
use crate::scalar::{Algebra, Exactness, THREE};

/// Returns G g, the contribution of the forces g from above to the forces that a sphere at a sign change transmits.
/// Here G = (2/3)J − I with J all ones, so G g = (2/3)(g_α + g_β + g_γ)(1, 1, 1) − g. If the numerators do not allow
/// division by 3, the result is 3G g, and the denominator is three times that of g.
///
/// G is the half-turn about (1, 1, 1): orthogonal, symmetric and its own inverse. So a sign change does not amplify
/// errors. The result is exact in exact scalars. Integers use [`tripled_half_turn`]. Bounds use [`tripled_apart`] and a
/// division by 3. All other scalars use a single division.
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
#[must_use]
pub fn half_turn<T: Algebra>(g: &[T::Numerator; 3]) -> [T::Numerator; 3] {
    let third = |tripled| T::divide_numerator(tripled, THREE);
    if T::EXACTNESS == Exactness::Enclosure
        && let [Some(a), Some(b), Some(c)] = tripled_apart(g).each(third)
    {
        return [a, b, c];
    }
    match third(twice_sum(g)) {
        Some(twice_mean) => g.each_ref().each(|x| twice_mean.clone() - x),
        None => tripled_half_turn(g),
    }
}

/// Returns 3G g = 2(g_α + g_β + g_γ)(1, 1, 1) − 3g, the [half-turn](half_turn) without a division. The library uses it
/// for integers, whose denominator grows by a factor of 3 at each sign change.
///
/// No intermediate term exceeds 2√3·‖g‖, and |3G g| ≤ 5 max|g|. The result is exact if sums are exact.
///
/// # Examples
/// ```
/// use cannonpile::formula::tripled_half_turn;
///
/// assert_eq!(tripled_half_turn(&[3_i64, 0, 0]), [-3, 6, 6]);
/// ```
#[inline]
#[must_use]
pub fn tripled_half_turn<T>(g: &[T; 3]) -> [T; 3]
where
    T: Clone + for<'a> Add<&'a T, Output = T> + for<'a> Sub<&'a T, Output = T>,
{
    let twice_sum = twice_sum(g);
    g.each_ref().each(|x| twice_sum.clone() - x - x - x)
}

/// Returns 3G g as (2(g_β + g_γ) − g_α, …), so that each force occurs once. The library uses it for bounds and limbs.
/// No intermediate sum exceeds the bound of the result, 5 max|g|.
///
/// Enclosures widen by a factor of 5/3 over a [half-turn](half_turn). With [2Σg − 3g](tripled_half_turn) they would
/// widen by 3, because interval arithmetic treats the two occurrences of g_α as independent.
///
/// # Examples
/// ```
/// use cannonpile::formula::tripled_apart;
///
/// assert_eq!(tripled_apart(&[3_i64, 0, 0]), [-3, 6, 6]);
/// ```
#[must_use]
pub fn tripled_apart<T>([a, b, c]: &[T; 3]) -> [T; 3]
where
    T: Clone + for<'a> Add<&'a T, Output = T> + for<'a> Sub<&'a T, Output = T>,
{
    let tripled = |others: [&T; 2], own: &T| {
        let sum = others[0].clone() + others[1];
        sum.clone() + &sum - own
    };
    [tripled([b, c], a), tripled([a, c], b), tripled([a, b], c)]
}

/// Returns whether a [half-turn](half_turn) multiplies the denominator by 3, because the numerators do not allow
/// division by 3.
pub(crate) fn triples<T: Algebra>() -> bool {
    T::divide_numerator(T::Numerator::one(), THREE).is_none()
}

fn twice_sum<T: Clone + for<'a> Add<&'a T, Output = T>>([a, b, c]: &[T; 3]) -> T {
    let sum = a.clone() + b + c;
    sum.clone() + &sum
}
