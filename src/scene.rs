//! A scene: the options that describe a pile and its spheres, and the parsers of their values.

pub mod parse;

use num_rational::BigRational;
use num_traits::{One, Signed};

use crate::geometry::Spacing;
use crate::lattice::Dimension;
use crate::{Error, Packing, Pile};

/// A straight pile and its spheres, as a user describes them; unchecked until a [`Pile`] or a
/// [`Packing`] is asked for.
///
/// # Examples
/// ```
/// use cannonpile::scene::{Scene, parse};
///
/// let scene = Scene { layers: 4, spacing: Some(parse::rational("1.2")?), ..Scene::default() };
/// let pile = scene.pile()?;
/// assert_eq!(pile.spheres(), 20_u32.into());
/// assert!(scene.packing(&pile)?.touching().is_empty());
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scene {
    /// The number of layers (10).
    pub layers: i128,
    /// Discs or spheres (spheres).
    pub dimension: Dimension,
    /// sin φ (½); none for discs.
    pub sin_phi: Option<BigRational>,
    /// a/R. One that is given is always checked, the default 6/5 only where geometry is used.
    pub spacing: Option<BigRational>,
    /// The radius R (1).
    pub radius: BigRational,
    /// The mass m of a sphere (1).
    pub mass: BigRational,
    /// The gravity g (1).
    pub gravity: BigRational,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            layers: 10,
            dimension: Dimension::Three,
            sin_phi: None,
            spacing: None,
            radius: BigRational::one(),
            mass: BigRational::one(),
            gravity: BigRational::one(),
        }
    }
}

impl Scene {
    /// The pile, checked; with the spacing, if one is given.
    ///
    /// # Errors
    /// Those of [`Pile::isosceles`] and [`Packing::new`], and [`Error::SinPhiOfDiscs`].
    pub fn pile(&self) -> Result<Pile, Error> {
        let pile = match (self.dimension, &self.sin_phi) {
            (Dimension::Two, None) => Pile::discs(self.layers)?,
            (Dimension::Two, Some(_)) => return Err(Error::SinPhiOfDiscs),
            (Dimension::Three, None) => Pile::triangular(self.layers)?,
            (Dimension::Three, Some(s)) => Pile::isosceles(self.layers, s.clone())?,
        };
        if let Some(spacing) = &self.spacing {
            pile.clearance().check(&Spacing::new(spacing.clone())?)?;
        }
        Ok(pile)
    }

    /// That radius, mass and gravity are positive, whether they will be used or not.
    ///
    /// # Errors
    /// [`Error::NotPositive`].
    pub fn check_sizes(&self) -> Result<(), Error> {
        for (quantity, value) in [
            ("radius", &self.radius),
            ("mass", &self.mass),
            ("gravity", &self.gravity),
        ] {
            if !value.is_positive() {
                return Err(Error::NotPositive {
                    quantity,
                    given: value.clone(),
                });
            }
        }
        Ok(())
    }

    /// The spacing: the one given, or 6/5. Whether it fits the pile is not checked here.
    ///
    /// # Errors
    /// [`Error::NotPositive`].
    pub fn spacing(&self) -> Result<Spacing, Error> {
        let default = || BigRational::new(6.into(), 5.into());
        Spacing::new(self.spacing.clone().unwrap_or_else(default))
    }

    /// The pile with the sizes and weights of the scene.
    ///
    /// # Errors
    /// Those of [`Packing::new`], and [`Error::NotPositive`].
    pub fn packing<'p>(&self, pile: &'p Pile) -> Result<Packing<'p>, Error> {
        Packing::new(pile, &self.spacing()?)?
            .with_radius(self.radius.clone())?
            .with_mass(self.mass.clone())?
            .with_gravity(self.gravity.clone())
    }
}
