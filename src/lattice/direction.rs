//! The directions of contacts.

use crate::error::named;

/// A direction of contacts, named as in (1) of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Direction {
    /// α, along ê_a.
    Alpha,
    /// β, along ê_b.
    Beta,
    /// γ, along ê_c. Piles of discs do not have it.
    Gamma,
}

impl Direction {
    /// α, β, γ: the order of all arrays that are indexed by direction.
    pub const ALL: [Self; 3] = [Self::Alpha, Self::Beta, Self::Gamma];

    /// Returns 0, 1, 2 for α, β, γ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Direction;
    ///
    /// assert_eq!(Direction::ALL[Direction::Beta.index()], Direction::Beta);
    /// ```
    #[must_use]
    pub const fn index(self) -> usize {
        match self {
            Self::Alpha => 0,
            Self::Beta => 1,
            Self::Gamma => 2,
        }
    }

    /// Returns the step (Δi, Δj, Δk) from a sphere to its support in this direction, under a + step.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Direction;
    ///
    /// assert_eq!(Direction::Beta.descent(), [1, 0, 1]);
    /// ```
    #[must_use]
    pub const fn descent(self) -> [i128; 3] {
        match self {
            Self::Alpha => [0, 0, 1],
            Self::Beta => [1, 0, 1],
            Self::Gamma => [0, 1, 1],
        }
    }

    /// Returns `alpha`, `beta` or `gamma`, the name in tables and on the command line.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Direction;
    ///
    /// assert_eq!(Direction::ALL.map(Direction::name), ["alpha", "beta", "gamma"]);
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alpha => "alpha",
            Self::Beta => "beta",
            Self::Gamma => "gamma",
        }
    }
}

named!(
    Direction,
    Direction::ALL,
    "a direction: alpha, beta or gamma"
);
