//! The numbers a recursion counts with, and how much of them goes on straight and across a fault.

use core::ops::{Add, Mul, Sub};

use num_traits::{One, Zero};

/// A ring of numerators: machine integers wide enough, big integers, or an algebra.
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

/// What a share of forces is multiplied by.
pub(super) trait Share<T> {
    /// Returns the share of `x`.
    fn of(&self, x: T) -> T;
}

/// All of it: where stackings are counted by their faults.
#[derive(Clone, Copy, Debug)]
pub(super) struct All;

impl<T> Share<T> for All {
    #[inline]
    fn of(&self, x: T) -> T {
        x
    }
}

/// A share in the ring: a probability, times a denominator.
#[derive(Clone, Debug)]
pub(super) struct Part<T>(pub(super) T);

impl<T: Number> Share<T> for Part<T> {
    #[inline]
    fn of(&self, x: T) -> T {
        x * &self.0
    }
}

/// Returns 3x.
#[inline]
pub(super) fn tripled<T: Number>(x: &T) -> T {
    x.clone() + x + x
}

/// Adds to a number in its place.
#[inline]
pub(super) fn add<T: Number>(sum: &mut T, x: &T) {
    let before = core::mem::replace(sum, T::zero());
    *sum = before + x;
}
