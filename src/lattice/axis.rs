//! Contacts within a layer, and the types of contacts.

use core::fmt;

use exact_surd::layout::padded;

use super::{Direction, Sign, Site};
use crate::each::Each;
use crate::error::named;

/// The line through two neighbouring spheres of a layer. Its name consists of two directions a and b, and the neighbour
/// of p is p + d_b − d_a. Here p + d_l is the support of p in direction l under a + step.
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
    /// αβ, αγ, γβ: the order in tables.
    pub const ALL: [Self; 3] = [Self::AlphaBeta, Self::AlphaGamma, Self::GammaBeta];

    /// Returns the two directions a and b: the neighbour of p along this axis is p + d_b − d_a.
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

named!(
    Axis,
    Axis::ALL,
    "an axis: alpha-beta, alpha-gamma or gamma-beta"
);

/// The type of a contact: sloping, between two layers, or horizontal, within a layer.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Axis, Direction, ContactKind};
///
/// assert_eq!(ContactKind::from(Direction::Beta).name(), "beta");
/// assert_eq!("alpha-beta".parse::<ContactKind>()?, ContactKind::Horizontal(Axis::AlphaBeta));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ContactKind {
    /// A contact with a sphere of the layer below.
    Sloping(Direction),
    /// A contact with a neighbour in the same layer, which exists at a = R.
    Horizontal(Axis),
}

impl ContactKind {
    /// All types, in the order of tables.
    pub const ALL: [Self; 6] = [
        Self::Sloping(Direction::Alpha),
        Self::Sloping(Direction::Beta),
        Self::Sloping(Direction::Gamma),
        Self::Horizontal(Axis::AlphaBeta),
        Self::Horizontal(Axis::AlphaGamma),
        Self::Horizontal(Axis::GammaBeta),
    ];

    /// Returns the name of the direction or axis.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Axis, ContactKind};
    ///
    /// assert_eq!(ContactKind::from(Axis::GammaBeta).name(), "gamma-beta");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sloping(direction) => direction.name(),
            Self::Horizontal(axis) => axis.name(),
        }
    }

    /// Returns the direction of a sloping contact, or `None` for a horizontal one.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Axis, Direction, ContactKind};
    ///
    /// assert_eq!(ContactKind::Sloping(Direction::Alpha).direction(), Some(Direction::Alpha));
    /// assert_eq!(ContactKind::Horizontal(Axis::AlphaBeta).direction(), None);
    /// ```
    #[must_use]
    pub const fn direction(self) -> Option<Direction> {
        match self {
            Self::Sloping(direction) => Some(direction),
            Self::Horizontal(_) => None,
        }
    }
}

impl From<Direction> for ContactKind {
    fn from(direction: Direction) -> Self {
        Self::Sloping(direction)
    }
}

impl From<Axis> for ContactKind {
    fn from(axis: Axis) -> Self {
        Self::Horizontal(axis)
    }
}

named!(
    ContactKind,
    ContactKind::ALL,
    "a direction, such as alpha, or an axis, such as alpha-beta"
);

/// A contact between two spheres of a layer, at a = R: `site` and its [neighbour](Self::neighbour) along `axis`.
///
/// Contacts are ordered as in tables: by site, then by axis.
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
    /// The axis that leads to the other sphere.
    pub axis: Axis,
}

impl HorizontalContact {
    /// Returns the other sphere, or `None` if a coordinate does not fit in `i128`.
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
        // The step is the difference of two directions. Adding them one by one could leave `i128` in between.
        let [up, down] = self.axis.ends().each(|end| Sign::Plus.descent(end));
        Some(Site {
            i: self.site.i.checked_add(down[0] - up[0])?,
            j: self.site.j.checked_add(down[1] - up[1])?,
            k: self.site.k,
        })
    }
}

impl fmt::Display for HorizontalContact {
    /// Prints `(i,j,k) alpha-beta`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        padded(f, format_args!("{} {}", self.site, self.axis))
    }
}
