//! The scalars of the recursion, and the factors of its two terms.

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

/// A constant factor.
pub(super) trait Factor<T> {
    /// Returns `x` times the factor.
    fn times(&self, x: T) -> T;
}

/// The factor 1, for sums by numbers of faults. No multiplication takes place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unity;

impl<T> Factor<T> for Unity {
    #[inline]
    fn times(&self, x: T) -> T {
        x
    }
}

/// A probability, times a common denominator.
#[derive(Clone, Debug)]
pub(super) struct Scale<T>(pub(super) T);

impl<T: Number> Factor<T> for Scale<T> {
    #[inline]
    fn times(&self, x: T) -> T {
        x * &self.0
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
