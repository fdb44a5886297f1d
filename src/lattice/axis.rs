//! Contacts within a layer.

use core::fmt;
use core::str::FromStr;

use super::{Direction, Sign, Site};
use crate::Error;

/// The line through two spheres of a layer that are next to each other, named by two directions: the supports of the one in
/// both are those that the line leads to.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Axis, Direction};
///
/// assert_eq!(Axis::GammaBeta.ends(), [Direction::Gamma, Direction::Beta]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Axis {
    /// From (i, j) to (i+1, j).
    AlphaBeta,
    /// From (i, j) to (i, j+1).
    AlphaGamma,
    /// From (i, j) to (i+1, j−1).
    GammaBeta,
}

impl Axis {
    /// αβ, αγ, γβ: the order of tables.
    pub const ALL: [Self; 3] = [Self::AlphaBeta, Self::AlphaGamma, Self::GammaBeta];

    /// Returns the two directions a and b: the neighbour of p is p + d_b − d_a, where p + d_l is the support of p in
    /// direction l under a + step.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Axis, Direction};
    ///
    /// assert_eq!(Axis::AlphaBeta.ends(), [Direction::Alpha, Direction::Beta]);
    /// ```
    #[must_use]
    pub const fn ends(self) -> [Direction; 2] {
        match self {
            Self::AlphaBeta => [Direction::Alpha, Direction::Beta],
            Self::AlphaGamma => [Direction::Alpha, Direction::Gamma],
            Self::GammaBeta => [Direction::Gamma, Direction::Beta],
        }
    }

    /// Returns `alpha-beta`, `alpha-gamma` or `gamma-beta`, the name in tables and certificates.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Axis;
    ///
    /// assert_eq!(Axis::GammaBeta.name(), "gamma-beta");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AlphaBeta => "alpha-beta",
            Self::AlphaGamma => "alpha-gamma",
            Self::GammaBeta => "gamma-beta",
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Axis {
    type Err = Error;

    /// Reads an axis by its [`name`](Self::name).
    ///
    /// # Errors
    /// [`Error::Syntax`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Axis;
    ///
    /// assert_eq!("alpha-gamma".parse::<Axis>()?, Axis::AlphaGamma);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|found| found.name() == text);
        found.ok_or_else(|| Error::syntax(text, "an axis: alpha-beta, alpha-gamma or gamma-beta"))
    }
}

#[cfg(feature = "serde")]
crate::scalar::serde::as_text!(Axis);

/// A contact between two spheres of a layer, at a = R: `site`, and its [neighbour](Self::neighbour) along an axis.
///
/// Ordered as in tables: by site, and of one sphere by axis.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Axis, HorizontalContact, Site};
///
/// let contact = HorizontalContact { site: Site { i: 0, j: 2, k: 5 }, axis: Axis::GammaBeta };
/// assert_eq!(contact.neighbour(), Some(Site { i: 1, j: 1, k: 5 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct HorizontalContact {
    /// One of the two spheres.
    pub site: Site,
    /// Where the other one is.
    pub axis: Axis,
}

impl HorizontalContact {
    /// Returns the other sphere; `None` past `i128`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Axis, HorizontalContact, Site};
    ///
    /// let contact = HorizontalContact { site: Site::APEX, axis: Axis::AlphaBeta };
    /// assert_eq!(contact.neighbour(), Some(Site { i: 1, j: 0, k: 0 }));
    /// ```
    #[must_use]
    pub fn neighbour(&self) -> Option<Site> {
        let [a, b] = self.axis.ends();
        let step = |site: Site, direction, steps| {
            let Site { i, j, .. } = site.step(Sign::Plus, direction, steps)?;
            Some(Site { i, j, ..self.site })
        };
        step(step(self.site, b, 1)?, a, -1)
    }
}

impl fmt::Display for HorizontalContact {
    /// Prints `(i,j,k) alpha-beta`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.site, self.axis)
    }
}
