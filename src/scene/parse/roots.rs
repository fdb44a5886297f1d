//! Numbers c·√r from text.

use super::rational;
use crate::Error;
use crate::scalar::Surd;

/// A number c·√r as it is printed: `7/3`, `sqrt(2)`, `-7/3*sqrt(2)`. The radicand may be any rational that is not
/// negative.
///
/// # Errors
/// [`Error::Syntax`], and [`Error::NegativeRadicand`].
///
/// # Examples
/// ```
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::surd("7/3*sqrt(8/17)")?.to_string(), "14/51*sqrt(34)");
/// assert_eq!(parse::surd("-sqrt(2)")?.square().to_string(), "2");
/// assert_eq!(parse::surd("1.2")?.to_string(), "6/5");
/// assert!(parse::surd("sqrt(-1)").is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn surd(text: &str) -> Result<Surd, Error> {
    let Some((coefficient, root)) = text.split_once("sqrt(") else {
        return rational(text).map(Surd::from);
    };
    let syntax = || Error::syntax(text, "a number such as 7/3 or 7/3*sqrt(2)");
    let radicand = root.strip_suffix(')').ok_or_else(syntax)?;
    let coefficient = match coefficient {
        "" => "1",
        "-" => "-1",
        factor => factor.strip_suffix('*').ok_or_else(syntax)?,
    };
    Surd::new(rational(coefficient)?, rational(radicand)?)
}
