//! The Hägg sign of a step between layers.

use core::ops::Neg;

use super::Direction;

/// The Hägg sign of a step from a layer to the one below.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Sign;
///
/// assert_eq!(-Sign::Plus, Sign::Minus);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Sign {
    /// (i, j) rests on (i, j), (i+1, j), (i, j+1).
    Plus,
    /// (i, j) rests on (i, j), (i−1, j), (i, j−1).
    Minus,
}

impl Sign {
    /// The step (Δi, Δj) to the support in a direction.
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

    /// `+` or `-`.
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

impl Neg for Sign {
    type Output = Self;

    fn neg(self) -> Self {
        match self {
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
        }
    }
}
