//! Rationals of malachite, which have no traits of num-traits.

use std::num::NonZeroI64;
use std::ops::{Add, Mul, Sub};

use cannonpile::num_bigint::BigInt;
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::Zero;
use cannonpile::scalar::{Algebra, Exactness, Ring};
use malachite_nz::integer::Integer;
use malachite_q::Rational;

#[derive(Clone, Debug, PartialEq)]
pub struct Malachite(pub Rational);

impl Add<&Self> for Malachite {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        Self(self.0 + &other.0)
    }
}

impl Sub<&Self> for Malachite {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Self(self.0 - &other.0)
    }
}

impl Mul<&Self> for Malachite {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        Self(self.0 * &other.0)
    }
}

cannonpile::ring!(Malachite);

impl Ring for Malachite {
    fn from_integer(n: i128) -> Self {
        Self(n.into())
    }
}

fn exact(n: &BigInt) -> Integer {
    let mut limbs = n.magnitude().to_u64_digits();
    limbs.push(0);
    let magnitude = Integer::from_owned_twos_complement_limbs_asc(limbs);
    if n < &BigInt::ZERO {
        -magnitude
    } else {
        magnitude
    }
}

impl Algebra for Malachite {
    const EXACTNESS: Exactness = Exactness::Exact;
    const NAME: &'static str = "Malachite";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self(Rational::from_integers(exact(r.numer()), exact(r.denom())))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        Self(self.0 / Rational::from(n.get()))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| Self(&self.0 / &divisor.0))
    }

    fn is_defined(&self) -> bool {
        true
    }
}
