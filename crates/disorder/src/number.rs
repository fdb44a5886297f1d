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
#[derive(Clone, Debug)]
pub(super) enum Factor<T> {
    /// The factor 1, for sums by numbers of faults. No multiplication takes place.
    One,
    /// A probability, times a common denominator.
    Scale(T),
}

impl<T: Number> Factor<T> {
    /// Returns `x` times the factor.
    #[inline]
    pub(super) fn times(&self, x: T) -> T {
        match self {
            Self::One => x,
            Self::Scale(factor) => x * factor,
        }
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
