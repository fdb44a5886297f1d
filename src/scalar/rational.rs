//! The scalar traits for `BigRational`: exact values of any size.

use core::num::NonZeroI64;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use super::{Algebra, ByValue, Exactness, Field, Ring};

impl Ring for BigRational {
    fn from_integer(n: i128) -> Self {
        Self::from_integer(n.into())
    }

    fn equals(&self, other: &Self) -> bool {
        ByValue(self) == ByValue(other)
    }
}

impl Algebra for BigRational {
    const EXACTNESS: Exactness = Exactness::Exact;
    const NAME: &'static str = "BigRational";
    type Numerator = BigInt;

    fn from_rational(r: &BigRational) -> Self {
        r.clone()
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        self / BigInt::from(n.get())
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| self / divisor)
    }

    fn is_defined(&self) -> bool {
        true
    }
}

impl Field for BigRational {}
