//! The extremes of the reaction at the base.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::error::bug;
use crate::geometry::{Vector, square_across};
use crate::scalar::{ByValue, Surd};
use crate::{Error, Pile};

/// The exact extremes of the force on the floor over the base of a pile.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
///
/// let base = Pile::triangular(10)?.base_extremes()?;
/// assert_eq!((base.normal_min.to_string(), base.normal_max.to_string()), ("4".into(), "4".into()));
/// // (L−1)/(L+2), in tanθ.
/// assert_eq!(base.max_shear_ratio.to_string(), "3/4");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct BaseExtremes {
    /// The smallest normal force, in mg.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub normal_min: BigRational,
    /// The largest normal force, in mg.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub normal_max: BigRational,
    /// The largest ratio of shear to normal force, in tanθ. The friction coefficient must be at least this large if the
    /// base must not slide. A base that may roll needs more ([`paper`](crate::paper#errata), 4).
    ///
    /// For a tensile normal force, the ratio is that of the magnitudes. A bottom sphere without a normal force has no
    /// ratio. If such a sphere has a shear, no friction holds it, and
    /// [`shear_without_normal`](Self::shear_without_normal) is true.
    pub max_shear_ratio: Surd,
    /// Whether a bottom sphere has a shear, but no normal force.
    #[cfg_attr(feature = "serde", serde(default))]
    pub shear_without_normal: bool,
}

exact_surd::equality!(BaseExtremes; |Self { normal_min, normal_max, max_shear_ratio, shear_without_normal }|
    ([normal_min, normal_max].map(ByValue), max_shear_ratio, shear_without_normal));

impl Pile {
    /// Returns the extremes of the force on the floor.
    ///
    /// Between a few spheres, the normal force is linear in i and j. The ratio is the norm of a linear function divided
    /// by the normal force. In a straight pile under one sphere, the extremes are at the corners. With few sign changes
    /// they are at a few spheres of each row. Otherwise every bottom sphere is computed in floats, and the few
    /// candidates for an extreme are computed exactly.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if more than 10⁸ bottom spheres would be computed, or one of them depends on too many
    /// spheres at sign changes.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    ///
    /// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
    /// let base = pile.base_extremes()?;
    /// assert_eq!((base.normal_min.to_string(), base.normal_max.to_string()), ("14/9".into(), "5/3".into()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn base_extremes(&self) -> Result<BaseExtremes, Error> {
        let forces = self.forces::<BigRational>();
        let across = square_across(self.sin_phi());
        let mut extremes = Extremes::default();
        let unit = forces.ends_of_base(|force| extremes.update(force, &across))?;
        extremes.over(&unit)
    }
}

/// The extremes found so far, as integers.
#[derive(Default)]
struct Extremes {
    normals: Option<(BigInt, BigInt)>,
    /// The largest squared ratio, as numerator and denominator. It is reduced at the end.
    ratio: Option<(BigInt, BigInt)>,
    shear_without_normal: bool,
}

impl Extremes {
    fn update(&mut self, force: &Vector<BigInt>, across: &BigRational) {
        let Vector { x, y, z: normal } = force;
        let (least, most) = self
            .normals
            .get_or_insert_with(|| (normal.clone(), normal.clone()));
        if normal < least {
            least.clone_from(normal);
        }
        if normal > most {
            most.clone_from(normal);
        }
        if normal.is_zero() {
            self.shear_without_normal |= !x.is_zero() || !y.is_zero();
            return;
        }
        let n = x * x * across.denom() + y * y * across.numer();
        let d = normal * normal * across.denom();
        let greater = self
            .ratio
            .as_ref()
            .is_none_or(|(most_n, most_d)| &n * most_d > most_n * &d);
        if greater {
            self.ratio = Some((n, d));
        }
    }

    /// Returns the extremes for forces over the denominator `unit`.
    fn over(self, unit: &BigInt) -> Result<BaseExtremes, Error> {
        let normals = self.normals.ok_or_else(|| bug("a base has a sphere"))?;
        let (least, most) = normals;
        // Without a normal force the ratio is reported as 0.
        let none = (BigInt::zero(), BigInt::one());
        let (n, d) = self.ratio.unwrap_or(none);
        Ok(BaseExtremes {
            normal_min: BigRational::new(least, unit.clone()),
            normal_max: BigRational::new(most, unit.clone()),
            max_shear_ratio: Surd::sqrt(BigRational::new(n, d))?,
            shear_without_normal: self.shear_without_normal,
        })
    }
}
