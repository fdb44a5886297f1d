//! The measured formats.

use std::cell::Cell;
use std::num::NonZeroI64;
use std::ops::{Add, Mul, Sub};

use cannonpile::num_rational::BigRational;
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness, Plain, Ring, promise};

use crate::random::Random;

/// A format, by its name and its unit roundoff 2^−bits.
pub(crate) trait Format: Algebra {
    const LABEL: &'static str;
    const BITS: u32;

    /// The value, exactly.
    fn wide(&self) -> DoubleDouble;
}

pub(crate) type Half = Plain<half::f16, promise::Rounded>;
pub(crate) type Brain = Plain<half::bf16, promise::Rounded>;

macro_rules! formats {
    ($($format:ty, $label:literal, $bits:literal, |$x:ident| $value:expr;)*) => {$(
        impl Format for $format {
            const LABEL: &'static str = $label;
            const BITS: u32 = $bits;

            fn wide(&self) -> DoubleDouble {
                let $x = self;
                $value
            }
        }
    )*};
}

formats! {
    Half, "f16", 11, |x| DoubleDouble::new(x.0.into());
    Brain, "bf16", 8, |x| DoubleDouble::new(x.0.into());
    f32, "f32", 24, |x| DoubleDouble::new((*x).into());
    f64, "f64", 53, |x| DoubleDouble::new(*x);
    DoubleDouble, "double-double", 106, |x| *x;
    Bits<11, false>, "11 bits", 11, |x| DoubleDouble::new(x.0);
    Bits<8, true>, "8 bits, ties at random", 8, |x| DoubleDouble::new(x.0);
    Bits<11, true>, "11 bits, ties at random", 11, |x| DoubleDouble::new(x.0);
    Bits<24, true>, "24 bits, ties at random", 24, |x| DoubleDouble::new(x.0);
}

/// An `f64` rounded to nearest to P bits after every operation, ties to even or at random. Its exponents are those of `f64`.
/// Up to 25 bits the rounding of the `f64` before does not change a sum or a quotient to nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bits<const P: u32, const RANDOM_TIES: bool>(f64);

thread_local! {
    /// The bench sweeps on one thread, so that the numbers are the same in every run.
    static RANDOM: Cell<Random> = const { Cell::new(Random(1)) };
}

impl<const P: u32, const RANDOM_TIES: bool> Bits<P, RANDOM_TIES> {
    fn new(x: f64) -> Self {
        let (cut, bits) = (53 - P, x.to_bits());
        let mask = (1_u64 << cut) - 1;
        let is_even = (bits >> cut) & 1 == 0;
        let rounds_down = if RANDOM_TIES && bits & mask == (mask >> 1) + 1 {
            let mut random = RANDOM.get();
            let next = random.below(2) == 0;
            RANDOM.set(random);
            next
        } else {
            is_even
        };
        // Half a unit goes up, or a little less, which matters in a tie only.
        let added = (mask >> 1) + u64::from(!rounds_down);
        Self(f64::from_bits((bits + added) & !mask))
    }
}

macro_rules! operator {
    ($trait:ident, $name:ident, $operator:tt) => {
        impl<const P: u32, const RANDOM_TIES: bool> $trait<&Self> for Bits<P, RANDOM_TIES> {
            type Output = Self;
            fn $name(self, other: &Self) -> Self {
                Self::new(self.0 $operator other.0)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);

macro_rules! scalar {
    ($($p:literal, $random:literal;)*) => {$(
        cannonpile::ring!(Bits<$p, $random>);

        impl Ring for Bits<$p, $random> {
            fn from_integer(n: i128) -> Self {
                Self::new(f64::from_integer(n))
            }
        }

        impl Algebra for Bits<$p, $random> {
            const EXACTNESS: Exactness = Exactness::Unknown;
            const NAME: &'static str = Self::LABEL;
            type Numerator = Self;

            fn from_rational(r: &BigRational) -> Self {
                Self::new(f64::from_rational(r))
            }

            fn div_int(self, n: NonZeroI64) -> Self {
                Self::new(self.0.div_int(n))
            }

            fn checked_div(&self, divisor: &Self) -> Option<Self> {
                self.0.checked_div(&divisor.0).map(Self::new)
            }

            fn is_defined(&self) -> bool {
                self.0.is_finite()
            }
        }
    )*};
}
scalar! { 11, false; 8, true; 11, true; 24, true; }
