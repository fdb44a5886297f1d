//! `BigRational`: exact, of any size.

use core::num::NonZeroI64;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{Algebra, Enclosure, Exactness, Field, RealEmbeddable, Sign};

impl Algebra for BigRational {
    const EXACTNESS: Exactness = Exactness::Exact;
    const NAME: &'static str = "BigRational";

    fn from_i128(n: i128) -> Self {
        Self::from_integer(n.into())
    }

    fn from_rational(r: &BigRational) -> Self {
        r.clone()
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        self / BigInt::from(n.get())
    }

    fn is_defined(&self) -> bool {
        true
    }
}

impl Field for BigRational {
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| self / divisor)
    }
}

impl RealEmbeddable for BigRational {
    fn sign(&self) -> Sign {
        if self.is_positive() {
            Sign::Positive
        } else if self.is_negative() {
            Sign::Negative
        } else {
            Sign::Zero
        }
    }

    fn enclosure(&self) -> Option<Enclosure> {
        Some(Enclosure::point(self.clone()))
    }
}
