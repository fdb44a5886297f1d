//! Which float is nearest to a root, decided without taking the root.

use core::fmt::Debug;

use num_rational::BigRational;
use num_traits::float::FloatCore;

use super::Verdict;
use crate::answers::ratio;

/// What the check needs of `f32` and `f64`.
pub(crate) trait Binary: FloatCore + Debug {
    /// The next float on the real line.
    fn up(self) -> Self;
    /// The one before.
    fn down(self) -> Self;
    /// Whether the last bit of the significand is 0.
    fn is_even(self) -> bool;
}

macro_rules! binary {
    ($($float:ident)*) => {$(
        impl Binary for $float {
            fn up(self) -> Self {
                self.next_up()
            }

            fn down(self) -> Self {
                self.next_down()
            }

            fn is_even(self) -> bool {
                self.to_bits() & 1 == 0
            }
        }
    )*};
}

binary!(f32 f64);

/// `float` is nearest to the number with this sign and this square, ties to even; `None` stands for an
/// infinity.
///
/// A float is right if the square lies between those of the midpoints to its neighbours. The
/// neighbour of the greatest float is, for this purpose, the power of two that would follow it.
pub(crate) fn is_nearest<F: Binary>(
    float: Option<F>,
    negative: bool,
    square: &BigRational,
) -> Verdict {
    let Some(x) = float else {
        // The greatest float is odd: halfway belongs to the infinity.
        let limit = midpoint(&exact(F::max_value()), &beyond_greatest::<F>());
        return verdict(*square >= &limit * &limit, float, square);
    };
    let magnitude = x.abs();
    let within = |side: core::cmp::Ordering, neighbour: &BigRational| {
        let middle = midpoint(&exact(magnitude), neighbour);
        let order = square.cmp(&(&middle * &middle));
        order == side || (order.is_eq() && magnitude.is_even())
    };
    let above = if magnitude == F::max_value() {
        beyond_greatest::<F>()
    } else {
        exact(magnitude.up())
    };
    let not_higher = within(core::cmp::Ordering::Less, &above);
    let not_lower =
        magnitude.is_zero() || within(core::cmp::Ordering::Greater, &exact(magnitude.down()));
    let signed = magnitude.is_zero() || (x < F::zero()) == negative;
    verdict(not_higher && not_lower && signed, float, square)
}

fn verdict<F: Debug>(holds: bool, float: F, square: &BigRational) -> Verdict {
    if holds {
        Ok(())
    } else {
        Err(format!("{float:?} is not nearest to the root of {square}"))
    }
}

/// The float as the rational it is.
pub(crate) fn exact<F: FloatCore>(x: F) -> BigRational {
    BigRational::from_float(x).expect("a finite float")
}

/// The number that would follow the greatest float, were the exponent not limited.
pub(crate) fn beyond_greatest<F: Binary>() -> BigRational {
    let greatest = exact(F::max_value());
    let before = exact(F::max_value().down());
    &greatest + (&greatest - before)
}

/// Halfway between two numbers.
pub(crate) fn midpoint(a: &BigRational, b: &BigRational) -> BigRational {
    (a + b) * ratio(1, 2)
}
