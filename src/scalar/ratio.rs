//! A macro for rational literals.

use num_rational::BigRational;

/// Returns a [`BigRational`](crate::num_rational::BigRational) from integer literals: `ratio!(6/5)` or `ratio!(6)`.
///
/// The result is in lowest terms. A denominator of zero does not compile.
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile::ratio;
///
/// assert_eq!(Spacing::new(ratio!(6/5))?.square(), &ratio!(36/25));
/// assert_eq!(ratio!(-2/4).to_string(), "-1/2");
/// assert_eq!(ratio!(3).to_string(), "3");
/// # Ok::<(), cannonpile::Error>(())
/// ```
/// ```compile_fail
/// let fault = cannonpile::ratio!(1/0);
/// ```
#[macro_export]
macro_rules! ratio {
    ($numer:literal / $denom:literal) => {{
        const DENOMINATOR: i128 = $denom;
        const { assert!(DENOMINATOR != 0, "a denominator of zero") };
        $crate::scalar::quotient($numer, DENOMINATOR)
    }};
    ($integer:literal) => {
        $crate::scalar::quotient($integer, 1)
    };
}

/// Returns `numer / denom`, for [`ratio!`](crate::ratio), which checks that `denom` is not zero.
#[doc(hidden)]
#[must_use]
pub fn quotient(numer: i128, denom: i128) -> BigRational {
    BigRational::new(numer.into(), denom.into())
}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    #[test]
    fn literals_are_taken_at_their_value() {
        for (ratio, text) in [
            (ratio!(6 / 5), "6/5"),
            (ratio!(-6 / 4), "-3/2"),
            (ratio!(6 / -4), "-3/2"),
            (ratio!(0 / 7), "0"),
            (ratio!(1_000 / 0x10), "125/2"),
            (ratio!(-12), "-12"),
            (
                ratio!(170_141_183_460_469_231_731_687_303_715_884_105_727),
                "170141183460469231731687303715884105727",
            ),
        ] {
            assert_eq!(ratio.to_string(), text);
        }
    }
}
