//! The scalar traits for double-doubles: unevaluated sums of two `f64`, with about twice the precision of one.

use core::num::NonZeroI64;

use exact_surd::DoubleDouble;
use num_rational::BigRational;

use super::{Algebra, Exactness, Field, Ring};

impl Ring for DoubleDouble {
    fn from_integer(n: i128) -> Self {
        Self::from_rational(&BigRational::from_integer(n.into()))
    }
}

impl Algebra for DoubleDouble {
    const EXACTNESS: Exactness = Exactness::Rounded { bits: 100 };
    const NAME: &'static str = "DoubleDouble";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self::from_rational(r)
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        self.over(&Self::from_integer(n.get().into()))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        Self::checked_div(self, divisor)
    }

    fn is_defined(&self) -> bool {
        self.is_finite()
    }
}

impl Field for DoubleDouble {}
