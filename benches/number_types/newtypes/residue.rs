//! The field of residues modulo the prime 2⁶¹ − 1. No value if a denominator is a multiple of the prime.

use std::num::NonZeroI64;
use std::ops::{Add, Mul, Sub};

use cannonpile::num_bigint::BigInt;
use cannonpile::num_rational::BigRational;
use cannonpile::scalar::{Algebra, Exactness, Ring};

pub const PRIME: i128 = (1 << 61) - 1;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residue(pub Option<u64>);

impl Residue {
    fn of(self, other: Self, result: impl Fn(i128, i128) -> i128) -> Self {
        let both = self.0.zip(other.0);
        both.map_or(Self(None), |(a, b)| {
            Self::from_integer(result(a.into(), b.into()))
        })
    }

    fn inverse(self) -> Option<Self> {
        let mut power = Self::from_integer(1);
        for bit in (0..61).rev() {
            power = power * power;
            if ((PRIME - 2) >> bit) & 1 == 1 {
                power = power * self;
            }
        }
        self.0.filter(|&n| n > 0).and(Some(power))
    }
}

impl Add<&Self> for Residue {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        self.of(*other, |a, b| a + b)
    }
}

impl Sub<&Self> for Residue {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        self.of(*other, |a, b| a - b)
    }
}

impl Mul<&Self> for Residue {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        self.of(*other, |a, b| a * b)
    }
}

cannonpile::ring!(Residue);

impl Ring for Residue {
    fn from_integer(n: i128) -> Self {
        Self(n.rem_euclid(PRIME).try_into().ok())
    }
}

impl Algebra for Residue {
    // Not `Exact`: the library would compute in integers, and convert the results.
    const EXACTNESS: Exactness = Exactness::Unknown;
    const NAME: &'static str = "Residue";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        let residue = |n: &BigInt| Self((n.modpow(&1.into(), &PRIME.into())).try_into().ok());
        residue(r.numer())
            .checked_div(&residue(r.denom()))
            .unwrap_or(Self(None))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        if n.get() == 3 {
            return self * Self::from_integer((2 * PRIME + 1) / 3);
        }
        let divisor = Self::from_integer(n.get().into());
        self.checked_div(&divisor).unwrap_or(Self(None))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        Some(*self * divisor.inverse()?)
    }

    fn is_defined(&self) -> bool {
        self.0.is_some()
    }
}
