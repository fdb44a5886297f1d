//! The exact value of a number, found by comparisons.

use cannonpile::scalar::Algebra;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed};

/// Exponents of two beyond this magnitude are not looked for.
const MAX_EXPONENT: i64 = 1 << 14;

/// The value of a number.
pub(crate) struct Value {
    /// The value, or a binary fraction below it in magnitude.
    pub(crate) rational: BigRational,
    /// Whether the number is the image of this rational.
    pub(crate) is_exact: bool,
}

/// Returns the value of a number, with at most `bits` bits.
///
/// It compares the number with binary fractions, which gain one bit at each step. A binary float is equal to one of them.
/// Returns `None` for a number that is not defined, or outside the range 2^±16384.
pub(crate) fn value<T: Algebra + PartialOrd>(x: &T, bits: u64) -> Option<Value> {
    if !x.is_defined() {
        return None;
    }
    if x.is_zero() {
        let rational = BigRational::from_integer(0.into());
        return Some(Value {
            rational,
            is_exact: true,
        });
    }
    let is_negative = *x < T::zero();
    let image = |n: &BigInt, e: i64| {
        let magnitude = dyadic(n.clone(), e);
        T::from_rational(&if is_negative { -magnitude } else { magnitude })
    };
    let reaches = |n: &BigInt, e: i64| {
        let image = image(n, e);
        if is_negative {
            *x <= image
        } else {
            *x >= image
        }
    };
    let mut n = BigInt::one();
    let mut exponents = (-1, 1);
    while exponents.1 < MAX_EXPONENT && reaches(&n, exponents.1) {
        exponents = (exponents.1, 2 * exponents.1);
    }
    while exponents.0 > -MAX_EXPONENT && !reaches(&n, exponents.0) {
        exponents = (2 * exponents.0, exponents.0);
    }
    if exponents.0 <= -MAX_EXPONENT || exponents.1 >= MAX_EXPONENT {
        return None;
    }
    let (mut e, mut above) = exponents;
    while above - e > 1 {
        let middle = e + (above - e) / 2;
        if reaches(&n, middle) {
            e = middle;
        } else {
            above = middle;
        }
    }
    while image(&n, e) != *x && n.bits() < bits {
        (n, e) = ((n << 1) + 1, e - 1);
        if !reaches(&n, e) {
            n -= 1;
        }
    }
    let is_exact = image(&n, e) == *x;
    let magnitude = dyadic(n, e);
    let rational = if is_negative { -magnitude } else { magnitude };
    Some(Value { rational, is_exact })
}

/// Returns n·2^e in lowest terms.
pub(crate) fn dyadic(n: BigInt, e: i64) -> BigRational {
    if e < 0 {
        fraction(n, e.unsigned_abs())
    } else {
        BigRational::from_integer(n << e)
    }
}

/// Returns n/2^places in lowest terms.
pub(crate) fn fraction(n: BigInt, places: u64) -> BigRational {
    let twos = n.trailing_zeros().map_or(places, |twos| twos.min(places));
    BigRational::new_raw(n >> twos, BigInt::one() << (places - twos))
}

/// Returns |a − b|.
pub(crate) fn distance(a: &BigRational, b: &BigRational) -> BigRational {
    (a - b).abs()
}
