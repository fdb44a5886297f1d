//! The Hägg sign of a step between two layers.

use core::fmt;
use core::ops::Neg;
use core::str::FromStr;

use super::Direction;
use crate::Error;

/// The Hägg sign of a step from a layer to the one below. It determines the positions of the supports of a sphere.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Sign;
///
/// assert_eq!(-Sign::Plus, Sign::Minus);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Sign {
    /// The sphere (i, j) is supported by (i, j), (i+1, j), (i, j+1).
    Plus,
    /// The sphere (i, j) is supported by (i, j), (i−1, j), (i, j−1).
    Minus,
}

impl Sign {
    /// Returns the step (Δi, Δj) from a sphere to its support in a direction.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Sign};
    ///
    /// assert_eq!(Sign::Minus.descent(Direction::Gamma), [0, -1]);
    /// ```
    #[must_use]
    pub const fn descent(self, direction: Direction) -> [i128; 2] {
        let [i, j, _] = direction.descent();
        match self {
            Self::Plus => [i, j],
            Self::Minus => [-i, -j],
        }
    }

    /// Returns σ, +1 or −1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Sign;
    ///
    /// assert_eq!([Sign::Plus, Sign::Minus].map(Sign::factor), [1, -1]);
    /// ```
    #[must_use]
    pub const fn factor(self) -> i32 {
        match self {
            Self::Plus => 1,
            Self::Minus => -1,
        }
    }

    /// Returns the other sign.
    #[must_use]
    pub const fn opposite(self) -> Self {
        match self {
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
        }
    }

    /// Returns `+` or `-`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Sign;
    ///
    /// assert_eq!(Sign::Minus.symbol(), '-');
    /// ```
    #[must_use]
    pub const fn symbol(self) -> char {
        match self {
            Self::Plus => '+',
            Self::Minus => '-',
        }
    }
}

impl fmt::Display for Sign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.symbol().fmt(f)
    }
}

impl FromStr for Sign {
    type Err = Error;

    /// Parses a sign: `+` or `-`.
    ///
    /// # Errors
    /// [`Error::Syntax`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Sign;
    ///
    /// assert_eq!("-".parse::<Sign>()?, Sign::Minus);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        match text {
            "+" => Ok(Self::Plus),
            "-" => Ok(Self::Minus),
            _ => Err(Error::syntax(text, "a sign: + or -")),
        }
    }
}

#[cfg(feature = "serde")]
crate::data::as_text!(Sign);

impl Neg for Sign {
    type Output = Self;

    fn neg(self) -> Self {
        match self {
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
        }
    }
}
