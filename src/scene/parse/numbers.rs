//! Numbers from text, exactly.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Pow, Signed, Zero};

use crate::Error;

/// The longest number read, in bytes; any decimal that is read is printed as a shorter fraction.
pub(super) const LONGEST: usize = 5_000;

/// The longest decimal read, in bytes.
const LONGEST_DECIMAL: usize = 1_000;

/// The greatest power of ten read, up or down; a float needs ±324.
const GREATEST_EXPONENT: u32 = 1_000;

const NUMBER: &str = "a number such as 6/5, 1.2 or 1e-3";

/// A rational: `6/5`, `-3`, or a decimal, `1.2`, `.5`, `1e-3`, which is read exactly.
///
/// A text of more than 5,000 bytes, a decimal of more than 1,000, and an exponent beyond ±1,000 are refused.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::rational("12/10")?.to_string(), "6/5");
/// assert_eq!(parse::rational("0.1")?.to_string(), "1/10");
/// assert_eq!(parse::rational("25e-1")?.to_string(), "5/2");
/// assert_eq!(
///     parse::rational("1/0").unwrap_err().to_string(),
///     "'1/0' is not a number with a denominator other than zero",
/// );
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn rational(text: &str) -> Result<BigRational, Error> {
    let syntax = || Error::syntax(text, NUMBER);
    if text.len() > LONGEST {
        return Err(Error::syntax(text, "a number of at most 5000 digits"));
    }
    let Some((numer, denom)) = text.split_once('/') else {
        let integer = integer_digits(text).map(BigRational::from_integer);
        return integer.map_or_else(|| decimal(text), Ok);
    };
    let numer = integer_digits(numer).ok_or_else(syntax)?;
    let denom = digits(denom).ok_or_else(syntax)?;
    if denom.is_zero() {
        return Err(Error::syntax(
            text,
            "a number with a denominator other than zero",
        ));
    }
    Ok(BigRational::new(numer, denom))
}

/// A decimal as the rational it is.
fn decimal(text: &str) -> Result<BigRational, Error> {
    if text.len() > LONGEST_DECIMAL {
        return Err(Error::syntax(text, "a decimal of at most 1000 characters"));
    }
    let syntax = || Error::syntax(text, NUMBER);
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (negative, mantissa) = sign(mantissa);
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if whole.is_empty() && fraction.is_empty() {
        return Err(syntax());
    }
    let part = |text: &str| match text {
        "" => Ok(BigInt::zero()),
        text => digits(text).ok_or_else(syntax),
    };
    let (whole, places) = (part(whole)?, fraction.len());
    let fraction = part(fraction)?;
    let exponent = integer_digits(exponent).ok_or_else(syntax)?;
    let power = u32::try_from(exponent.magnitude()).ok();
    let power = power.filter(|power| *power <= GREATEST_EXPONENT);
    let power = power
        .ok_or_else(|| Error::syntax(text, "a decimal with an exponent from -1000 to 1000"))?;
    let ten = BigInt::from(10);
    let unit = Pow::pow(&ten, places);
    let unsigned = whole * &unit + fraction;
    let numer = if negative { -unsigned } else { unsigned };
    let mantissa = BigRational::new(numer, unit);
    let scale = BigRational::from_integer(Pow::pow(&ten, power));
    Ok(if exponent.is_negative() {
        mantissa / scale
    } else {
        mantissa * scale
    })
}

/// An integer of any size that fits `i128`.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::integer("-12")?, -12);
/// assert!(parse::integer("1.5").is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn integer(text: &str) -> Result<i128, Error> {
    let expected = "an integer of at most 38 digits";
    text.parse().map_err(|_| Error::syntax(text, expected))
}

/// An integer of up to 5,000 digits.
#[cfg(feature = "serde")]
pub(crate) fn big_integer(text: &str) -> Result<BigInt, Error> {
    let integer = Some(text).filter(|text| text.len() <= LONGEST);
    let expected = "an integer of at most 5000 digits";
    integer
        .and_then(integer_digits)
        .ok_or_else(|| Error::syntax(text, expected))
}

/// A leading sign, and the rest.
fn sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    }
}

/// An integer with an optional sign.
pub(super) fn integer_digits(text: &str) -> Option<BigInt> {
    let (negative, rest) = sign(text);
    let unsigned = digits(rest)?;
    Some(if negative { -unsigned } else { unsigned })
}

/// Decimal digits and nothing else.
fn digits(text: &str) -> Option<BigInt> {
    let plain = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    plain.then(|| BigInt::parse_bytes(text.as_bytes(), 10))?
}
