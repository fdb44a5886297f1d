//! Rounding to short formats, those of `half` and some of one's own: every float, every midpoint, and numbers beside them.

use core::fmt::Debug;

use exact_surd::num_bigint::BigInt;
use exact_surd::num_rational::BigRational;
use exact_surd::{CorrectlyRounded, Surd};

/// A format with its floats in order: those without a sign have the numbers 0 to `GREATEST`.
trait Format: CorrectlyRounded + Debug + PartialEq {
    const GREATEST: u32;

    fn numbered(negative: bool, number: u32) -> Self;

    /// Returns the value of a float without a sign, or of the one that would follow the greatest.
    fn value(number: u32) -> BigRational {
        let hidden = 1 << (Self::PRECISION - 1);
        let significand = match number {
            0.. if number < hidden => number,
            _ => hidden + number % hidden,
        };
        let exponent = i64::from((number / hidden).max(1) - 1) + Self::MIN_EXPONENT;
        let power = BigRational::from_integer(2.into()).pow(exponent.try_into().unwrap());
        BigRational::from_integer(significand.into()) * power
    }

    /// Returns the value halfway between a float and the next one.
    fn midpoint(number: u32) -> BigRational {
        (Self::value(number) + Self::value(number + 1)) / BigInt::from(2)
    }

    /// Returns a float, or `None` beyond the greatest.
    fn expected(negative: bool, number: u32) -> Option<Self> {
        (number <= Self::GREATEST).then(|| Self::numbered(negative, number))
    }
}

/// The format of `P` bits in the significand whose least float is 2^−9, with the number of a float as its bits.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Short<const P: u32>(bool, u32);

impl<const P: u32> CorrectlyRounded for Short<P> {
    const PRECISION: u32 = P;
    const MIN_EXPONENT: i64 = -9;

    fn from_parts(negative: bool, significand: u64, exponent: i64) -> Option<Self> {
        assert!(significand < 1 << P && exponent >= -9);
        assert!(significand >> (P - 1) == 1 || exponent == -9);
        let number = u64::try_from(exponent + 9).unwrap() << (P - 1);
        let number = u32::try_from(number.checked_add(significand)?).ok()?;
        Self::expected(negative, number)
    }
}

impl<const P: u32> Format for Short<P> {
    const GREATEST: u32 = (10 << (P - 1)) - 2;

    fn numbered(negative: bool, number: u32) -> Self {
        Self(negative, number)
    }
}

#[cfg(feature = "half")]
macro_rules! sixteen_bits {
    ($($float:ty)*) => {$(
        impl Format for $float {
            const GREATEST: u32 = <$float>::MAX.to_bits() as u32;

            fn numbered(negative: bool, number: u32) -> Self {
                let bits = u16::try_from(number).unwrap();
                Self::from_bits(bits | u16::from(negative) << 15)
            }
        }
    )*};
}

#[cfg(feature = "half")]
sixteen_bits!(half::f16 half::bf16);

/// Checks the rounding of a number without a sign and of its negative, as rationals and as surds. Floats are compared by
/// their text too, which has the sign of a zero.
fn check<F: Format>(number: &BigRational, expected: u32) {
    for negative in [false, true] {
        let given = if negative { -number } else { number.clone() };
        let is_zero = given == BigRational::from_integer(0.into());
        let want = F::expected(negative && !is_zero, expected);
        let found = [
            F::nearest_to_rational(&given),
            Surd::from(given.clone()).nearest(),
        ];
        assert_eq!(found, [want; 2], "{given}");
        assert_eq!(format!("{found:?}"), format!("{:?}", [want; 2]), "{given}");
    }
}

fn every_float_and_midpoint<F: Format>() {
    let tiny = BigRational::from_integer(2.into()).pow(-200);
    for number in 0..=F::GREATEST {
        check::<F>(&F::value(number), number);
        let middle = F::midpoint(number);
        check::<F>(&middle, number + number % 2);
        check::<F>(&(&middle - &tiny), number);
        check::<F>(&(&middle + &tiny), number + 1);
    }
    let huge = F::value(F::GREATEST) * BigInt::from(1_000);
    check::<F>(&huge, F::GREATEST + 1);
}

#[test]
fn floats_and_midpoints_of_formats_of_ones_own_are_rounded() {
    every_float_and_midpoint::<Short<2>>();
    every_float_and_midpoint::<Short<4>>();
    every_float_and_midpoint::<Short<7>>();
}

#[cfg(feature = "half")]
#[test]
fn every_f16_and_midpoint_is_rounded() {
    every_float_and_midpoint::<half::f16>();
}

#[cfg(feature = "half")]
#[test]
fn every_bf16_and_midpoint_is_rounded() {
    every_float_and_midpoint::<half::bf16>();
}

/// The longest significand, whose rounding may carry into bit 63.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Long(bool, u64, i64);

impl CorrectlyRounded for Long {
    const PRECISION: u32 = 63;
    const MIN_EXPONENT: i64 = -1_000_000;

    fn from_parts(negative: bool, significand: u64, exponent: i64) -> Option<Self> {
        Some(Self(negative, significand, exponent))
    }
}

#[test]
fn significands_may_have_63_bits() {
    let most = BigInt::from(u64::MAX >> 1);
    let nearest =
        |numerator: BigInt| Long::nearest_to_rational(&BigRational::new(numerator, 4.into()));
    let [exact, above] = [&most * 4, &most * 4 + 1].map(nearest);
    assert_eq!([exact, above], [Some(Long(false, u64::MAX >> 1, 0)); 2]);
    assert_eq!(nearest(-most * 4 - 2), Some(Long(true, 1 << 62, 1)));
}

/// Parts that no rounding gives: the significand is too long, or the last bit is not where the format has it.
#[test]
fn parts_beside_those_of_a_float_give_none() {
    let hidden = 1_u64 << 52;
    let float = |significand, exponent| f64::from_parts(false, significand, exponent);
    assert_eq!(float(hidden, -1074), Some(f64::MIN_POSITIVE));
    assert_eq!(
        float(hidden - 1, -1074),
        Some(f64::MIN_POSITIVE.next_down())
    );
    assert_eq!(float(2 * hidden - 1, 971), Some(f64::MAX));
    for exponent in [i64::MIN, -1076, -1075, -1073, 0, 972, i64::MAX] {
        assert_eq!(float(hidden - 1, exponent), None);
        assert_eq!(float(2 * hidden, exponent), None);
        let is_of_a_float = (-1074..=971).contains(&exponent);
        assert_eq!(float(hidden, exponent).is_some(), is_of_a_float);
    }
}

/// Compares roundings with integers, for numbers close to midpoints. A root is compared by its square.
#[cfg(feature = "half")]
fn hard_cases<F: Format>(cases: u32) {
    let mut state = 54_u64;
    let mut below = |most: u32| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        u32::try_from(state >> 33).unwrap() % most
    };
    for _ in 0..cases {
        let number = below(F::GREATEST);
        let middle = F::midpoint(number);
        let power =
            BigRational::from_integer(2.into()).pow(-20 - i32::try_from(below(240)).unwrap());
        let little = &middle * power / BigInt::from(1 + below(1_000));
        let [down, up] = [&middle - &little, &middle + &little];
        let nearest = F::nearest_to_rational;
        assert_eq!(
            [nearest(&down), nearest(&up)],
            [F::expected(false, number), F::expected(false, number + 1)]
        );
        let square = &middle * &middle;
        let roots = [&square - &little * &middle, &square + little * middle];
        let [down, up] = roots.map(|square| Surd::sqrt(square).unwrap().nearest());
        assert_eq!(
            [down, up],
            [F::expected(false, number), F::expected(false, number + 1)]
        );
    }
}

/// A million numbers in release, and 40,000 in debug, because the million takes minutes there.
#[cfg(feature = "half")]
#[test]
fn numbers_beside_midpoints_are_rounded() {
    let cases = if cfg!(debug_assertions) {
        5_000
    } else {
        125_000
    };
    hard_cases::<half::f16>(cases);
    hard_cases::<half::bf16>(cases);
}
