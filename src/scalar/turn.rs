//! The half-turn at a sign change, by each kind of number. [`formula`](crate::formula) has its place among the equations.

use core::ops::{Add, Sub};

use crate::each::Each;

/// Returns 3G g = 2(g_α + g_β + g_γ)(1, 1, 1) − 3g, the [half-turn](crate::formula::half_turn) without a division. The
/// library uses it for integers, whose denominator grows by a factor of 3 at each sign change.
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
/// Enclosures widen by a factor of 5/3 over a [half-turn](crate::formula::half_turn). With [2Σg − 3g](tripled_half_turn)
/// they would widen by 3, because interval arithmetic treats the two occurrences of g_α as independent.
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

/// Returns 2(g_α + g_β + g_γ).
pub(super) fn twice_sum<T: Clone + for<'a> Add<&'a T, Output = T>>([a, b, c]: &[T; 3]) -> T {
    let sum = a.clone() + b + c;
    sum.clone() + &sum
}
