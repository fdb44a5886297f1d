//! Floats of dashu with 113 bits. `FBig` carries its precision in the value.

use std::num::NonZeroI64;
use std::ops::{Add, Mul, Sub};

use cannonpile::num_bigint::BigInt;
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::Zero;
use cannonpile::scalar::{Algebra, Exactness, Ring};
use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig, Repr};
use dashu_int::IBig;

const BITS: usize = 113;

#[derive(Clone, Debug, PartialEq)]
pub struct Quad(pub FBig<HalfEven>);

impl Add<&Self> for Quad {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        Self(self.0 + &other.0)
    }
}

impl Sub<&Self> for Quad {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Self(self.0 - &other.0)
    }
}

impl Mul<&Self> for Quad {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        Self(self.0 * &other.0)
    }
}

cannonpile::ring!(Quad);

impl Ring for Quad {
    fn from_integer(n: i128) -> Self {
        Self(FBig::from(n).with_precision(BITS).value())
    }
}

impl Algebra for Quad {
    const EXACTNESS: Exactness = Exactness::Rounded { bits: 113 };
    const NAME: &'static str = "Quad";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        let exact = |n: &BigInt| Repr::new(IBig::from_le_bytes(&n.to_signed_bytes_le()), 0);
        let context = Context::<HalfEven>::new(BITS);
        let quotient = context.div::<2>(&exact(r.numer()), &exact(r.denom()));
        Self(quotient.expect("a denominator above zero").value())
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        Self(self.0 / FBig::from(n.get()))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| Self(&self.0 / &divisor.0))
    }

    fn is_defined(&self) -> bool {
        !self.0.repr().is_infinite()
    }
}
