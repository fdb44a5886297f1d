//! `BigRational`: exact, of any size.

use core::num::NonZeroI64;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::{Algebra, Enclosure, Exactness, Field, RealEmbeddable, RealSign, Ring};

/// Returns the least common multiple of two positive integers. Most denominators of a pile divide each other, which is found
/// sooner than a divisor.
pub(crate) fn common_multiple(a: BigInt, b: &BigInt) -> BigInt {
    if a.is_multiple_of(b) {
        a
    } else if b.is_multiple_of(&a) {
        b.clone()
    } else {
        a.lcm(b)
    }
}

/// Returns the least denominator over which all the numbers are fractions.
pub(crate) fn common_denominator<'a>(numbers: impl IntoIterator<Item = &'a BigRational>) -> BigInt {
    let denominators = numbers.into_iter().map(BigRational::denom);
    denominators.fold(BigInt::one(), common_multiple)
}

/// Returns the sum of numbers, which is reduced once.
pub(crate) fn sum_of(numbers: impl IntoIterator<Item = BigRational>) -> BigRational {
    let (mut numerator, mut denominator) = (BigInt::zero(), BigInt::one());
    for number in numbers {
        let wider = common_multiple(denominator.clone(), number.denom());
        if wider != denominator {
            numerator *= &wider / denominator;
            denominator = wider;
        }
        numerator += number.numer() * (&denominator / number.denom());
    }
    BigRational::new(numerator, denominator)
}

impl Ring for BigRational {
    fn from_i128(n: i128) -> Self {
        Self::from_integer(n.into())
    }
}

impl Algebra for BigRational {
    type Numerator = BigInt;

    const EXACTNESS: Exactness = Exactness::Exact;
    const NAME: &'static str = "BigRational";

    fn from_rational(r: &BigRational) -> Self {
        r.clone()
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        self / BigInt::from(n.get())
    }

    fn is_defined(&self) -> bool {
        true
    }

    fn numerators<const N: usize>(values: &[BigRational; N]) -> ([BigInt; N], BigInt) {
        let common = common_denominator(values);
        let numerators = values.each_ref().map(|r| r.numer() * (&common / r.denom()));
        (numerators, common)
    }

    fn from_ratio(n: BigInt, d: &BigInt) -> Option<Self> {
        if d.is_zero() {
            return None;
        }
        // One step of Euclid first: the gcd that is left works on numbers no longer than d, which here
        // is short, however long n is.
        let divisor = (&n % d).gcd(d);
        let divisor = if d.is_negative() { -divisor } else { divisor };
        Some(Self::new_raw(n / &divisor, d / &divisor))
    }
}

impl Field for BigRational {
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (!divisor.is_zero()).then(|| self / divisor)
    }
}

impl RealEmbeddable for BigRational {
    fn sign(&self) -> RealSign {
        if self.is_positive() {
            RealSign::Positive
        } else if self.is_negative() {
            RealSign::Negative
        } else {
            RealSign::Zero
        }
    }

    fn enclosure(&self) -> Option<Enclosure> {
        Some(Enclosure::point(self.clone()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_have_the_denominators_that_are_needed() {
        let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
        // Wider, as wide, wider by a multiple, and beside each other; the sum is in lowest terms.
        let numbers = [
            ratio(1, 2),
            ratio(-3, 2),
            ratio(5, 4),
            ratio(1, 2),
            ratio(1, 6),
        ];
        let multiples = [2, 2, 4, 4, 12];
        for (n, multiple) in (1..).zip(multiples) {
            assert_eq!(common_denominator(&numbers[..n]), multiple.into());
            let one_by_one = numbers[..n].iter().sum::<BigRational>();
            let sum = sum_of(numbers[..n].to_vec());
            assert_eq!(
                (sum.numer(), sum.denom()),
                (one_by_one.numer(), one_by_one.denom())
            );
        }
        assert_eq!(sum_of([]), BigRational::zero());
        assert_eq!(common_denominator([]), BigInt::one());
    }
}
