//! How forces pass from layer to layer where the stacking changes.

use core::num::NonZeroI64;
use core::ops::{Add, Sub};

use crate::scalar::{Algebra, Exactness};

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
    if T::EXACTNESS == Exactness::Enclosure {
        return each_once(g).map(|tripled| tripled.div_int(THREE));
    }
    let twice_mean = twice_sum(g).div_int(THREE);
    g.each_ref().map(|x| twice_mean.clone() - x)
}

/// 3 G g = 2(g_α + g_β + g_γ) − 3g: the half-turn without a division, for numerators whose denominator grows by 3
/// at every change of sign.
///
/// No term of it is greater than 2√3·‖g‖, and |3 G g| ≤ 5 max|g|. Exact wherever sums are.
///
/// # Examples
/// ```
/// use cannonpile::transfer::tripled_half_turn;
///
/// assert_eq!(tripled_half_turn(&[3_i64, 0, 0]), [-3, 6, 6]);
/// ```
#[must_use]
pub fn tripled_half_turn<T>(g: &[T; 3]) -> [T; 3]
where
    T: Clone + for<'a> Add<&'a T, Output = T> + for<'a> Sub<&'a T, Output = T>,
{
    let twice_sum = twice_sum(g);
    g.each_ref().map(|x| twice_sum.clone() - x - x - x)
}

/// The half-turn on numerators: over the same denominator if their ring has thirds, else [tripled](tripled_half_turn).
pub(crate) fn turn_numerators<T: Algebra>(g: &[T::Numerator; 3]) -> [T::Numerator; 3] {
    if T::EXACTNESS == Exactness::Enclosure {
        let third = |tripled: T::Numerator| T::divide_numerator(tripled, THREE);
        if let [Some(a), Some(b), Some(c)] = each_once(g).map(third) {
            return [a, b, c];
        }
    }
    match T::divide_numerator(twice_sum(g), THREE) {
        Some(twice_mean) => g.each_ref().map(|x| twice_mean.clone() - x),
        None => tripled_half_turn(g),
    }
}

/// The same 3 G g, (2(b+c) − a, …): every force is named once, so that bounds widen by 5/3 over a turn. In 2(a+b+c) − 3a
/// they would by 3, since an interval does not know that both a's are one number.
fn each_once<T>([a, b, c]: &[T; 3]) -> [T; 3]
where
    T: Clone + for<'a> Add<&'a T, Output = T> + for<'a> Sub<&'a T, Output = T>,
{
    let tripled = |others: [&T; 2], own: &T| {
        let sum = others[0].clone() + others[1];
        sum.clone() + &sum - own
    };
    [tripled([b, c], a), tripled([a, c], b), tripled([a, b], c)]
}

fn twice_sum<T: Clone + for<'a> Add<&'a T, Output = T>>([a, b, c]: &[T; 3]) -> T {
    let sum = a.clone() + b + c;
    sum.clone() + &sum
}

/// What a change of sign divides by. Unwrapped by the compiler: zero would not build.
pub(crate) const THREE: NonZeroI64 = NonZeroI64::new(3).unwrap();
