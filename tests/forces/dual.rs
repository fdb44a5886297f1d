//! Dual numbers a + a′ε with ε² = 0: a value and its derivative.

use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use cannonpile::scalar::{Algebra, Exactness, Field, OwnNumerators, Ring};
use num_rational::BigRational;
use num_traits::{One, Zero};

/// A value and its derivative.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dual<T> {
    /// The value.
    pub(crate) value: T,
    /// The derivative.
    pub(crate) slope: T,
}

impl<T: Ring> Dual<T> {
    /// The variable at a value: its derivative is 1.
    pub(crate) fn variable(value: T) -> Self {
        let slope = T::one();
        Self { value, slope }
    }

    /// A constant.
    pub(crate) fn constant(value: T) -> Self {
        let slope = T::zero();
        Self { value, slope }
    }
}

impl<T: Ring> Add<&Self> for Dual<T> {
    type Output = Self;

    fn add(self, other: &Self) -> Self {
        let (value, slope) = (self.value + &other.value, self.slope + &other.slope);
        Self { value, slope }
    }
}

impl<T: Ring> Sub<&Self> for Dual<T> {
    type Output = Self;

    fn sub(self, other: &Self) -> Self {
        let (value, slope) = (self.value - &other.value, self.slope - &other.slope);
        Self { value, slope }
    }
}

impl<T: Ring> Mul<&Self> for Dual<T> {
    type Output = Self;

    fn mul(self, other: &Self) -> Self {
        let slope = self.slope * &other.value + &(self.value.clone() * &other.slope);
        let value = self.value * &other.value;
        Self { value, slope }
    }
}

impl<T: Ring> Add for Dual<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self + &other
    }
}

impl<T: Ring> Mul for Dual<T> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self * &other
    }
}

impl<T: Ring> Neg for Dual<T> {
    type Output = Self;

    fn neg(self) -> Self {
        let (value, slope) = (-self.value, -self.slope);
        Self { value, slope }
    }
}

impl<T: Ring> Zero for Dual<T> {
    fn zero() -> Self {
        Self::constant(T::zero())
    }

    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.slope.is_zero()
    }
}

impl<T: Ring> One for Dual<T> {
    fn one() -> Self {
        Self::constant(T::one())
    }
}

impl<T: Ring> Ring for Dual<T> {
    fn from_i128(n: i128) -> Self {
        Self::constant(T::from_i128(n))
    }
}

impl<T: Field> Algebra for Dual<T> {
    const EXACTNESS: Exactness = T::EXACTNESS;
    const NAME: &'static str = "Dual";

    fn from_rational(r: &BigRational) -> Self {
        Self::constant(T::from_rational(r))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        let (value, slope) = (self.value.div_int(n), self.slope.div_int(n));
        Self { value, slope }
    }

    fn is_defined(&self) -> bool {
        self.value.is_defined() && self.slope.is_defined()
    }
}

impl<T: Field> OwnNumerators for Dual<T> {
    fn ratio(n: Self, d: &Self) -> Option<Self> {
        let value = n.value.checked_div(&d.value)?;
        let slope = n.slope - &(value.clone() * &d.slope);
        let slope = slope.checked_div(&d.value)?;
        Some(Self { value, slope })
    }
}

impl<T: Field> Field for Dual<T> {
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        Self::ratio(self.clone(), divisor)
    }
}
