//! Exact parsing of rationals and integers.
//!
//! All parsers share one limit on the number of digits, [`MAX_DIGITS`]. Hence the printed form of every
//! parsed number can be parsed again.

use core::str::FromStr;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Pow, Signed, Zero};

use crate::{Error, Surd};

/// The maximum number of digits of an integer, a numerator or a denominator: 5,000.
///
/// Powers of ten count: `1e4999` is accepted and `1e5000` is rejected.
pub const MAX_DIGITS: usize = 5_000;

/// A description of the expected text, which completes "… is not".
type Expected = &'static str;

const NUMBER: Expected = "a number such as 6/5, 1.2 or 1e-3";
const SHORTER: Expected = "a number of at most 5000 digits";

/// Parses a rational: `6/5`, `-3`, or a decimal such as `1.2`, `.5` or `1e-3`, which is read exactly.
///
/// # Errors
/// Returns [`Error::Syntax`] if `text` is not a rational, or has more than [`MAX_DIGITS`] digits.
///
/// # Examples
/// ```
/// use exact_surd::parse;
///
/// assert_eq!(parse::rational("12/10")?.to_string(), "6/5");
/// assert_eq!(parse::rational("0.1")?.to_string(), "1/10");
/// assert_eq!(parse::rational("25e-1")?.to_string(), "5/2");
/// assert_eq!(
///     parse::rational("1/0").unwrap_err().to_string(),
///     "'1/0' is not a number with a denominator other than zero",
/// );
/// # Ok::<(), exact_surd::Error>(())
/// ```
pub fn rational(text: &str) -> Result<BigRational, Error> {
    let read = match text.split_once('/') {
        Some((numer, denom)) => fraction(numer, denom),
        None => decimal(text),
    };
    read.map_err(|expected| Error::syntax(text, expected))
}

/// Parses an integer: `-12`, or with a power of ten, `1e36`, `2.5e3`.
///
/// # Errors
/// Returns [`Error::Syntax`] if `text` is not an integer, or has more than [`MAX_DIGITS`] digits.
///
/// # Examples
/// ```
/// use exact_surd::parse;
///
/// assert_eq!(parse::big_integer("1e3")?, 1000.into());
/// assert!(parse::big_integer("1e-3").is_err());
/// assert!(parse::big_integer("1.0").is_err());
/// # Ok::<(), exact_surd::Error>(())
/// ```
pub fn big_integer(text: &str) -> Result<BigInt, Error> {
    // A decimal point is allowed only with a power of ten.
    let read = if text.contains(['e', 'E']) {
        decimal(text)
    } else {
        signed(text).map(BigRational::from_integer)
    };
    match read {
        Ok(number) if number.is_integer() => Ok(number.to_integer()),
        Err(SHORTER) => Err(Error::syntax(text, SHORTER)),
        _ => Err(Error::syntax(text, "an integer such as 12 or 1e6")),
    }
}

/// Parses an integer that fits an `i128`: `-12`, or with a power of ten, `1e36`.
///
/// # Errors
/// Returns [`Error::Syntax`] if `text` is not an integer, or does not fit.
///
/// # Examples
/// ```
/// use exact_surd::parse;
///
/// assert_eq!(parse::integer("-12")?, -12);
/// assert_eq!(parse::integer("1e36")?, 10_i128.pow(36));
/// assert!(parse::integer("1.5").is_err());
/// # Ok::<(), exact_surd::Error>(())
/// ```
pub fn integer(text: &str) -> Result<i128, Error> {
    let read = big_integer(text).ok().and_then(|n| n.try_into().ok());
    read.ok_or_else(|| Error::syntax(text, "an integer of at most 38 digits"))
}

impl FromStr for Surd {
    type Err = Error;

    /// Parses a number c·√r in its printed form: `7/3`, `sqrt(2)`, `-7/3*sqrt(2)`. The radicand is any
    /// rational that is zero or positive.
    ///
    /// # Errors
    /// Returns [`Error::Syntax`] for an invalid text, and [`Error::NegativeRadicand`] for a negative
    /// radicand.
    fn from_str(text: &str) -> Result<Self, Error> {
        let Some((coefficient, root)) = text.split_once("sqrt(") else {
            return rational(text).map(Self::from);
        };
        let syntax = || Error::syntax(text, "a number such as 7/3 or 7/3*sqrt(2)");
        let radicand = root.strip_suffix(')').ok_or_else(syntax)?;
        let coefficient = match coefficient {
            "" => "1",
            "-" => "-1",
            factor => factor.strip_suffix('*').ok_or_else(syntax)?,
        };
        Self::new(rational(coefficient)?, rational(radicand)?)?.if_short(text)
    }
}

impl Surd {
    /// Returns the number if its printed form can be parsed again.
    ///
    /// The normal form of `text` can have more digits than its parts: √(a/b) is stored as √(ab)/b.
    ///
    /// # Errors
    /// Returns [`Error::Syntax`], which quotes `text`, if a part has more than [`MAX_DIGITS`] digits.
    #[doc(hidden)]
    pub fn if_short(self, text: &str) -> Result<Self, Error> {
        let coefficient = self.coefficient();
        let [numer, denom] = [coefficient.numer(), coefficient.denom()].map(BigInt::magnitude);
        if [numer, denom, self.radicand()].into_iter().all(is_short) {
            Ok(self)
        } else {
            Err(Error::syntax(text, SHORTER))
        }
    }
}

/// Returns whether an integer has at most [`MAX_DIGITS`] digits.
fn is_short(n: &BigUint) -> bool {
    // One decimal digit is more than three bits, so this cheap test suffices for most numbers.
    n.bits() <= 3 * MAX_DIGITS as u64 || *n < Pow::pow(BigUint::from(10_u32), MAX_DIGITS)
}

fn fraction(numer: &str, denom: &str) -> Result<BigRational, Expected> {
    let (numer, denom) = (signed(numer)?, unsigned(denom)?);
    if denom.is_zero() {
        return Err("a number with a denominator other than zero");
    }
    Ok(BigRational::new(numer, denom))
}

fn decimal(text: &str) -> Result<BigRational, Expected> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (negative, mantissa) = sign(mantissa);
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if whole.len() + fraction.len() > MAX_DIGITS {
        // The error says "too many digits" only if the text is otherwise a number.
        let digits = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
        let number = digits(whole) && digits(fraction);
        return Err(if number { SHORTER } else { NUMBER });
    }
    let digits = unsigned(&[whole, fraction].concat())?;
    let shift = signed(exponent)? - fraction.len();
    let power = u16::try_from(shift.magnitude()).map_err(|_| SHORTER)?;
    let others = if shift.is_negative() {
        1
    } else {
        whole.len() + fraction.len()
    };
    if usize::from(power) + others > MAX_DIGITS {
        return Err(SHORTER);
    }
    let scale = Pow::pow(BigInt::from(10), power);
    let numer = if negative { -digits } else { digits };
    Ok(if shift.is_negative() {
        BigRational::new(numer, scale)
    } else {
        BigRational::from_integer(numer * scale)
    })
}

/// Parses an integer with an optional sign.
fn signed(text: &str) -> Result<BigInt, Expected> {
    let (negative, rest) = sign(text);
    let unsigned = unsigned(rest)?;
    Ok(if negative { -unsigned } else { unsigned })
}

/// Returns whether the text begins with a minus sign, and the text after the sign.
fn sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    }
}

/// Parses a non-empty sequence of decimal digits.
fn unsigned(text: &str) -> Result<BigInt, Expected> {
    if text.is_empty() || !text.bytes().all(|b| b.is_ascii_digit()) {
        return Err(NUMBER);
    }
    if text.len() > MAX_DIGITS {
        return Err(SHORTER);
    }
    BigInt::parse_bytes(text.as_bytes(), 10).ok_or(NUMBER)
}

#[cfg(test)]
mod tests {
    use alloc::format;
    use alloc::string::ToString;

    use super::*;

    #[test]
    fn all_parsers_share_digit_limit() {
        let nines = |n: usize| "9".repeat(n);
        let most = MAX_DIGITS;
        for read in [
            nines(most),
            format!("-{}/{}", nines(most), nines(most - 1)),
            format!("0.{}", nines(most - 1)),
            format!("{}.{}", nines(most / 2), nines(most / 2)),
            format!("1e{}", most - 1),
            format!("1e-{}", most - 1),
            format!("{}e-10", nines(most)),
        ] {
            let value = rational(&read).unwrap();
            // The printed form can be parsed.
            assert_eq!(rational(&value.to_string()), Ok(value));
        }
        for refused in [
            nines(most + 1),
            format!("1/{}", nines(most + 1)),
            format!("0.{}", nines(most)),
            format!("1e{most}"),
            format!("10e{}", most - 1),
            format!("1e-{most}"),
            format!("1e{}", nines(most)),
        ] {
            let message = rational(&refused).unwrap_err().to_string();
            assert!(message.ends_with("is not a number of at most 5000 digits"));
            assert!(message.len() < 150, "{message}");
        }
    }

    /// 10^(n+1) + 9 and 10^(n+1) + 7 have no common factor, so the radicand of the normal form is their
    /// product.
    #[test]
    fn root_is_accepted_if_its_printed_form_is() {
        let ends_in = |zeros: usize, digit: char| format!("1{}{digit}", "0".repeat(zeros));
        for (zeros, is_read) in [(2_498, true), (2_999, false)] {
            let [numer, denom] = ['9', '7'].map(|digit| ends_in(zeros, digit));
            let text = format!("-2*sqrt({numer}/{denom})");
            let read: Result<Surd, Error> = text.parse();
            assert_eq!(read.is_ok(), is_read, "{zeros}");
            if let Ok(read) = read {
                assert_eq!(read.to_string().parse(), Ok(read));
            }
        }
        // The first coefficient has 5000 digits, the second 5001.
        let times_ten = |digits: &str| format!("{digits}*sqrt(100)").parse::<Surd>();
        assert!(times_ten(&"9".repeat(MAX_DIGITS - 1)).is_ok());
        assert!(times_ten(&ends_in(MAX_DIGITS - 2, '0')).is_err());
    }

    #[test]
    fn too_many_digits_is_reported_for_numbers_only() {
        let long = "9".repeat(MAX_DIGITS + 1);
        for text in [
            format!("x{long}"),
            format!("{long}.x"),
            format!("x.{long}"),
            format!("1/{long}x"),
            format!("{long}_/1"),
        ] {
            let message = rational(&text).unwrap_err().to_string();
            assert!(message.ends_with("is not a number such as 6/5, 1.2 or 1e-3"));
        }
        for text in [long.clone(), format!("-{long}"), format!("{long}e0")] {
            let message = big_integer(&text).unwrap_err().to_string();
            assert!(message.ends_with("is not a number of at most 5000 digits"));
        }
        let message = big_integer(&format!("{long}x")).unwrap_err().to_string();
        assert!(message.ends_with("is not an integer such as 12 or 1e6"));
    }

    #[test]
    fn characters_other_than_digits_are_rejected() {
        for text in [
            "", "-", "+", ".", "1_000", "--5", "+-5", "-+5", "1/-5", "1/+5", "1/", "/2", "1e--3",
            "1e1_0", "1._5", "1.-5", "0x10", " 1", "1 ",
        ] {
            let refused = Err(Error::syntax(text, NUMBER));
            assert_eq!(rational(text), refused, "{text:?}");
        }
    }

    #[test]
    fn integers_accept_powers_of_ten() {
        for (text, value) in [("1e3", 1_000), ("2.5E+3", 2_500), ("-10e-1", -1), ("+7", 7)] {
            assert_eq!(integer(text), Ok(value), "{text}");
        }
        for text in ["1.0", "1/1", "1e-1", "e3", "1e", "", "1e39", "1e1e1"] {
            assert!(integer(text).is_err(), "{text}");
        }
    }
}
