//! The laws take the precision of a short format into account: half precision passes them.

use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use cannonpile::scalar::{Algebra, CorrectlyRounded, Exactness, Field, Ring, laws};
use cannonpile_testkit::real::{Bounded, Enclosure};
use num_rational::BigRational as Q;
use num_traits::{One, Pow, Zero};

use cannonpile_testkit::answers::ratio;

/// IEEE 754 binary16, with each operation in `f32`. The last `LOST` of its 11 binary digits are lost.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Half<const LOST: i32>(f32);

impl<const LOST: i32> Half<LOST> {
    fn rounded(x: f32) -> Self {
        let digits = 11 - LOST;
        let mut last = 2.0_f32.powi(-24);
        while (x / last).abs() >= 2.0_f32.powi(digits) && x.is_finite() {
            last *= 2.0;
        }
        let value = (x / last).round_ties_even() * last;
        let beyond = value.abs() > 65504.0;
        Self(if beyond {
            value.signum() * f32::INFINITY
        } else {
            value
        })
    }
}

macro_rules! operation {
    ($($operation:ident $method:ident)*) => {$(
        impl<const LOST: i32> $operation<&Self> for Half<LOST> {
            type Output = Self;

            fn $method(self, rhs: &Self) -> Self {
                Self::rounded(self.0.$method(rhs.0))
            }
        }

        impl<const LOST: i32> $operation for Half<LOST> {
            type Output = Self;

            fn $method(self, rhs: Self) -> Self {
                self.$method(&rhs)
            }
        }
    )*};
}

operation!(Add add Sub sub Mul mul);

impl<const LOST: i32> Neg for Half<LOST> {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<const LOST: i32> Zero for Half<LOST> {
    fn zero() -> Self {
        Self(0.0)
    }

    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl<const LOST: i32> One for Half<LOST> {
    fn one() -> Self {
        Self(1.0)
    }
}

impl<const LOST: i32> Ring for Half<LOST> {
    fn from_integer(n: i128) -> Self {
        Self::rounded(f32::from_integer(n))
    }
}

impl<const LOST: i32> Algebra for Half<LOST> {
    const EXACTNESS: Exactness = Exactness::Rounded { bits: 11 };
    const NAME: &'static str = "Half";
    type Numerator = Self;

    fn from_rational(r: &Q) -> Self {
        Self::rounded(f32::nearest_to_rational(r).unwrap_or(f32::NAN))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        Self::rounded(self.0.div_int(n))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        self.0.checked_div(&divisor.0).map(Self::rounded)
    }

    fn is_defined(&self) -> bool {
        self.0.is_finite()
    }
}

impl<const LOST: i32> Field for Half<LOST> {}

impl<const LOST: i32> Bounded for Half<LOST> {
    fn enclosure(&self) -> Option<Enclosure> {
        self.0.enclosure()
    }
}

/// The verdicts on operands from the least values of the format to beyond the greatest.
fn verdicts<const LOST: i32>() -> impl Iterator<Item = Result<(), laws::BrokenLaw>> {
    let powers = [-70, -24, -15, -14, -13, -7, 0, 7, 13, 15, 16, 70];
    let powers = powers.map(|exponent: i32| Q::from_integer(2.into()).pow(exponent));
    let factors = [
        ratio(1, 1),
        ratio(-1, 3),
        ratio(455, 256),
        ratio(2047, 1024),
    ];
    let numbers: Vec<Q> = powers
        .iter()
        .flat_map(|power| factors.iter().map(move |factor| power * factor))
        .collect();
    let pairs = numbers.clone().into_iter().flat_map(move |x| {
        let others = numbers.clone();
        others.into_iter().map(move |y| (x.clone(), y))
    });
    pairs.map(|(x, y)| laws::embedding(&x, &y, Half::<LOST>::bounds))
}

#[test]
fn half_precision_passes() {
    for verdict in verdicts::<0>() {
        assert_eq!(verdict, Ok(()));
    }
    for n in [0, 1, -2049, 65504, 65520, 1 << 70] {
        assert_eq!(laws::integers::<Half<0>>(n), Ok(()));
    }
}

#[test]
fn a_lost_digit_is_caught() {
    assert!(verdicts::<1>().any(|verdict| verdict.is_err()));
}
