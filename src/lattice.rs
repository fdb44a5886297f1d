//! The triangular lattice: sites, directions, neighbours and counts, in integers.
//!
//! A pile of L layers has the layers k = 0 (the top) … L−1 (on the floor). Layer k of a triangular pile contains the
//! sites (i, j, k) with 0 ≤ j ≤ k and 0 ≤ i ≤ k−j. A pile of discs contains those with j = 0. A sphere is supported by
//! three others, one in each [`Direction`]:
//!
//! | direction | below (i, j, k) | above (i, j, k) | spheres above on its line |
//! |---|---|---|---|
//! | α | A = (i, j, k+1) | A′ = (i, j, k−1) | k−i−j |
//! | β | B = (i+1, j, k+1) | B′ = (i−1, j, k−1) | i |
//! | γ | C = (i, j+1, k+1) | C′ = (i, j−1, k−1) | j |
//!
//! The three counts are the barycentric coordinates of the site in its layer, and they sum to k. All symmetries of the
//! pile permute them.
//!
//! Iterators over a pile visit it by [`Row`]s: fixed k and j, consecutive i.

mod axis;
pub mod count;
mod direction;
mod region;
mod row;
mod sign;

pub use axis::{Axis, ContactKind, HorizontalContact};
pub use direction::Direction;
pub use region::Region;
pub(crate) use region::{Along, Nearby, Slopes, Trapezoid, small};
pub use row::{Row, Sites};
pub use sign::Sign;

use alloc::string::ToString;
use core::fmt;
use core::str::FromStr;

use exact_surd::layout::padded;

use crate::Error;
use crate::each::Each;
use crate::scalar::parse::integer;

/// The greatest number of layers, 10³⁶. Coordinates of sites, and sums of a few of them, then fit in `i128`.
pub const MAX_LAYERS: i128 = 10_i128.pow(36);

/// The dimension of a pile: discs in a plane, or spheres in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(into = "u32", try_from = "u32")
)]
pub enum Dimension {
    /// A pile of discs. Each disc has two supports, α and β.
    Two,
    /// A pile of spheres. Each sphere has three supports.
    Three,
}

impl Dimension {
    /// Returns 2 or 3, which is also the number of supports of each sphere.
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

    /// Parses a dimension: `2` or `3`.
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

/// The position (i, j, k) of a sphere, with the layer k counted from the top.
///
/// Any three integers are a valid site. [`Shape::contains`](crate::shape::Shape::contains) returns whether a pile
/// contains it. Sites are ordered as in tables: by layer, row, and position in the row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct Site {
    /// The position in the row.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub i: i128,
    /// The row in the layer.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub j: i128,
    /// The layer, 0 at the top.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub k: i128,
}

impl Site {
    /// The top sphere of a pile, (0, 0, 0).
    pub const APEX: Self = Self { i: 0, j: 0, k: 0 };

    /// Returns the site (i, j, k).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Site;
    ///
    /// assert_eq!(Site::new(1, 2, 5), Site { i: 1, j: 2, k: 5 });
    /// assert_eq!(Site::from((1, 2, 5)), Site::new(1, 2, 5));
    /// ```
    #[must_use]
    pub const fn new(i: i128, j: i128, k: i128) -> Self {
        Self { i, j, k }
    }

    /// Returns the site that is `steps` layers further down in `direction`, under steps of one sign. A negative number
    /// leads upwards. Returns `None` if a coordinate does not fit in `i128`.
    pub(crate) fn step(self, sign: Sign, direction: Direction, steps: i128) -> Option<Self> {
        let [di, dj] = sign.descent(direction).each(|d| d * steps);
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

impl From<(i128, i128, i128)> for Site {
    fn from((i, j, k): (i128, i128, i128)) -> Self {
        Self { i, j, k }
    }
}

impl fmt::Display for Site {
    /// Prints `(i,j,k)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        padded(f, format_args!("({},{},{})", self.i, self.j, self.k))
    }
}

impl FromStr for Site {
    type Err = Error;

    /// Parses a site as it is printed, `(0,1,2)`. Blanks before a number are allowed.
    ///
    /// # Errors
    /// [`Error::Syntax`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Site;
    ///
    /// assert_eq!("(0,1,2)".parse::<Site>()?, Site::new(0, 1, 2));
    /// assert_eq!("(0, -1, 2)".parse::<Site>()?, Site::new(0, -1, 2));
    /// assert!("0,1,2".parse::<Site>().is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        let syntax = || Error::syntax(text, "a site such as (0,1,2)");
        let inside = text.strip_prefix('(').and_then(|t| t.strip_suffix(')'));
        let mut numbers = inside.ok_or_else(syntax)?.split(',');
        let mut next = || {
            let number = numbers.next().ok_or_else(syntax)?;
            integer(number.trim_start_matches(' ')).map_err(|_| syntax())
        };
        let site = Self::new(next()?, next()?, next()?);
        match numbers.next() {
            None => Ok(site),
            Some(_) => Err(syntax()),
        }
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

    #[test]
    fn sites_are_read_as_they_are_printed() {
        for site in [
            Site::APEX,
            Site::new(1, -2, 3),
            Site::new(i128::MIN, 0, i128::MAX),
        ] {
            assert_eq!(site.to_string().parse(), Ok(site));
        }
        assert_eq!("(1, -2,  3)".parse(), Ok(Site::new(1, -2, 3)));
        for refused in [
            "",
            "()",
            "(0,1)",
            "(0,1,2,3)",
            "0,1,2",
            "(0,1,2",
            "(0,1,2))",
            "(0,1,)",
            "(0;1;2)",
            "(0,1,2) ",
            "(0 ,1,2)",
            "(0,1/2,2)",
        ] {
            let read = refused.parse::<Site>();
            assert!(matches!(read, Err(Error::Syntax { .. })), "{refused}");
        }
        // The layer does not fit in `i128`.
        assert!("(0,0,1e39)".parse::<Site>().is_err());
    }

    #[test]
    fn sites_and_regions_are_padded() {
        let site = Site::new(0, 1, 2);
        assert_eq!(
            alloc::format!("{site:>10}|{site:<10}|"),
            "   (0,1,2)|(0,1,2)   |"
        );
        let region = Region::SITE;
        assert_eq!(alloc::format!("{region:*^16}"), "*0..0,0..0,0..0*");
        assert_eq!(alloc::format!("{region:>#12}"), "   hexagon:1");
        let outside = Region::new(2..=3, 0..=1, 2..=4).unwrap();
        assert_eq!(
            alloc::format!("{outside:#25}|"),
            "region:2..3,0..1,2..4    |"
        );
    }
}
