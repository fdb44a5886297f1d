//! Plain rationals: every sum is reduced to lowest terms, without a common denominator.

use std::num::NonZeroI64;
use std::ops::{Add, Mul, Neg, Sub};

use cannonpile::scalar::{Algebra, Exactness, OwnNumerators, Ring};
use num_rational::BigRational;
use num_traits::{One, Zero};

/// A rational scalar that uses rationals as numerators too, so that no common denominator is kept.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plain(pub(crate) BigRational);

impl Ring for Plain {
    fn from_i128(n: i128) -> Self {
        Self(BigRational::from_integer(n.into()))
    }
}

impl Algebra for Plain {
    // For an exact scalar the library would sweep in limbs.
    const EXACTNESS: Exactness = Exactness::Rounded { bits: 1 << 20 };
    const NAME: &'static str = "plain rational";

    fn from_rational(r: &BigRational) -> Self {
        Self(r.clone())
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        Self(self.0 / BigRational::from_integer(n.get().into()))
    }

    fn is_defined(&self) -> bool {
        true
    }
}

impl OwnNumerators for Plain {
    fn ratio(n: Self, d: &Self) -> Option<Self> {
        (!d.is_zero()).then(|| Self(n.0 / &d.0))
    }
}

impl Zero for Plain {
    fn zero() -> Self {
        Self(BigRational::zero())
    }

    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl One for Plain {
    fn one() -> Self {
        Self(BigRational::one())
    }
}

impl Neg for Plain {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl $operator<&Self> for Plain {
            type Output = Self;

            fn $method(self, rhs: &Self) -> Self {
                Self(self.0.$method(&rhs.0))
            }
        }

        impl $operator for Plain {
            type Output = Self;

            fn $method(self, rhs: Self) -> Self {
                Self(self.0.$method(rhs.0))
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul);
