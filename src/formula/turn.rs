//! How forces pass from layer to layer where the stacking changes.

use core::ops::{Add, Sub};

use num_traits::One;

use crate::scalar::{Algebra, Exactness, THREE};

/// Returns what a sphere at a change of sign passes on of the forces g that it receives: G g, with G = (2/3)J − I and J all ones,
/// that is (2/3)(g_α + g_β + g_γ)(1, 1, 1) − g; over three times the denominator of g, 3G g, if the ring of numerators
/// has no thirds.
///
/// G is the half-turn about (1, 1, 1): orthogonal, symmetric, its own inverse, so that nothing is amplified over a change
/// of sign. Exact in exact scalars. Integers are [tripled](tripled_half_turn), bounds are
/// [combined apart](tripled_apart) and divided, all others are turned with a single division.
///
/// # Examples
/// ```
/// use cannonpile::formula::half_turn;
/// use num_bigint::BigInt;
/// use num_rational::BigRational;
///
/// assert_eq!(half_turn::<f64>(&[3.0, 0.0, 0.0]), [-1.0, 2.0, 2.0]);
/// assert_eq!(half_turn::<f64>(&[-1.0, 2.0, 2.0]), [3.0, 0.0, 0.0]);
/// // Fractions are kept as integers over one denominator, which grows by 3.
/// let tripled = half_turn::<BigRational>(&[1, 0, 0].map(BigInt::from));
/// assert_eq!(tripled, [-1, 2, 2].map(BigInt::from));
/// ```
#[must_use]
pub fn half_turn<T: Algebra>(g: &[T::Numerator; 3]) -> [T::Numerator; 3] {
    let third = |tripled| T::divide_numerator(tripled, THREE);
    if T::EXACTNESS == Exactness::Enclosure
        && let [Some(a), Some(b), Some(c)] = tripled_apart(g).map(third)
    {
        return [a, b, c];
    }
    match third(twice_sum(g)) {
        Some(twice_mean) => g.each_ref().map(|x| twice_mean.clone() - x),
        None => tripled_half_turn(g),
    }
}

/// Returns 3G g = 2(g_α + g_β + g_γ)(1, 1, 1) − 3g: the [half-turn](half_turn) without a division, for integers whose denominator
/// grows by 3 at every change of sign.
///
/// No term of it is greater than 2√3·‖g‖, and |3G g| ≤ 5 max|g|. Exact wherever sums are.
///
/// # Examples
/// ```
/// use cannonpile::formula::tripled_half_turn;
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

/// Returns 3G g as (2(g_β + g_γ) − g_α, …), where every force is named once: for bounds, and for limbs, of
/// which no sum on the way is greater than the result may be, 5 max|g|.
///
/// Bounds widen by 5/3 over a [half-turn](half_turn). In [2Σg − 3g](tripled_half_turn) they would by 3, since an interval
/// does not know that both g_α in it are one number.
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

/// Returns whether a [half-turn](half_turn) triples the denominator: the numerators of the scalar have no thirds.
pub(crate) fn triples<T: Algebra>() -> bool {
    T::divide_numerator(T::Numerator::one(), THREE).is_none()
}

fn twice_sum<T: Clone + for<'a> Add<&'a T, Output = T>>([a, b, c]: &[T; 3]) -> T {
    let sum = a.clone() + b + c;
    sum.clone() + &sum
}
