//! Dual numbers a + a′ε with ε² = 0: a value and its derivative.

use core::num::NonZeroI64;
use core::ops::{Add, Mul, Sub};

use cannonpile::scalar::{Algebra, Exactness, Field, Ring};
use num_rational::BigRational;

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

cannonpile::ring!([T: Ring] Dual<T>);

impl<T: Ring> Ring for Dual<T> {
    fn from_integer(n: i128) -> Self {
        Self::constant(T::from_integer(n))
    }
}

impl<T: Field> Algebra for Dual<T> {
    const EXACTNESS: Exactness = T::EXACTNESS;
    const NAME: &'static str = "Dual";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self::constant(T::from_rational(r))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        let (value, slope) = (self.value.div_int(n), self.slope.div_int(n));
        Self { value, slope }
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        let value = self.value.checked_div(&divisor.value)?;
        let slope = self.slope.clone() - &(value.clone() * &divisor.slope);
        let slope = slope.checked_div(&divisor.value)?;
        Some(Self { value, slope })
    }

    fn is_defined(&self) -> bool {
        self.value.is_defined() && self.slope.is_defined()
    }
}

impl<T: Field> Field for Dual<T> {}
