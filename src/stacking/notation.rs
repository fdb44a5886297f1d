//! The notations: printed as they are written, and read back.

use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

use super::{Run, Stacking};
use crate::Error;
use crate::lattice::Sign;

/// The longest text read, in bytes.
const LONGEST: usize = 4_000_000;

/// A sign for each step: `++-+`.
#[derive(Clone, Copy, Debug)]
pub struct Hagg<'a>(&'a Stacking);

/// A letter for each layer: `ABCBC`.
#[derive(Clone, Copy, Debug)]
pub struct Abc<'a>(&'a Stacking);

/// A letter for each inner layer: `chh`.
#[derive(Clone, Copy, Debug)]
pub struct Jagodzinski<'a>(&'a Stacking);

/// The lengths of the runs: `(2,1,1)`.
#[derive(Clone, Copy, Debug)]
pub struct Zhdanov<'a>(&'a Stacking);

impl Stacking {
    /// A sign for each step, for display.
    ///
    /// As long as the stacking; [`Display`](fmt::Display) of the stacking itself stays short.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert_eq!("++-+".parse::<Stacking>()?.hagg().to_string(), "++-+");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn hagg(&self) -> Hagg<'_> {
        Hagg(self)
    }

    /// A letter for each layer, for display; the top one is A.
    ///
    /// As long as the stacking.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert_eq!("++-+".parse::<Stacking>()?.abc().to_string(), "ABCBC");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn abc(&self) -> Abc<'_> {
        Abc(self)
    }

    /// A letter for each inner layer, for display. Does not tell the first sign.
    ///
    /// As long as the stacking.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert_eq!("++-+".parse::<Stacking>()?.jagodzinski().to_string(), "chh");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn jagodzinski(&self) -> Jagodzinski<'_> {
        Jagodzinski(self)
    }

    /// The lengths of the runs, for display. Does not tell the first sign.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::stacking::Stacking;
    ///
    /// assert_eq!("++-+".parse::<Stacking>()?.zhdanov().to_string(), "(2,1,1)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn zhdanov(&self) -> Zhdanov<'_> {
        Zhdanov(self)
    }
}

impl fmt::Display for Hagg<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use fmt::Write;
        self.0
            .signs()
            .try_for_each(|sign| f.write_char(sign.symbol()))
    }
}

impl fmt::Display for Abc<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut letter = 0;
        f.write_str(LETTERS[letter])?;
        for sign in self.0.signs() {
            letter = match sign {
                Sign::Plus => (letter + 1) % 3,
                Sign::Minus => (letter + 2) % 3,
            };
            f.write_str(LETTERS[letter])?;
        }
        Ok(())
    }
}

const LETTERS: [&str; 3] = ["A", "B", "C"];

impl fmt::Display for Jagodzinski<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, run) in self.0.runs().enumerate() {
            if n > 0 {
                f.write_str("h")?;
            }
            (1..run.steps).try_for_each(|_| f.write_str("c"))?;
        }
        Ok(())
    }
}

impl fmt::Display for Zhdanov<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("(")?;
        for (n, run) in self.0.runs().enumerate() {
            let comma = if n > 0 { "," } else { "" };
            write!(f, "{comma}{}", run.steps)?;
        }
        f.write_str(")")
    }
}

/// The longest stacking shown sign by sign.
const LONGEST_HAGG: i128 = 64;

impl fmt::Display for Stacking {
    /// What reads back the same: the signs of up to 65 layers, Zhdanov's lengths beyond, with `-` before them if the
    /// first sign is −. One layer is `A`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.layers() {
            1 => f.write_str("A"),
            layers if layers <= LONGEST_HAGG + 1 => self.hagg().fmt(f),
            _ if self.first == Sign::Minus => write!(f, "-{}", self.zhdanov()),
            _ => self.zhdanov().fmt(f),
        }
    }
}

impl FromStr for Stacking {
    type Err = Error;

    /// Reads any of the four notations; which one, its characters say.
    ///
    /// An empty text is not a stacking; one layer is `A` or `()`. A `-` before Zhdanov's lengths makes the first sign −.
    fn from_str(text: &str) -> Result<Self, Error> {
        let expected = "a stacking such as ++-+, ABCBC, chh or (2,1,1)";
        let syntax = || Error::syntax(text, expected);
        if text.len() > LONGEST {
            return Err(Error::syntax(
                text,
                "a stacking of at most 4000000 characters",
            ));
        }
        let parsed = match text.as_bytes().first() {
            Some(b'-') if text.starts_with("-(") => {
                let from_plus: Self = text.get(1..).ok_or_else(syntax)?.parse()?;
                return Ok(from_plus.mirrored());
            }
            Some(b'+' | b'-') => signs_of_hagg(text).map(Self::from_signs),
            Some(b'A' | b'B' | b'C') => signs_of_abc(text).map(Self::from_signs),
            Some(b'h' | b'c') => signs_of_jagodzinski(text).map(Self::from_signs),
            Some(b'(') => {
                // Digits, but more than any number of layers has.
                let digits = |length: &str| length.bytes().all(|b| b.is_ascii_digit());
                let tall = |length: &str| {
                    length.len() > 38 && digits(length) && length.parse::<i128>().is_err()
                };
                if text.trim_matches(['(', ')']).split(',').any(tall) {
                    return Err(Error::syntax(text, "a stacking of at most 10^36 layers"));
                }
                return runs_of_zhdanov(text)
                    .ok_or_else(syntax)
                    .and_then(Self::from_runs);
            }
            _ => None,
        };
        parsed.ok_or_else(syntax)?
    }
}

fn signs_of_hagg(text: &str) -> Option<Vec<Sign>> {
    let sign = |byte| match byte {
        b'+' => Some(Sign::Plus),
        b'-' => Some(Sign::Minus),
        _ => None,
    };
    text.bytes().map(sign).collect()
}

fn signs_of_abc(text: &str) -> Option<Vec<Sign>> {
    let bytes = text.as_bytes();
    let known = bytes.iter().all(|byte| (b'A'..=b'C').contains(byte));
    // Two equal letters in sequence would be spheres on top of each other.
    let sign = |pair: &[u8]| match (pair[1] + 3 - pair[0]) % 3 {
        1 => Some(Sign::Plus),
        2 => Some(Sign::Minus),
        _ => None,
    };
    if known {
        bytes.windows(2).map(sign).collect()
    } else {
        None
    }
}

fn signs_of_jagodzinski(text: &str) -> Option<Vec<Sign>> {
    let mut sign = Sign::Plus;
    let mut signs = Vec::from([sign]);
    for byte in text.bytes() {
        sign = match byte {
            b'h' => -sign,
            b'c' => sign,
            _ => return None,
        };
        signs.push(sign);
    }
    Some(signs)
}

fn runs_of_zhdanov(text: &str) -> Option<Vec<Run>> {
    let inside = text.strip_prefix('(')?.strip_suffix(')')?;
    if inside.is_empty() {
        return Some(Vec::new());
    }
    let mut sign = Sign::Minus;
    let run = |length: &str| {
        sign = -sign;
        let digits = !length.is_empty() && length.bytes().all(|byte| byte.is_ascii_digit());
        let steps = if digits {
            length.parse().ok()?
        } else {
            return None;
        };
        (steps > 0).then_some(Run { sign, steps })
    };
    inside.split(',').map(run).collect()
}
