//! What the floor feels: the extremes over the base.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::error::bug;
use crate::geometry::Vector;
use crate::scalar::{Ring, Surd};
use crate::{Error, Pile};

/// The extremes of the force on the floor over the base of a pile. Exact.
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
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct BaseExtremes {
    /// The least normal force, in mg.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub normal_min: BigRational,
    /// The greatest normal force, in mg.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub normal_max: BigRational,
    /// The greatest ratio of shear to normal force, in tanθ: necessary for a base that does not slide; a base that may
    /// roll needs more ([`paper`](crate::paper#errata), 4). Of bottom spheres without a normal force there is none, and of those that
    /// would be pulled it is that of the magnitudes: both occur only in piles without weight, that do not stand, or that
    /// were given horizontal forces.
    pub max_shear_ratio: Surd,
}

impl Pile {
    /// The extremes of the force on the floor.
    ///
    /// The normal force is linear in i and j between few places, and the ratio the norm of a linear function over it: of
    /// a straight pile under one sphere the extremes are at its corners, of others with few changes of sign among few
    /// spheres of each row. Otherwise every bottom sphere is looked at, in floats first, which leave few to exact numbers.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if more than 10⁸ bottom spheres would have to be looked at, or one of them depends on too many
    /// spheres at changes of sign.
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
        // The squared length of the unit of shear along y, 4cos²φ.
        let s = self.sin_phi();
        let across = BigRational::from_i128(4) * (BigRational::one() - s * s);
        let mut extremes = Extremes::default();
        let unit = forces.ends_of_base(&across, |force| extremes.meet(force, &across))?;
        extremes.over(&unit)
    }
}

/// The extremes so far, as integers.
#[derive(Default)]
struct Extremes {
    normals: Option<(BigInt, BigInt)>,
    /// The greatest squared ratio, as numerator and denominator: reduced at the end.
    ratio: Option<(BigInt, BigInt)>,
}

impl Extremes {
    fn meet(&mut self, force: &Vector<BigInt>, across: &BigRational) {
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

    /// Their values, for forces over this denominator.
    fn over(self, unit: &BigInt) -> Result<BaseExtremes, Error> {
        let normals = self.normals.ok_or_else(|| bug("a base has a sphere"))?;
        let (least, most) = normals;
        // Where no sphere presses on the floor there is no ratio, and no shear.
        let none = (BigInt::zero(), BigInt::one());
        let (n, d) = self.ratio.unwrap_or(none);
        Ok(BaseExtremes {
            normal_min: BigRational::new(least, unit.clone()),
            normal_max: BigRational::new(most, unit.clone()),
            max_shear_ratio: Surd::sqrt(BigRational::new(n, d))?,
        })
    }
}
