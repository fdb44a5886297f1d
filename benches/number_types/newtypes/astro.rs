//! Floats of astro-float with 128 bits. `BigFloat` takes its precision and its rounding with each operation.

use std::num::NonZeroI64;
use std::ops::{Add, Mul, Sub};

use astro_float::{BigFloat, RoundingMode, Sign};
use cannonpile::num_bigint::BigInt;
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::Zero;
use cannonpile::scalar::{Algebra, Exactness, Ring};

const BITS: usize = 128;
const NEAREST: RoundingMode = RoundingMode::ToEven;

#[derive(Clone, Debug, PartialEq)]
pub struct Astro(pub BigFloat);

impl Add<&Self> for Astro {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        Self(self.0.add(&other.0, BITS, NEAREST))
    }
}

impl Sub<&Self> for Astro {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Self(self.0.sub(&other.0, BITS, NEAREST))
    }
}

impl Mul<&Self> for Astro {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        Self(self.0.mul(&other.0, BITS, NEAREST))
    }
}

cannonpile::ring!(Astro);

impl Ring for Astro {
    fn from_integer(n: i128) -> Self {
        Self(BigFloat::from_i128(n, BITS))
    }
}

/// An integer, exactly. The first bit of the words is set.
fn exact(n: &BigInt) -> BigFloat {
    let bits = n.bits();
    let words = (n.magnitude() << (bits.next_multiple_of(64) - bits)).to_u64_digits();
    let sign = if n < &BigInt::ZERO {
        Sign::Neg
    } else {
        Sign::Pos
    };
    BigFloat::from_words(&words, sign, bits.try_into().unwrap_or(i32::MAX))
}

impl Algebra for Astro {
    const EXACTNESS: Exactness = Exactness::Rounded { bits: 128 };
    const NAME: &'static str = "Astro";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        if r.is_zero() {
            return Self::zero();
        }
        Self(exact(r.numer()).div(&exact(r.denom()), BITS, NEAREST))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        let divisor = BigFloat::from_i64(n.get(), BITS);
        Self(self.0.div(&divisor, BITS, NEAREST))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| Self(self.0.div(&divisor.0, BITS, NEAREST)))
    }

    fn is_defined(&self) -> bool {
        !(self.0.is_nan() || self.0.is_inf())
    }
}
