//! The symmetries of a straight pile under one sphere.

use super::{Direction, Site};

/// A symmetry of the pile: the site whose count along α is the old count along the first direction
/// given, and so on.
///
/// Every permutation maps the sites of a triangular pile onto themselves. On an equilateral base all
/// six are symmetries of the forces; on an isosceles one, and for discs, only the identity and the
/// mirror α ↔ β.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Site, Symmetry};
///
/// let corner = Site { i: 0, j: 0, k: 3 };
/// let images = Symmetry::ALL.map(|symmetry| symmetry.apply(corner).unwrap());
/// // Each of the three corners, twice.
/// for (i, j) in [(0, 0), (3, 0), (0, 3)] {
///     assert_eq!(images.iter().filter(|image| **image == Site { i, j, k: 3 }).count(), 2);
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Symmetry([Direction; 3]);

impl Symmetry {
    /// The paper's rotation about the axis, {j → k−i−j, i → j}: (i, j, k) goes to (j, k−i−j, k).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Site, Symmetry};
    ///
    /// let site = Site { i: 1, j: 2, k: 7 };
    /// let turned = Symmetry::ROTATION.apply(site).unwrap();
    /// assert_eq!(turned, Site { i: 2, j: 4, k: 7 });
    /// let twice = Symmetry::ROTATION.apply(turned).unwrap();
    /// assert_eq!(Symmetry::ROTATION.apply(twice), Some(site));
    /// ```
    pub const ROTATION: Self = Self([Direction::Beta, Direction::Gamma, Direction::Alpha]);

    /// The mirror that exchanges α and β: (i, j, k) goes to (k−i−j, j, k).
    pub const MIRROR: Self = Self([Direction::Beta, Direction::Alpha, Direction::Gamma]);

    /// All six permutations of the directions, the identity first, then the rotations.
    pub const ALL: [Self; 6] = {
        use Direction::{Alpha, Beta, Gamma};
        [
            Self([Alpha, Beta, Gamma]),
            Self::ROTATION,
            Self([Gamma, Alpha, Beta]),
            Self::MIRROR,
            Self([Alpha, Gamma, Beta]),
            Self([Gamma, Beta, Alpha]),
        ]
    };

    /// Returns the image of a site; `None` if it leaves `i128`, which no site of a pile does.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Site, Symmetry};
    ///
    /// let site = Site { i: 1, j: 2, k: 7 };
    /// assert_eq!(Symmetry::MIRROR.apply(site), Some(Site { i: 4, j: 2, k: 7 }));
    /// ```
    #[must_use]
    pub fn apply(self, site: Site) -> Option<Site> {
        let Site { i, j, k } = site;
        let [_, i, j] = self.permute(&[k.checked_sub(i)?.checked_sub(j)?, i, j]);
        Some(Site { i, j, k })
    }

    /// Returns the counts of spheres above the image of a site, from those above the site, in any scalar.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Symmetry;
    ///
    /// assert_eq!(Symmetry::ROTATION.permute(&["α", "β", "γ"]), ["β", "γ", "α"]);
    /// ```
    pub fn permute<T: Clone>(self, above: &[T; 3]) -> [T; 3] {
        self.0.map(|direction| above[direction.index()].clone())
    }

    /// Returns the direction whose line is carried to the line of `direction`: the count along `direction` at an image
    /// is the count along this one at the site it comes from.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Symmetry};
    ///
    /// assert_eq!(Symmetry::MIRROR.source(Direction::Alpha), Direction::Beta);
    /// assert_eq!(Symmetry::MIRROR.source(Direction::Gamma), Direction::Gamma);
    /// ```
    #[must_use]
    pub fn source(self, direction: Direction) -> Direction {
        self.0[direction.index()]
    }
}
