//! The scalar traits for `f32` and `f64`.

use core::num::NonZeroI64;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::{Algebra, CorrectlyRounded, Exactness, Field, Ring};

macro_rules! float_scalar {
    ($float:ident) => {
        impl Ring for $float {
            #[expect(
                clippy::cast_precision_loss,
                reason = "the result is correctly rounded"
            )]
            fn from_integer(n: i128) -> Self {
                n as $float
            }
        }

        impl Algebra for $float {
            const EXACTNESS: Exactness = Exactness::Rounded {
                bits: $float::MANTISSA_DIGITS,
            };
            const NAME: &'static str = stringify!($float);
            type Numerator = Self;

            fn from_rational(r: &BigRational) -> Self {
                // A rational beyond the range of floats becomes not-a-number, which is undefined.
                $float::nearest_to_rational(r).unwrap_or($float::NAN)
            }

            #[expect(
                clippy::cast_precision_loss,
                reason = "a divisor that loses digits takes the other branch"
            )]
            #[inline]
            fn div_int(self, n: NonZeroI64) -> Self {
                let divisor = n.get() as $float;
                let odd_part = n.get().unsigned_abs() >> n.trailing_zeros();
                if odd_part < 1 << $float::MANTISSA_DIGITS {
                    return self / divisor;
                }
                // Divides the exact rational, so that the result is rounded once. Infinities and NaN have no rational.
                match BigRational::from_float(self) {
                    Some(value) => Self::from_rational(&(value / BigInt::from(n.get()))),
                    None => self / divisor,
                }
            }

            #[expect(
                clippy::float_cmp,
                reason = "exactly 1, so that the division can be skipped"
            )]
            #[inline]
            fn checked_div(&self, divisor: &Self) -> Option<Self> {
                if *divisor == 1.0 {
                    return Some(*self);
                }
                (*divisor != 0.0 && divisor.is_finite()).then(|| self / divisor)
            }

            #[inline]
            fn is_defined(&self) -> bool {
                self.is_finite()
            }
        }

        impl Field for $float {}
    };
}

float_scalar!(f32);
float_scalar!(f64);
