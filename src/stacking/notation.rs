//! Printing and parsing of stackings in four notations.

use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

use exact_surd::layout::padded;

use super::{Run, Stacking};
use crate::Error;
use crate::lattice::Sign;

/// The greatest length of a parsed text, in bytes.
const LONGEST: usize = 4_000_000;

/// The greatest length of an invalid text, in characters, that the error message quotes in full. For a longer text the
/// message gives the position of the fault.
const QUOTED: usize = 60;

/// The notations of a stacking.
///
/// # Examples
/// ```
/// use cannonpile::stacking::{Notation, Stacking};
///
/// let stacking: Stacking = "++-+".parse()?;
/// let written = |notation| stacking.in_notation(notation).to_string();
/// assert_eq!(written(Notation::Hagg), "++-+");
/// assert_eq!(written(Notation::Abc), "ABCBC");
/// assert_eq!(written(Notation::Jagodzinski), "chh");
/// assert_eq!(written(Notation::Zhdanov), "(2,1,1)");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Notation {
    /// One sign per step: `++-+`.
    Hagg,
    /// One letter per layer: `ABCBC`. The top layer is A.
    Abc,
    /// One letter per inner layer: `chh`. The first sign remains undetermined.
    Jagodzinski,
    /// The lengths of the runs: `(2,1,1)`. The first sign remains undetermined.
    Zhdanov,
}

impl Stacking {
    /// Returns the stacking in a notation, as a value to print.
    ///
    /// The length of the text grows with the number of layers, except for [`Notation::Zhdanov`].
    /// [`Display`](fmt::Display) of the stacking itself is always short.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::{Notation, Stacking};
    ///
    /// let stacking: Stacking = "++-+".parse()?;
    /// assert_eq!(stacking.in_notation(Notation::Abc).to_string(), "ABCBC");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn in_notation(&self, notation: Notation) -> impl fmt::Display + '_ {
        Written(self, notation)
    }
}

/// A stacking in a notation, with padding.
struct Written<'a>(&'a Stacking, Notation);

impl fmt::Display for Written<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        padded(f, format_args!("{}", Plain(self.0, self.1, "")))
    }
}

/// A stacking in a notation after a prefix, without padding.
struct Plain<'a>(&'a Stacking, Notation, &'static str);

impl fmt::Display for Plain<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(stacking, notation, prefix) = self;
        f.write_str(prefix)?;
        match notation {
            Notation::Hagg => stacking.signs().try_for_each(|sign| sign.fmt(f)),
            Notation::Abc => write_abc(stacking, f),
            Notation::Jagodzinski => write_jagodzinski(stacking, f),
            Notation::Zhdanov => write_zhdanov(stacking, f),
        }
    }
}

fn write_abc(stacking: &Stacking, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let mut letter = 0;
    f.write_str(LETTERS[letter])?;
    for sign in stacking.signs() {
        letter = match sign {
            Sign::Plus => (letter + 1) % 3,
            Sign::Minus => (letter + 2) % 3,
        };
        f.write_str(LETTERS[letter])?;
    }
    Ok(())
}

const LETTERS: [&str; 3] = ["A", "B", "C"];

fn write_jagodzinski(stacking: &Stacking, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    for (n, run) in stacking.runs().enumerate() {
        if n > 0 {
            f.write_str("h")?;
        }
        (1..run.steps).try_for_each(|_| f.write_str("c"))?;
    }
    Ok(())
}

fn write_zhdanov(stacking: &Stacking, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    f.write_str("(")?;
    for (n, run) in stacking.runs().enumerate() {
        let comma = if n > 0 { "," } else { "" };
        write!(f, "{comma}{}", run.steps)?;
    }
    f.write_str(")")
}

/// The greatest number of steps that are printed sign by sign.
const LONGEST_HAGG: i128 = 64;

impl fmt::Display for Stacking {
    /// Prints the signs of up to 65 layers. More layers are printed in Zhdanov's notation, with a prefix `-` if the
    /// first sign is −. A single layer is `A`. Parsing the text gives the same stacking.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (notation, prefix) = match self.layers() {
            1 => (Notation::Abc, ""),
            layers if layers <= LONGEST_HAGG + 1 => (Notation::Hagg, ""),
            _ if self.first == Sign::Minus => (Notation::Zhdanov, "-"),
            _ => (Notation::Zhdanov, ""),
        };
        padded(f, format_args!("{}", Plain(self, notation, prefix)))
    }
}

impl FromStr for Stacking {
    type Err = Error;

    /// Parses any of the four notations. The characters of the text determine the notation.
    ///
    /// A single layer is `A` or `()`. An empty text is an error. A `-` before Zhdanov's notation means that the first
    /// sign is −.
    ///
    /// # Errors
    /// [`Error::Syntax`], or [`Error::Misspelled`] for a long text; the errors of [`from_runs`](Self::from_runs).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// let stacking: Stacking = "ABCBC".parse()?;
    /// assert_eq!("++-+".parse(), Ok(stacking));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        if text.len() > LONGEST {
            return Err(Error::syntax(
                text,
                "a stacking of at most 4000000 characters",
            ));
        }
        if text.split(['(', ',', ')']).any(is_beyond_i128) {
            return Err(Error::syntax(text, "a stacking of at most 10^36 layers"));
        }
        let signs = |read: Result<Vec<Sign>, usize>| read.map(Self::from_signs);
        let read = match (text.strip_prefix('-'), text.as_bytes().first()) {
            (Some(lengths), _) if lengths.starts_with('(') => runs_of_zhdanov(lengths)
                .map(|runs| Self::from_runs(runs).map(|from_plus| from_plus.mirrored()))
                .map_err(|fault| fault + 1),
            (_, Some(b'+' | b'-')) => signs(signs_of_hagg(text)),
            (_, Some(b'A' | b'B' | b'C')) => signs(signs_of_abc(text)),
            (_, Some(b'h' | b'c')) => signs(signs_of_jagodzinski(text)),
            (_, Some(b'(')) => runs_of_zhdanov(text).map(Self::from_runs),
            _ => Err(0),
        };
        read.unwrap_or_else(|fault| Err(misspelled(text, fault)))
    }
}

/// Returns the error for a text that is invalid at byte `fault`.
fn misspelled(text: &str, fault: usize) -> Error {
    if text.chars().nth(QUOTED).is_none() {
        return Error::syntax(text, "a stacking such as ++-+, ABCBC, chh or (2,1,1)");
    }
    // All characters before the fault belong to the notation, and each is one byte long.
    Error::Misspelled {
        text: exact_surd::short::quoted(text),
        position: fault + 1,
        found: text.get(fault..).and_then(|rest| rest.chars().next()),
    }
}

/// Returns whether the text is a number that exceeds `i128`.
fn is_beyond_i128(length: &str) -> bool {
    length.len() > 38
        && length.bytes().all(|byte| byte.is_ascii_digit())
        && length.parse::<i128>().is_err()
}

// The following parsers return the position of the first invalid byte as the error.

fn signs_of_hagg(text: &str) -> Result<Vec<Sign>, usize> {
    let sign = |(n, byte)| match byte {
        b'+' => Ok(Sign::Plus),
        b'-' => Ok(Sign::Minus),
        _ => Err(n),
    };
    text.bytes().enumerate().map(sign).collect()
}

fn signs_of_abc(text: &str) -> Result<Vec<Sign>, usize> {
    let pairs = text.bytes().zip(text.bytes().skip(1)).enumerate();
    let sign = |(n, pair): (usize, (u8, u8))| match pair {
        (b'A', b'B') | (b'B', b'C') | (b'C', b'A') => Ok(Sign::Plus),
        (b'B', b'A') | (b'C', b'B') | (b'A', b'C') => Ok(Sign::Minus),
        // Two equal letters in sequence would put spheres vertically above each other.
        _ => Err(n + 1),
    };
    pairs.map(sign).collect()
}

fn signs_of_jagodzinski(text: &str) -> Result<Vec<Sign>, usize> {
    let mut sign = Sign::Plus;
    let mut signs = Vec::from([sign]);
    for (n, byte) in text.bytes().enumerate() {
        sign = match byte {
            b'h' => -sign,
            b'c' => sign,
            _ => return Err(n),
        };
        signs.push(sign);
    }
    Ok(signs)
}

fn runs_of_zhdanov(text: &str) -> Result<Vec<Run>, usize> {
    let inside = text.strip_prefix('(').ok_or(0_usize)?;
    let inside = inside.strip_suffix(')').ok_or(text.len())?;
    if inside.is_empty() {
        return Ok(Vec::new());
    }
    let (mut sign, mut position) = (Sign::Minus, 1);
    let run = |length: &str| {
        sign = -sign;
        let start = position;
        position += length.len() + 1;
        if let Some(fault) = length.bytes().position(|byte| !byte.is_ascii_digit()) {
            return Err(start + fault);
        }
        match length.parse() {
            Ok(0) | Err(_) => Err(start),
            Ok(steps) => Ok(Run { sign, steps }),
        }
    };
    inside.split(',').map(run).collect()
}

#[cfg(test)]
mod tests {
    use alloc::format;
    use alloc::string::ToString;

    use super::*;
    use crate::stacking::Pattern;

    #[test]
    fn stackings_are_padded_in_every_notation() {
        let stacking: Stacking = "++-+".parse().unwrap();
        assert_eq!(format!("{stacking:>6}|{stacking:<6}|"), "  ++-+|++-+  |");
        let abc = stacking.in_notation(Notation::Abc);
        assert_eq!(format!("{abc:*^9}"), "**ABCBC**");
        let long = Stacking::fcc(100).unwrap().mirrored();
        assert_eq!(format!("{long:>6}"), " -(99)");
        assert_eq!(long.to_string().parse(), Ok(long));
        for (pattern, padded) in [
            (Pattern::Hcp, "hcp  "),
            (Pattern::Spelled("+-".parse().unwrap()), "+-   "),
        ] {
            assert_eq!(format!("{pattern:5}"), padded);
        }
    }
}
