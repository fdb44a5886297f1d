//! The sites of a straight pile under one sphere, and its symmetries.

use super::{Dimension, Direction, MAX_LAYERS, Rows, Selection, Site};
use crate::Error;

/// The sites of a straight pile: layers of 1, 3, 6, … spheres under one, or of 1, 2, 3, … discs.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Dimension, Direction, Pyramid, Site};
///
/// let pyramid = Pyramid::new(4, Dimension::Three)?;
/// let site = Site { i: 1, j: 0, k: 2 };
/// assert_eq!(pyramid.below(site, Direction::Gamma), Some(Site { i: 1, j: 1, k: 3 }));
/// // It lies on the surface j = 0: nothing above it on its γ line.
/// assert_eq!(pyramid.above(site, Direction::Gamma), None);
/// assert_eq!(pyramid.sites().count(), 20);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pyramid {
    layers: i128,
    dimension: Dimension,
}

impl Pyramid {
    /// The sites of `layers` layers.
    ///
    /// # Errors
    /// [`Error::Layers`] unless 1 ≤ `layers` ≤ [`MAX_LAYERS`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Error;
    /// use cannonpile::lattice::{Dimension, Pyramid};
    ///
    /// assert_eq!(Pyramid::new(4, Dimension::Two)?.layers(), 4);
    /// assert!(matches!(Pyramid::new(0, Dimension::Two), Err(Error::Layers { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(layers: i128, dimension: Dimension) -> Result<Self, Error> {
        if (1..=MAX_LAYERS).contains(&layers) {
            Ok(Self { layers, dimension })
        } else {
            Err(Error::Layers {
                given: layers.into(),
            })
        }
    }

    /// The number L of layers.
    #[must_use]
    pub const fn layers(&self) -> i128 {
        self.layers
    }

    /// Discs or spheres.
    #[must_use]
    pub const fn dimension(&self) -> Dimension {
        self.dimension
    }

    /// Whether the pile has this site.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Pyramid, Site};
    ///
    /// let site = Site { i: 1, j: 1, k: 2 };
    /// assert!(Pyramid::new(4, Dimension::Three)?.contains(site));
    /// assert!(!Pyramid::new(4, Dimension::Two)?.contains(site));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn contains(&self, site: Site) -> bool {
        let Site { i, j, k } = site;
        let in_plane = self.dimension == Dimension::Three || j == 0;
        // Each comparison makes the subtraction of the next one safe.
        (0..self.layers).contains(&k)
            && (0..=k).contains(&j)
            && (0..=k - j).contains(&i)
            && in_plane
    }

    /// `site`, if the pile has it.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] otherwise.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Pyramid, Site};
    ///
    /// let pyramid = Pyramid::new(4, Dimension::Three)?;
    /// assert_eq!(pyramid.check(Site::APEX)?, Site::APEX);
    /// assert!(pyramid.check(Site { i: 0, j: 0, k: 4 }).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn check(&self, site: Site) -> Result<Site, Error> {
        if self.contains(site) {
            Ok(site)
        } else {
            Err(Error::SiteOutside {
                site,
                layers: self.layers,
                dimension: self.dimension,
            })
        }
    }

    /// The sphere that `site` rests on in `direction`; `None` on the floor or outside the pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Direction, Pyramid, Site};
    ///
    /// let pyramid = Pyramid::new(4, Dimension::Three)?;
    /// assert_eq!(pyramid.below(Site::APEX, Direction::Beta), Some(Site { i: 1, j: 0, k: 1 }));
    /// assert_eq!(pyramid.below(Site { i: 0, j: 0, k: 3 }, Direction::Beta), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn below(&self, site: Site, direction: Direction) -> Option<Site> {
        self.neighbour(site, direction, 1)
    }

    /// The sphere that rests on `site` in `direction`; `None` at the surface or outside the pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Direction, Pyramid, Site};
    ///
    /// let pyramid = Pyramid::new(4, Dimension::Three)?;
    /// let site = Site { i: 1, j: 0, k: 2 };
    /// assert_eq!(pyramid.above(site, Direction::Alpha), Some(Site { i: 1, j: 0, k: 1 }));
    /// assert_eq!(pyramid.above(Site::APEX, Direction::Alpha), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn above(&self, site: Site, direction: Direction) -> Option<Site> {
        self.neighbour(site, direction, -1)
    }

    fn neighbour(&self, site: Site, direction: Direction, down: i128) -> Option<Site> {
        let from = self.contains(site).then_some(site)?;
        let to = from.step(direction, down)?;
        self.contains(to).then_some(to)
    }

    /// The rows of a part of the pile, from the top.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] or [`Error::LayerOutside`] if the selection names what is not there.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Pyramid, Row, Selection};
    ///
    /// let pyramid = Pyramid::new(4, Dimension::Three)?;
    /// let mut layer = pyramid.rows(Selection::Layer(1))?;
    /// assert_eq!(layer.next(), Some(Row { k: 1, j: 0, i: 0..2 }));
    /// assert_eq!(layer.next(), Some(Row { k: 1, j: 1, i: 0..1 }));
    /// assert!(pyramid.rows(Selection::Layer(4)).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn rows(&self, selection: Selection) -> Result<Rows, Error> {
        Rows::new(self, selection)
    }

    /// Every site in row order from the top.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Pyramid, Site};
    ///
    /// let pyramid = Pyramid::new(4, Dimension::Three)?;
    /// let mut sites = pyramid.sites();
    /// assert_eq!(sites.next(), Some(Site::APEX));
    /// assert_eq!(sites.last(), Some(Site { i: 0, j: 3, k: 3 }));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn sites(&self) -> impl Iterator<Item = Site> + use<> {
        Rows::of_layers(self.dimension, 0..self.layers).flatten()
    }
}

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

    /// The image of a site; `None` if it leaves `i128`, which no site of a pile does.
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

    /// The counts of spheres above at the image, from those at the site, in any scalar.
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

    /// The direction whose line is carried to the line of `direction`: the count along `direction` at an
    /// image is the count along this one at the site it comes from.
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
