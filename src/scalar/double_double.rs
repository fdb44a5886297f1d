//! The scalar traits for double-doubles: unevaluated sums of two `f64`, with about twice the precision of one.

use core::num::NonZeroI64;

use exact_surd::DoubleDouble;
use num_rational::BigRational;

use super::{Algebra, Enclosure, Exactness, Field, OwnNumerators, RealEmbeddable, RealSign, Ring};

impl Ring for DoubleDouble {
    fn from_i128(n: i128) -> Self {
        Self::from_rational(&BigRational::from_i128(n))
    }
}

impl Algebra for DoubleDouble {
    const EXACTNESS: Exactness = Exactness::Rounded { bits: 100 };
    const NAME: &'static str = "DoubleDouble";

    fn from_rational(r: &BigRational) -> Self {
        Self::from_rational(r)
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        self.over(&Self::from_i128(n.get().into()))
    }

    fn is_defined(&self) -> bool {
        self.is_finite()
    }
}

impl OwnNumerators for DoubleDouble {
    fn ratio(n: Self, d: &Self) -> Option<Self> {
        n.checked_div(d)
    }
}

impl Field for DoubleDouble {
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        Self::checked_div(self, divisor)
    }
}

impl RealEmbeddable for DoubleDouble {
    fn sign(&self) -> RealSign {
        self.high().sign()
    }

    fn enclosure(&self) -> Option<Enclosure> {
        self.to_rational().map(Enclosure::point)
    }
}
