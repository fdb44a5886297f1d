//! The scalars of the recursion.

use core::ops::{Add, Mul, Sub};

use num_traits::{One, Zero};

/// A ring: machine integers that are wide enough, big integers, or an algebra.
pub(super) trait Number:
    Clone
    + Zero
    + One
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
{
}

impl<T> Number for T where
    T: Clone
        + Zero
        + One
        + for<'a> Add<&'a Self, Output = Self>
        + for<'a> Sub<&'a Self, Output = Self>
        + for<'a> Mul<&'a Self, Output = Self>
{
}

/// Returns `x` times a factor. `None` stands for 1, for sums by numbers of faults, where no multiplication takes place.
#[inline]
pub(super) fn times<T: Number>(x: T, factor: Option<&T>) -> T {
    match factor {
        Some(factor) => x * factor,
        None => x,
    }
}

/// Returns 3x.
#[inline]
pub(super) fn tripled<T: Number>(x: &T) -> T {
    x.clone() + x + x
}

/// Adds `x` to `sum`.
#[inline]
pub(super) fn add<T: Number>(sum: &mut T, x: &T) {
    let before = core::mem::replace(sum, T::zero());
    *sum = before + x;
}
