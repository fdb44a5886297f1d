//! A scalar with exact arithmetic but for one planted fault.

use core::fmt::Debug;
use core::marker::PhantomData;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use cannonpile::scalar::{Algebra, Enclosure, Exactness, Field, RealEmbeddable, RealSign, Ring};
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{One, Zero};

/// The operations of a scalar: all right, unless a fault overrides one.
pub(crate) trait Fault: Clone + Debug + PartialEq + Send + Sync {
    const CLAIMS: Exactness = Exactness::Exact;

    fn zero() -> Q {
        Q::zero()
    }
    fn one() -> Q {
        Q::one()
    }
    fn add(a: &Q, b: &Q) -> Q {
        a + b
    }
    fn sub(a: &Q, b: &Q) -> Q {
        a - b
    }
    fn mul(a: &Q, b: &Q) -> Q {
        a * b
    }
    fn neg(a: &Q) -> Q {
        -a
    }
    fn integer(n: i128) -> Q {
        Q::from_integer(n.into())
    }
    fn rational(r: &Q) -> Q {
        r.clone()
    }
    fn div_int(a: &Q, n: i64) -> Q {
        a / BigInt::from(n)
    }
    fn div(a: &Q, b: &Q) -> Option<Q> {
        (!b.is_zero()).then(|| a / b)
    }
    /// Of a numerator and a denominator.
    fn ratio(n: &Q, d: &Q) -> Option<Q> {
        (!d.is_zero()).then(|| n / d)
    }
    fn is_defined(_: &Q) -> bool {
        true
    }
    fn sign(a: &Q) -> RealSign {
        RealEmbeddable::sign(a)
    }
    fn enclosure(a: &Q) -> Enclosure {
        Enclosure::point(a.clone())
    }
}

/// A rational whose arithmetic has the fault F.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Flawed<F>(Q, PhantomData<F>);

/// A number of the flawed scalar.
pub(crate) fn flawed<F>(value: Q) -> Flawed<F> {
    Flawed(value, PhantomData)
}

impl<F: Fault> Add<&Self> for Flawed<F> {
    type Output = Self;

    fn add(self, rhs: &Self) -> Self {
        flawed(F::add(&self.0, &rhs.0))
    }
}

impl<F: Fault> Sub<&Self> for Flawed<F> {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        flawed(F::sub(&self.0, &rhs.0))
    }
}

impl<F: Fault> Mul<&Self> for Flawed<F> {
    type Output = Self;

    fn mul(self, rhs: &Self) -> Self {
        flawed(F::mul(&self.0, &rhs.0))
    }
}

impl<F: Fault> Add for Flawed<F> {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        self + &rhs
    }
}

impl<F: Fault> Mul for Flawed<F> {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        self * &rhs
    }
}

impl<F: Fault> Neg for Flawed<F> {
    type Output = Self;

    fn neg(self) -> Self {
        flawed(F::neg(&self.0))
    }
}

impl<F: Fault> Zero for Flawed<F> {
    fn zero() -> Self {
        flawed(F::zero())
    }

    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl<F: Fault> One for Flawed<F> {
    fn one() -> Self {
        flawed(F::one())
    }
}

impl<F: Fault> Ring for Flawed<F> {
    fn from_i128(n: i128) -> Self {
        flawed(F::integer(n))
    }
}

impl<F: Fault> Algebra for Flawed<F> {
    type Numerator = Self;

    const EXACTNESS: Exactness = F::CLAIMS;
    const NAME: &'static str = "Flawed";

    fn from_rational(r: &Q) -> Self {
        flawed(F::rational(r))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        flawed(F::div_int(&self.0, n.get()))
    }

    fn is_defined(&self) -> bool {
        F::is_defined(&self.0)
    }

    fn numerators<const N: usize>(values: &[Q; N]) -> ([Self; N], Self) {
        (values.each_ref().map(Self::from_rational), Self::one())
    }

    fn from_ratio(n: Self, d: &Self) -> Option<Self> {
        F::ratio(&n.0, &d.0).map(flawed)
    }
}

impl<F: Fault> Field for Flawed<F> {
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        F::div(&self.0, &divisor.0).map(flawed)
    }
}

impl<F: Fault> RealEmbeddable for Flawed<F> {
    fn sign(&self) -> RealSign {
        F::sign(&self.0)
    }

    fn enclosure(&self) -> Option<Enclosure> {
        Some(F::enclosure(&self.0))
    }
}
