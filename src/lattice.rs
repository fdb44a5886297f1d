//! Where the spheres sit: sites, directions, neighbours, counts. Integers only.
//!
//! A pile of L layers has the layers k = 0 (the top) … L−1 (on the floor). Layer k of a triangular
//! pile holds the sites (i, j, k) with 0 ≤ j ≤ k and 0 ≤ i ≤ k−j; a pile of discs holds those with
//! j = 0. A sphere stands on three others, one in each [`Direction`]:
//!
//! | direction | below (i, j, k) | above (i, j, k) | spheres above on its line |
//! |---|---|---|---|
//! | α | A = (i, j, k+1) | A′ = (i, j, k−1) | k−i−j |
//! | β | B = (i+1, j, k+1) | B′ = (i−1, j, k−1) | i |
//! | γ | C = (i, j+1, k+1) | C′ = (i, j−1, k−1) | j |
//!
//! The three counts are the barycentric coordinates of the site in its layer: they sum to k. All
//! symmetries of the pile permute them.
//!
//! The unit in which a pile is walked is the [`Row`]: fixed k and j, consecutive i.

mod axis;
pub mod count;
mod region;
mod row;
mod sign;

pub use axis::{Axis, HorizontalContact, Link};
pub use region::Region;
pub(crate) use region::{Along, Counts, Slopes, Trapezoid};
pub use row::{Row, Sites};
pub use sign::Sign;

use alloc::string::ToString;
use core::fmt;
use core::str::FromStr;

use crate::Error;

/// The greatest number of layers, 10³⁶: sites, and sums of a few of them, stay within `i128`.
pub const MAX_LAYERS: i128 = 10_i128.pow(36);

/// A direction of contacts, named as in the paper, (1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Direction {
    /// α, along ê_a.
    Alpha,
    /// β, along ê_b.
    Beta,
    /// γ, along ê_c; piles of discs have none.
    Gamma,
}

impl Direction {
    /// α, β, γ: the order of every array indexed by direction.
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

    /// Returns the step (Δi, Δj, Δk) from a sphere to the one below it in this direction.
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

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Direction {
    type Err = Error;

    /// Reads a direction by its [`name`](Self::name).
    ///
    /// # Errors
    /// [`Error::Syntax`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Direction;
    ///
    /// assert_eq!("gamma".parse::<Direction>()?, Direction::Gamma);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|found| found.name() == text);
        found.ok_or_else(|| Error::syntax(text, "a direction: alpha, beta or gamma"))
    }
}

#[cfg(feature = "serde")]
crate::data::as_text!(Direction);

/// The number of dimensions a pile lives in: discs in the plane, or spheres in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(into = "u32", try_from = "u32")
)]
pub enum Dimension {
    /// A pile of discs: each stands on two, α and β.
    Two,
    /// A pile of spheres: each stands on three.
    Three,
}

impl Dimension {
    /// Returns 2 or 3, which is also the number of contacts below each sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Dimension;
    ///
    /// assert_eq!((Dimension::Two.number(), Dimension::Three.number()), (2, 3));
    /// ```
    #[must_use]
    pub const fn number(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Three => 3,
        }
    }

    /// Returns the directions of contacts, in order.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Direction};
    ///
    /// assert_eq!(Dimension::Two.directions(), [Direction::Alpha, Direction::Beta]);
    /// ```
    #[must_use]
    pub const fn directions(self) -> &'static [Direction] {
        match self {
            Self::Two => &[Direction::Alpha, Direction::Beta],
            Self::Three => &Direction::ALL,
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.number().fmt(f)
    }
}

impl FromStr for Dimension {
    type Err = Error;

    /// Reads a dimension: `2` or `3`.
    ///
    /// # Errors
    /// [`Error::Syntax`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Dimension;
    ///
    /// assert_eq!("2".parse::<Dimension>()?, Dimension::Two);
    /// assert!("4".parse::<Dimension>().is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        match text {
            "2" => Ok(Self::Two),
            "3" => Ok(Self::Three),
            _ => Err(Error::syntax(text, "a dimension: 2 (discs) or 3 (spheres)")),
        }
    }
}

impl From<Dimension> for u32 {
    fn from(dimension: Dimension) -> Self {
        dimension.number()
    }
}

impl TryFrom<u32> for Dimension {
    type Error = Error;

    fn try_from(number: u32) -> Result<Self, Error> {
        number.to_string().parse()
    }
}

/// A place (i, j, k) for a sphere, k counted from the top.
///
/// Any three integers make a site. [`Shape::contains`](crate::shape::Shape::contains) says whether a pile has it. Sites
/// are ordered as tables print them: by layer, row, place in the row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Site {
    /// The place within the row.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub i: i128,
    /// The row within the layer.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub j: i128,
    /// The layer, 0 at the top.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub k: i128,
}

impl Site {
    /// The sphere on top of a pile, (0, 0, 0).
    pub const APEX: Self = Self { i: 0, j: 0, k: 0 };

    /// Returns the site `steps` further down in `direction` under steps of one sign, up for a negative number; `None`
    /// past `i128`.
    pub(crate) fn step(self, sign: Sign, direction: Direction, steps: i128) -> Option<Self> {
        let [di, dj] = sign.descent(direction).map(|d| d * steps);
        Some(Self {
            i: self.i.checked_add(di)?,
            j: self.j.checked_add(dj)?,
            k: self.k.checked_add(steps)?,
        })
    }
}

impl Ord for Site {
    fn cmp(&self, other: &Self) -> core::cmp::Ordering {
        (self.k, self.j, self.i).cmp(&(other.k, other.j, other.i))
    }
}

impl PartialOrd for Site {
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Display for Site {
    /// Prints `(i,j,k)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({},{},{})", self.i, self.j, self.k)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_add_up() {
        for sign in [Sign::Plus, Sign::Minus] {
            for direction in Direction::ALL {
                let [di, dj] = sign.descent(direction);
                for steps in [-3, -1, 0, 1, 2] {
                    let site = Site { i: 5, j: -7, k: 9 };
                    let reached = Site {
                        i: 5 + steps * di,
                        j: -7 + steps * dj,
                        k: 9 + steps,
                    };
                    assert_eq!(site.step(sign, direction, steps), Some(reached));
                }
            }
        }
        let last = Site {
            k: i128::MAX,
            ..Site::APEX
        };
        assert_eq!(last.step(Sign::Plus, Direction::Alpha, 1), None);
    }
}
