//! Sums, products and quotients of rationals whose denominators are mostly powers of three, and the order of rationals.

#[doc(hidden)]
pub use alloc::format;
use core::cmp::Ordering;
use core::hash::{Hash, Hasher};

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

/// Returns the least common multiple of two integers that are not zero. `a` must be positive.
///
/// In most calls one of the two divides the other. The function tests this first, because a division is cheaper
/// than a greatest common divisor.
#[must_use]
pub fn common_multiple(a: BigInt, b: &BigInt) -> BigInt {
    if a.is_multiple_of(b) {
        a
    } else if b.is_multiple_of(&a) {
        b.abs()
    } else {
        a.lcm(b)
    }
}

/// Returns the least common denominator of the numbers.
#[must_use]
pub fn common_denominator<'a>(numbers: impl IntoIterator<Item = &'a BigRational>) -> BigInt {
    let denominators = numbers.into_iter().map(BigRational::denom);
    denominators.fold(BigInt::one(), common_multiple)
}

/// Returns the sum of the numbers. The result is reduced once, at the end.
#[must_use]
pub fn sum_of(numbers: impl IntoIterator<Item = BigRational>) -> BigRational {
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

/// Returns the remainder of the division by a word that is not zero.
fn remainder(x: &BigUint, word: u64) -> u64 {
    let digits = x.iter_u64_digits().rev();
    let rest = digits.fold(0, |high, digit| {
        (high << 64 | u128::from(digit)) % u128::from(word)
    });
    #[expect(clippy::cast_possible_truncation, reason = "less than a word")]
    let rest = rest as u64;
    rest
}

/// Returns (t, x/3^t), where t is the exponent of 3 in `x`, limited to `most`. `x` must not be zero.
///
/// Denominators in a pile are powers of three, one factor for each sign change, times denominators of the input
/// (loads, sin φ, masses). The remainder modulo 3⁴⁰, the largest power of three in a machine word, reveals up to
/// forty factors in one pass over the words of `x`. A general greatest common divisor needs about one pass for each
/// bit.
fn without_threes(mut x: BigUint, most: usize) -> (usize, BigUint) {
    const A_WORD: usize = 40;
    let word = pow(3_u64, A_WORD);
    // Only `Ratio::new_raw` can create a denominator of zero. The operators of `Ratio` panic for such a value
    // as well, and the guarantees of the crate state this exception. Without the assertion the loop would not
    // end.
    assert!(
        !x.is_zero(),
        "the denominator of a rational must not be zero"
    );
    let mut threes = 0;
    loop {
        let mut remainder = remainder(&x, word);
        let most_here = A_WORD.min(most - threes);
        let mut found = if remainder == 0 { most_here } else { 0 };
        // The method of the trait is called because Rust 1.88 has no inherent `is_multiple_of`.
        while found < most_here && Integer::is_multiple_of(&remainder, &3) {
            remainder /= 3;
            found += 1;
        }
        if found > 0 {
            x /= pow(3_u64, found);
            threes += found;
        }
        if found < A_WORD {
            return (threes, x);
        }
    }
}

/// Returns n/d in lowest terms. d must not be zero.
#[must_use]
pub fn quotient(n: BigInt, d: &BigInt) -> BigRational {
    if n.is_zero() || d.is_one() {
        return BigRational::from_integer(n);
    }
    let sign = n.sign() * d.sign();
    let (threes, rest) = without_threes(d.magnitude().clone(), usize::MAX);
    let (shared, mut n) = without_threes(n.into_parts().1, threes);
    let mut d = d.magnitude() / pow(BigUint::from(3_u32), shared);
    if !rest.is_one() {
        // One step of Euclid's algorithm comes first. Then the greatest common divisor works on numbers no
        // longer than `rest`, however long n is.
        let divisor = match u64::try_from(&rest) {
            Ok(rest) => remainder(&n, rest).gcd(&rest).into(),
            Err(_) => (&n % &rest).gcd(&rest),
        };
        n /= &divisor;
        d /= divisor;
    }
    BigRational::new_raw(BigInt::from_biguint(sign, n), d.into())
}

/// Returns the same number in lowest terms, with a positive denominator.
///
/// `Ratio::new_raw` can create others.
///
/// # Examples
/// ```
/// use exact_surd::num_rational::BigRational;
/// use exact_surd::rational::reduced;
///
/// assert_eq!(reduced(BigRational::new_raw(4.into(), (-2).into())).to_string(), "-2");
/// ```
#[must_use]
pub fn reduced(x: BigRational) -> BigRational {
    let (n, d) = x.into_raw();
    quotient(n, &d)
}

/// Returns a·b in lowest terms.
///
/// This is faster than the operator of `Ratio`, whose cost is dominated by general greatest common divisors.
#[must_use]
pub fn product(a: &BigRational, b: &BigRational) -> BigRational {
    quotient(a.numer() * b.numer(), &(a.denom() * b.denom()))
}

/// A rational that is compared by cross-multiplication and hashed by its reduced parts.
///
/// The comparisons and the hash of `Ratio` call themselves once for each common term of two continued fractions. Numbers
/// of a few thousand digits then exhaust the stack. Those of `ByValue` need the same stack for all numbers.
///
/// # Examples
/// ```
/// use exact_surd::num_rational::BigRational;
/// use exact_surd::rational::ByValue;
///
/// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
/// assert!(ByValue(&ratio(1, 3)) < ByValue(&ratio(2, 5)));
/// assert!(ByValue(&ratio(-1, 3)) == ByValue(&BigRational::new_raw(2.into(), (-6).into())));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ByValue<'a>(pub &'a BigRational);

impl Ord for ByValue<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b) = (self.0, other.0);
        if a.denom() == b.denom() && a.denom().is_positive() {
            return a.numer().cmp(b.numer());
        }
        let order = (a.numer() * b.denom()).cmp(&(b.numer() * a.denom()));
        if a.denom().is_negative() == b.denom().is_negative() {
            order
        } else {
            order.reverse()
        }
    }
}

impl PartialOrd for ByValue<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for ByValue<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for ByValue<'_> {}

impl Hash for ByValue<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.reduced().into_raw().hash(state);
    }
}

/// Implements `PartialEq` and `Eq`, after `Hash for` also `Hash`, for a type that contains rationals: two values are equal
/// if and only if their keys are.
///
/// The pattern of the key names every field, so that the compiler refuses a key without a new one. Rationals are in it as
/// [`ByValue`]. By default the key is the `Debug` text. It is for types without floats and surds, whose rationals are in
/// lowest terms.
#[doc(hidden)]
#[macro_export]
macro_rules! equality {
    (Hash for $type:ty; |$value:pat_param| $key:expr) => {
        $crate::equality!($type; |$value| $key);
        impl core::hash::Hash for $type {
            fn hash<H: core::hash::Hasher>(&self, state: &mut H) {
                let $value = self;
                core::hash::Hash::hash(&$key, state);
            }
        }
    };
    ($type:ty $(, $parameter:ident: $bound:path)?; |$value:pat_param| $key:expr) => {
        impl $(<$parameter: $bound + Eq>)? Eq for $type {}
        impl $(<$parameter: $bound>)? PartialEq for $type {
            fn eq(&self, other: &Self) -> bool {
                let [a, b] = [self, other].map(|$value| $key);
                a == b
            }
        }
    };
    ($($type:tt)+) => {
        $crate::equality!($($type)+; |value| $crate::rational::format!("{value:?}"));
    };
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    /// The exponents of 3 lie just below, at and just above multiples of 40, with other factors or without.
    #[test]
    fn quotients_are_in_lowest_terms() {
        let power = |n: i64, k: usize| pow(BigInt::from(n), k);
        // The denominator without its factors 3 is one, a single word, or longer.
        let others = [
            power(1, 1),
            power(-1, 1),
            power(10, 1),
            power(2, 64) - 1,
            power(2, 64),
            power(7, 40),
            power(-7, 50) * 2,
        ];
        let threes = [0, 1, 2, 39, 40, 41, 79, 80, 81, 200];
        let numbers = threes.map(|k| others.each_ref().map(|other| power(3, k) * other));
        let numbers = numbers.as_flattened();
        // The test compares the parts, because `==` also holds for fractions that are not in lowest terms.
        let parts = |x: &BigRational| (x.numer().clone(), x.denom().clone());
        for n in numbers.iter().chain([&BigInt::zero()]) {
            for d in numbers {
                let divided = quotient(n.clone(), d);
                let expected = BigRational::new(n.clone(), d.clone());
                assert_eq!(parts(&divided), parts(&expected), "{n} / {d}");
                // The factors of a product need not be in lowest terms.
                let [a, b] = [[n, d], [d, n]].map(|[n, d]| {
                    let d = if d.is_zero() {
                        BigInt::one()
                    } else {
                        d.clone()
                    };
                    BigRational::new_raw(n.clone(), d)
                });
                let expected = BigRational::new(a.numer() * b.numer(), a.denom() * b.denom());
                assert_eq!(parts(&product(&a, &b)), parts(&expected), "{a} {b}");
            }
        }
    }

    /// Also of fractions that are not in lowest terms, and of negative denominators.
    #[test]
    fn values_are_ordered_as_numbers() {
        let sides = [-6, -4, -3, -1, 1, 2, 3, 8];
        let ratios = sides.map(|d| [-4, -3, 0, 2, 6].map(|n| [n, d]));
        let hash = |x: &BigRational| {
            let mut hasher = std::hash::DefaultHasher::new();
            ByValue(x).hash(&mut hasher);
            hasher.finish()
        };
        for a in ratios.as_flattened() {
            for b in ratios.as_flattened() {
                let [x, y] = [a, b].map(|[n, d]| BigRational::new_raw((*n).into(), (*d).into()));
                let expected = (a[0] * b[1] * a[1] * b[1]).cmp(&(b[0] * a[1] * a[1] * b[1]));
                assert_eq!(ByValue(&x).cmp(&ByValue(&y)), expected, "{a:?} {b:?}");
                assert_eq!(hash(&x) == hash(&y), expected.is_eq(), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn factors_of_three_are_found_up_to_limit() {
        for threes in [0, 1, 39, 40, 41, 80, 81, 200] {
            for other in [1_u32, 2, 70] {
                let number = pow(BigUint::from(3_u32), threes) * other;
                let found = without_threes(number.clone(), usize::MAX);
                assert_eq!(found, (threes, other.into()));
                for most in [0, 1, 40, 41, 90] {
                    let found = threes.min(most);
                    let left = &number / pow(BigUint::from(3_u32), found);
                    assert_eq!(
                        without_threes(number.clone(), most),
                        (found, left),
                        "{most}"
                    );
                }
            }
        }
    }

    #[test]
    fn sums_have_least_common_denominator() {
        let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
        // Relative to the common denominator so far, the next one is equal, a multiple, a divisor, and neither.
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
