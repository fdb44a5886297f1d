//! Sums, products and quotients of rationals whose denominators are mostly powers of three.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

/// Returns the least common multiple of two positive integers. Most denominators of a pile divide each other, which is found
/// sooner than a divisor.
#[must_use]
pub fn common_multiple(a: BigInt, b: &BigInt) -> BigInt {
    if a.is_multiple_of(b) {
        a
    } else if b.is_multiple_of(&a) {
        b.clone()
    } else {
        a.lcm(b)
    }
}

/// Returns the least denominator over which all the numbers are fractions.
#[must_use]
pub fn common_denominator<'a>(numbers: impl IntoIterator<Item = &'a BigRational>) -> BigInt {
    let denominators = numbers.into_iter().map(BigRational::denom);
    denominators.fold(BigInt::one(), common_multiple)
}

/// Returns the sum of numbers, which is reduced once.
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

/// Returns the remainder of a division by a word that is not zero.
fn remainder(x: &BigUint, word: u64) -> u64 {
    let digits = x.iter_u64_digits().rev();
    let rest = digits.fold(0, |high, digit| {
        (high << 64 | u128::from(digit)) % u128::from(word)
    });
    #[expect(clippy::cast_possible_truncation, reason = "less than a word")]
    let rest = rest as u64;
    rest
}

/// Divides a number that is not zero by three as often as that leaves no rest, `most` times at most; returns how often, and what is left.
///
/// The denominators of a pile are powers of three, one for each change of sign, times those of the loads. How many threes a number
/// shares with them is seen in its remainder by 3⁴⁰, the greatest power in a machine word: forty in a pass over its words, where a divisor
/// that is looked for takes a pass a bit.
fn without_threes(mut x: BigUint, most: usize) -> (usize, BigUint) {
    const A_WORD: usize = 40;
    let word = pow(3_u64, A_WORD);
    // Only a `Ratio` that was put together wrongly has a denominator of zero: it panics here as in its own operators, which is said in
    // the guarantees, and would else have no end.
    assert!(!x.is_zero(), "zero has threes without end");
    let mut threes = 0;
    loop {
        let mut remainder = remainder(&x, word);
        let most_here = A_WORD.min(most - threes);
        let mut found = if remainder == 0 { most_here } else { 0 };
        // The method of the trait: Rust 1.88 has none of words.
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

/// Returns n/d in lowest terms, for a denominator that is not zero.
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
        // One step of Euclid first: the divisor that is left works on numbers no longer than what loads brought into the
        // denominator, however long n is.
        let divisor = match u64::try_from(&rest) {
            Ok(rest) => remainder(&n, rest).gcd(&rest).into(),
            Err(_) => (&n % &rest).gcd(&rest),
        };
        n /= &divisor;
        d /= divisor;
    }
    BigRational::new_raw(BigInt::from_biguint(sign, n), d.into())
}

/// Returns a·b. `Ratio` looks for common factors of the products, which takes longer than all the rest.
#[must_use]
pub fn product(a: &BigRational, b: &BigRational) -> BigRational {
    quotient(a.numer() * b.numer(), &(a.denom() * b.denom()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With as many threes on both sides as words hold, one less and one more, and with other divisors beside them.
    #[test]
    fn quotients_are_in_lowest_terms() {
        let power = |n: i64, k: usize| pow(BigInt::from(n), k);
        // What is left of a denominator is one, a word, or longer.
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
        // `==` does not tell lowest terms.
        let parts = |x: &BigRational| (x.numer().clone(), x.denom().clone());
        for n in numbers.iter().chain([&BigInt::zero()]) {
            for d in numbers {
                let divided = quotient(n.clone(), d);
                let expected = BigRational::new(n.clone(), d.clone());
                assert_eq!(parts(&divided), parts(&expected), "{n} / {d}");
                // A factor may be in other terms.
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

    #[test]
    fn all_threes_are_found_and_no_more_than_are_asked_for() {
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
