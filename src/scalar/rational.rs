//! The scalar traits for `BigRational`: exact values of any size.

use core::num::NonZeroI64;

use exact_surd::rational::{common_denominator, quotient};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{
    Algebra, ByValue, Enclosure, Exactness, Field, Numerators, RealEmbeddable, RealSign, Ring,
};

impl Ring for BigRational {
    fn from_i128(n: i128) -> Self {
        Self::from_integer(n.into())
    }

    fn comparison_key(&self) -> impl PartialEq {
        ByValue(self)
    }
}

impl Algebra for BigRational {
    const EXACTNESS: Exactness = Exactness::Exact;
    const NAME: &'static str = "BigRational";

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

impl Numerators for BigRational {
    type Numerator = BigInt;

    fn numerators<const N: usize>(values: &[BigRational; N]) -> ([BigInt; N], BigInt) {
        let common = common_denominator(values);
        let numerators = values.each_ref().map(|r| r.numer() * (&common / r.denom()));
        (numerators, common)
    }

    fn from_integers(integers: [BigInt; 3], _: impl FnOnce() -> BigInt) -> [BigInt; 3] {
        integers
    }

    fn into_numerators<const N: usize>(
        values: [BigRational; N],
    ) -> Result<[BigInt; N], [BigRational; N]> {
        Err(values)
    }

    fn divide_numerator(_: BigInt, _: NonZeroI64) -> Option<BigInt> {
        // The numerators are integers, and a quotient of integers need not be one.
        None
    }

    fn from_ratio(n: BigInt, d: &BigInt) -> Option<Self> {
        (!d.is_zero()).then(|| quotient(n, d))
    }
}

impl Field for BigRational {
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| self / divisor)
    }
}

impl RealEmbeddable for BigRational {
    fn sign(&self) -> RealSign {
        if self.is_positive() {
            RealSign::Positive
        } else if self.is_negative() {
            RealSign::Negative
        } else {
            RealSign::Zero
        }
    }

    fn enclosure(&self) -> Option<Enclosure> {
        Some(Enclosure::point(self.clone()))
    }
}
