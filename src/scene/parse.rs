//! Numbers, sites and shapes from text, exactly.

mod roots;
mod shapes;

pub use roots::surd;
pub use shapes::{load, region, stacking};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Pow, Zero};

use crate::Error;
use crate::lattice::{Dimension, Direction, MAX_LAYERS, Site};

/// The longest number read, in bytes; any decimal that is read is printed as a shorter fraction.
const LONGEST: usize = 5_000;

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
        return integer.or_else(|| decimal(text)).ok_or_else(syntax);
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
fn decimal(text: &str) -> Option<BigRational> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    if exponent.unsigned_abs() > GREATEST_EXPONENT || text.len() > LONGEST_DECIMAL {
        return None;
    }
    let (negative, mantissa) = sign(mantissa);
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    let part = |text: &str| {
        if text.is_empty() {
            Some(BigInt::zero())
        } else {
            digits(text)
        }
    };
    let places = u32::try_from(fraction.len()).ok()?;
    let ten = BigInt::from(10);
    let unsigned = part(whole)? * ten.clone().pow(places) + part(fraction)?;
    let numer = if negative { -unsigned } else { unsigned };
    let mantissa = BigRational::new(numer, ten.clone().pow(places));
    let scale = BigRational::from_integer(Pow::pow(ten, exponent.unsigned_abs()));
    Some(if exponent < 0 {
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

/// A number of layers.
///
/// # Errors
/// [`Error::Layers`] for an integer that cannot be one, [`Error::Syntax`] for anything else.
///
/// # Examples
/// ```
/// use cannonpile::Error;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::layers("10")?, 10);
/// assert!(matches!(parse::layers("0"), Err(Error::Layers { .. })));
/// assert!(matches!(parse::layers("ten"), Err(Error::Syntax { .. })));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn layers(text: &str) -> Result<i128, Error> {
    if text.len() > LONGEST {
        return Err(Error::syntax(
            text,
            "a number of layers of at most 37 digits",
        ));
    }
    let given = integer_digits(text);
    let given = given.ok_or_else(|| Error::syntax(text, "a number of layers such as 10"))?;
    match i128::try_from(&given) {
        Ok(layers) if (1..=MAX_LAYERS).contains(&layers) => Ok(layers),
        _ => Err(Error::Layers { given }),
    }
}

/// A dimension: `2` or `3`.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::dimension("2")?, Dimension::Two);
/// assert!(parse::dimension("4").is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn dimension(text: &str) -> Result<Dimension, Error> {
    match text {
        "2" => Ok(Dimension::Two),
        "3" => Ok(Dimension::Three),
        _ => Err(Error::syntax(text, "a dimension: 2 (discs) or 3 (spheres)")),
    }
}

/// One sphere as text: `K,I,J`, or `I,J` on the base; in two dimensions `K,I`, or `I`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct At {
    /// The layer; the base if there is none.
    pub layer: Option<i128>,
    /// The place within the row.
    pub i: i128,
    /// The row.
    pub j: i128,
}

impl At {
    /// The site, for a pile of this many layers. Whether the pile has it is not checked here.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::scene::parse;
    ///
    /// let site = parse::at("5,7", Dimension::Three)?.site(10);
    /// assert_eq!(site, Site { i: 5, j: 7, k: 9 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn site(&self, layers: i128) -> Site {
        let k = self.layer.unwrap_or(layers.saturating_sub(1));
        Site {
            i: self.i,
            j: self.j,
            k,
        }
    }
}

/// One sphere: `K,I,J` or `I,J`; in two dimensions `K,I` or `I`.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::at("9,5,2", Dimension::Three)?.layer, Some(9));
/// assert_eq!(parse::at("5", Dimension::Two)?.i, 5);
/// assert!(parse::at("5", Dimension::Three).is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn at(text: &str, dimension: Dimension) -> Result<At, Error> {
    let expected = match dimension {
        Dimension::Two => "a disc: K,I, or I on the base",
        Dimension::Three => "a sphere: K,I,J, or I,J on the base",
    };
    let mut numbers = [0; 3];
    let mut given = 0;
    for part in text.split(',') {
        let slot = numbers
            .get_mut(given)
            .ok_or_else(|| Error::syntax(text, expected))?;
        *slot = part
            .trim()
            .parse()
            .map_err(|_| Error::syntax(text, expected))?;
        given += 1;
    }
    let [a, b, c] = numbers;
    match (dimension, given) {
        (Dimension::Three, 3) => Ok(At {
            layer: Some(a),
            i: b,
            j: c,
        }),
        (Dimension::Three, 2) => Ok(At {
            layer: None,
            i: a,
            j: b,
        }),
        (Dimension::Two, 2) => Ok(At {
            layer: Some(a),
            i: b,
            j: 0,
        }),
        (Dimension::Two, 1) => Ok(At {
            layer: None,
            i: a,
            j: 0,
        }),
        _ => Err(Error::syntax(text, expected)),
    }
}

/// A direction by its name.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Direction;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::direction("gamma")?, Direction::Gamma);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn direction(text: &str) -> Result<Direction, Error> {
    let found = Direction::ALL
        .into_iter()
        .find(|direction| direction.name() == text);
    found.ok_or_else(|| Error::syntax(text, "a direction: alpha, beta or gamma"))
}

/// A leading sign, and the rest.
fn sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    }
}

/// An integer with an optional sign.
fn integer_digits(text: &str) -> Option<BigInt> {
    let (negative, rest) = sign(text);
    let unsigned = digits(rest)?;
    Some(if negative { -unsigned } else { unsigned })
}

/// Decimal digits and nothing else.
fn digits(text: &str) -> Option<BigInt> {
    let plain = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    plain.then(|| BigInt::parse_bytes(text.as_bytes(), 10))?
}
