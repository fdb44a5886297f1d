//! Random numbers that are the same in every run.

use core::ops::Range;

use cannonpile::scalar::CorrectlyRounded;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

/// A pseudorandom generator (xorshift).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// Starts a sequence, a different one for each nonzero seed.
    pub fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        // Small seeds differ in few bits, so this mixes them.
        for _ in 0..8 {
            random.bits();
        }
        random
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number from a nonempty range.
    pub fn within(&mut self, range: Range<i64>) -> i64 {
        let width = (range.end - range.start).unsigned_abs();
        range.start + i64::try_from((self.bits() >> 20) % width).unwrap_or(0)
    }

    /// A number with 0 ≤ n < end.
    pub fn below(&mut self, end: i128) -> i128 {
        let bits = u128::from(self.bits()) << 64 | u128::from(self.bits());
        (bits >> 1).cast_signed() % end
    }

    /// One of the choices.
    pub fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        let index = (self.bits() >> 24) % choices.len() as u64;
        choices[usize::try_from(index).unwrap_or(0)]
    }

    /// True with probability 1/n.
    pub fn once_in(&mut self, n: u64) -> bool {
        (self.bits() >> 24).is_multiple_of(n)
    }

    /// A positive integer of at most `most_bits` bits.
    pub fn integer(&mut self, most_bits: i64) -> BigInt {
        let bits = self.within(1..most_bits + 1);
        let words = (bits + 63) / 64;
        let all = (0..words).fold(BigInt::one(), |n, _| (n << 64) | BigInt::from(self.bits()));
        (all >> (64 * words - bits)) | BigInt::one()
    }

    /// A positive rational. Numerator and denominator have at most `most_bits` bits.
    pub fn ratio(&mut self, most_bits: i64) -> BigRational {
        BigRational::new(self.integer(most_bits), self.integer(most_bits))
    }

    /// A critical value of a format: the midpoint of two floats or, with probability 1/4, a float. It is subnormal, near the
    /// greatest float, or of moderate size.
    pub fn critical<F: CorrectlyRounded>(&mut self) -> BigRational {
        let precision = i64::from(F::PRECISION);
        let (least, greatest) = (F::MIN_EXPONENT, 3 - F::MIN_EXPONENT - 2 * precision);
        let any = (1 << (precision - 1)) | (self.bits() >> (65 - precision));
        let short = self.bits() >> self.within(64 - precision..63);
        let m = self.of(&[
            any,
            any,
            any,
            short,
            1 << (precision - 1),
            (1 << precision) - 1,
        ]);
        let moderate = self.within(-60..60) - precision;
        let e = if self.is_extreme::<F>() {
            let any = self.within(least..greatest + 1);
            self.of(&[any, least, greatest, greatest - 1])
        } else {
            moderate
        };
        let half = u128::from(!self.once_in(4));
        BigRational::from_integer((2 * u128::from(m) + half).into()) * power(e - 1)
    }

    /// Tells whether to use an end of the format. This is rare for `f64`, whose extreme values have a thousand bits and are
    /// slow.
    fn is_extreme<F: CorrectlyRounded>(&mut self) -> bool {
        self.once_in(if F::PRECISION > 24 { 16 } else { 2 })
    }

    /// A power of two of moderate size. Rarely, its range is from far below the least subnormal of `f64` to above its
    /// greatest float.
    pub fn scale(&mut self) -> BigRational {
        let moderate = self.within(-160..160);
        let any = self.within(-1130..1050);
        power(if self.once_in(12) { any } else { moderate })
    }

    /// A power of two that hides a difference to a tie in low precision: in `f64`, in double-double, or in every format
    /// shorter than the exact value.
    pub fn tiny(&mut self) -> BigRational {
        let bits = self.of(&[(52, 70), (52, 70), (100, 130), (100, 130), (190, 210)]);
        power(-self.within(bits.0..bits.1))
    }
}

/// 2^exponent.
pub fn power(exponent: i64) -> BigRational {
    let magnitude = BigInt::one() << exponent.unsigned_abs();
    if exponent < 0 {
        BigRational::new_raw(BigInt::one(), magnitude)
    } else {
        magnitude.into()
    }
}
