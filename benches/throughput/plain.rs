//! Plain rationals: every sum is reduced to lowest terms, without a common denominator.

use std::num::NonZeroI64;
use std::ops::{Add, Mul, Sub};

use cannonpile::scalar::{Algebra, Exactness, Ring};
use num_rational::BigRational;

/// A rational scalar that uses rationals as numerators too, so that no common denominator is kept.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plain(pub(crate) BigRational);

impl Ring for Plain {
    fn from_integer(n: i128) -> Self {
        Self(BigRational::from_integer(n.into()))
    }
}

impl Algebra for Plain {
    // For an exact scalar the library would sweep in limbs.
    const EXACTNESS: Exactness = Exactness::Rounded { bits: 1 << 20 };
    const NAME: &'static str = "plain rational";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self(r.clone())
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        Self(self.0 / BigRational::from_integer(n.get().into()))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        self.0.checked_div(&divisor.0).map(Self)
    }

    fn is_defined(&self) -> bool {
        true
    }
}

cannonpile::ring!(Plain);

macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl $operator<&Self> for Plain {
            type Output = Self;

            fn $method(self, rhs: &Self) -> Self {
                Self(self.0.$method(&rhs.0))
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul);
