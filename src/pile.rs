//! A pile that exists only validated.

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::Error;
use crate::closed_form::{self, Increments};
use crate::geometry::{Clearance, Vector, directions, disc_directions};
use crate::lattice::{Dimension, Pyramid, Rows, Selection, count};
use crate::query::Statics;
use crate::scalar::{Algebra, Ring};

/// A straight pile under one sphere: which sites it has, and sin φ.
///
/// All that forces in pile units depend on. Spacing, radius, mass and gravity come in with a
/// [`Packing`](crate::Packing), and only there are they checked.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// // 10³⁰ layers cost what 10 do.
/// let pile = Pile::triangular(10_i128.pow(30))?;
/// let statics = pile.statics::<BigRational>();
/// let force = statics.on_floor(Site { i: 5, j: 7, k: pile.layers() - 1 })?;
/// assert_eq!(force.normal.to_string(), "333333333333333333333333333334");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pile {
    pyramid: Pyramid,
    /// 0 for discs: the s → 0 limit of the isosceles pile, whose γ lines carry nothing.
    sin_phi: BigRational,
}

impl Pile {
    /// The paper's pile: an equilateral base, φ = π/6.
    ///
    /// # Errors
    /// [`Error::Layers`] unless 1 ≤ `layers` ≤ [`MAX_LAYERS`](crate::lattice::MAX_LAYERS).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Error, Pile};
    ///
    /// assert_eq!(Pile::triangular(10)?.sin_phi().to_string(), "1/2");
    /// assert!(matches!(Pile::triangular(0), Err(Error::Layers { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn triangular(layers: i128) -> Result<Self, Error> {
        Self::isosceles(layers, BigRational::new(1.into(), 2.into()))
    }

    /// A pile on an isosceles triangle of general φ, by the sine of φ.
    ///
    /// # Errors
    /// [`Error::SinPhi`] unless 0 < sin φ < 1; [`Error::Layers`] as for [`triangular`](Self::triangular).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Error, Pile};
    /// use num_rational::BigRational;
    ///
    /// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    /// assert!(Pile::isosceles(10, ratio(2, 5)).is_ok());
    /// assert!(matches!(Pile::isosceles(10, ratio(1, 1)), Err(Error::SinPhi { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn isosceles(layers: i128, sin_phi: BigRational) -> Result<Self, Error> {
        let pyramid = Pyramid::new(layers, Dimension::Three)?;
        if BigRational::zero() < sin_phi && sin_phi < BigRational::one() {
            Ok(Self { pyramid, sin_phi })
        } else {
            Err(Error::SinPhi { given: sin_phi })
        }
    }

    /// The pile of discs (the paper's ref. hong93): layers of 1, 2, 3, … in a plane.
    ///
    /// # Errors
    /// [`Error::Layers`] as for [`triangular`](Self::triangular).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::discs(10)?.spheres(), 55_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn discs(layers: i128) -> Result<Self, Error> {
        let pyramid = Pyramid::new(layers, Dimension::Two)?;
        Ok(Self {
            pyramid,
            sin_phi: BigRational::zero(),
        })
    }

    /// The sites of the pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert!(pile.pyramid().contains(Site { i: 0, j: 0, k: 9 }));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn pyramid(&self) -> &Pyramid {
        &self.pyramid
    }

    /// The number L of layers.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.layers(), 10);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn layers(&self) -> i128 {
        self.pyramid.layers()
    }

    /// Discs or spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Dimension;
    ///
    /// assert_eq!(Pile::discs(10)?.dimension(), Dimension::Two);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn dimension(&self) -> Dimension {
        self.pyramid.dimension()
    }

    /// sin φ: ½ on an equilateral base, 0 for discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.sin_phi().to_string(), "1/2");
    /// assert_eq!(Pile::discs(10)?.sin_phi().to_string(), "0");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn sin_phi(&self) -> &BigRational {
        &self.sin_phi
    }

    /// Whether all directions are alike: an equilateral base, or discs.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use num_rational::BigRational;
    ///
    /// assert!(Pile::triangular(10)?.is_regular());
    /// assert!(!Pile::isosceles(10, BigRational::new(2.into(), 5.into()))?.is_regular());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.dimension() == Dimension::Two || self.sin_phi == BigRational::new(1.into(), 2.into())
    }

    /// The spheres of the pile, which is also its weight in mg. Of any size.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.spheres(), 220_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn spheres(&self) -> BigUint {
        self.count(|layers, d| count::spheres(&layers, d))
    }

    /// The contacts between spheres; the floor is not one.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.contacts(), 495_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn contacts(&self) -> BigUint {
        self.count(|layers, d| count::contacts(&layers, d))
    }

    /// The spheres of the bottom layer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.base_spheres(), 55_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn base_spheres(&self) -> BigUint {
        self.count(|layers, d| count::spheres_in_layer(&(layers - BigRational::one()), d))
    }

    /// The contacts of one direction whose force is `n` increments: (L−n)(L−n+1)/2 for spheres.
    ///
    /// Zero unless 1 ≤ `n` < L.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.contacts_of_strength(9), 1_u32.into());
    /// assert_eq!(pile.contacts_of_strength(10), 0_u32.into());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn contacts_of_strength(&self, n: i128) -> BigUint {
        if !(1..self.layers()).contains(&n) {
            return BigUint::zero();
        }
        let n = BigRational::from_i128(n);
        self.count(|layers, d| count::contacts_of_strength(&layers, &n, d))
    }

    fn count(&self, formula: impl FnOnce(BigRational, u32) -> BigRational) -> BigUint {
        // A count: an integer, and not negative.
        let layers = BigRational::from_i128(self.layers());
        formula(layers, self.dimension().number())
            .to_integer()
            .into_parts()
            .1
    }

    /// The greatest ratio of shear to normal force on the base, in tanθ: (L−1)/(L+2) on an equilateral
    /// base.
    ///
    /// Necessary for a base that does not slide; a base that may roll needs more (THEORY, erratum 4).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// assert_eq!(Pile::triangular(10)?.max_shear_ratio().to_string(), "3/4");
    /// assert_eq!(Pile::discs(10)?.max_shear_ratio().to_string(), "9/11");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn max_shear_ratio(&self) -> BigRational {
        let increments = self.increments();
        let layers = BigRational::from_i128(self.layers());
        let ratios = self.dimension().directions().iter().map(|direction| {
            // The normal force is at least W > 0.
            let (shear, normal) =
                closed_form::corner_shear_ratio(&layers, &increments, direction.index());
            shear / normal
        });
        ratios.max().unwrap_or_else(BigRational::zero)
    }

    /// The spacings that leave room for the spheres of this pile.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    ///
    /// let least = Pile::triangular(10)?.clearance().least();
    /// assert_eq!(least.map(|spacing| spacing.to_string()), Some("1".into()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn clearance(&self) -> Clearance {
        Clearance::new(&self.pyramid, &self.sin_phi)
    }

    /// The rows of a part of the pile, from the top.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] or [`Error::LayerOutside`] if the selection names what is not there.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.rows(Selection::Layer(2))?.sites(), 6_u32.into());
    /// assert!(pile.rows(Selection::Layer(10)).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn rows(&self, selection: Selection) -> Result<Rows, Error> {
        self.pyramid.rows(selection)
    }

    /// The forces, in the scalar `T`.
    ///
    /// # Examples
    /// One pile in two scalars:
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Direction, Site};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let site = Site { i: 1, j: 2, k: 5 };
    /// let exact: BigRational = pile.statics().contact(site, Direction::Alpha)?;
    /// let float: f64 = pile.statics().contact(site, Direction::Alpha)?;
    /// assert_eq!((exact.to_string().as_str(), float), ("3", 3.0));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn statics<T: Algebra>(&self) -> Statics<'_, T> {
        Statics::new(self)
    }

    /// What a sphere of this pile adds to its lines.
    pub(crate) fn increments<T: Algebra>(&self) -> Increments<T, 3> {
        Increments::isosceles(&T::from_rational(&self.sin_phi))
    }

    /// ê_a, ê_b, ê_c in the symbolic basis.
    pub(crate) fn directions<T: Algebra>(&self) -> [Vector<T>; 3] {
        match self.dimension() {
            Dimension::Two => disc_directions(),
            Dimension::Three => directions(&T::from_rational(&self.sin_phi)),
        }
    }
}
