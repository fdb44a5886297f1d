//! What the floor feels: the extremes over the base.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::lattice::Selection;
use crate::scalar::{Ring, Surd};
use crate::{Error, FloorForce, Pile};

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
#[non_exhaustive]
pub struct BaseExtremes {
    /// The least normal force, in mg.
    pub normal_min: BigRational,
    /// The greatest normal force, in mg.
    pub normal_max: BigRational,
    /// The greatest ratio of shear to normal force, in tanθ: necessary for a base that does not slide; a base that may
    /// roll needs more (THEORY, erratum 4). Of bottom spheres that feel nothing there is no ratio.
    pub max_shear_ratio: Surd,
}

impl Pile {
    /// The extremes of the force on the floor.
    ///
    /// Of a straight pile under one sphere they are at the corners of the base, since the normal force is linear, and
    /// the ratio the norm of a linear function over it. Of any other pile every bottom sphere is looked at.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for a base of more than 10⁸ spheres, unless it is that of a straight pile under one sphere.
    pub fn base_extremes(&self) -> Result<BaseExtremes, Error> {
        const MOST: u64 = 100_000_000;
        let rows = self.rows(Selection::Base)?;
        let statics = self.statics::<BigRational>();
        // 4cos²φ, which the shear along y is in.
        let s = self.sin_phi();
        let across = BigRational::from_i128(4) * (BigRational::one() - s * s);
        let mut extremes = Extremes::default();
        if self.is_paper_pile() {
            for corner in rows.corners() {
                extremes.meet(&statics.on_floor(corner)?, &across);
            }
        } else {
            if rows.sites() > MOST.into() {
                return Err(Error::TooLarge {
                    quantity: "the extremes over this base",
                    needed: rows.sites(),
                    limit: MOST,
                    remedy: "ask for single spheres",
                });
            }
            for force in statics.base(rows) {
                extremes.meet(&force?, &across);
            }
        }
        extremes.finish()
    }
}

/// The extremes so far.
#[derive(Default)]
struct Extremes {
    normals: Option<(BigRational, BigRational)>,
    /// The greatest squared ratio, as numerator and denominator of squares: reduced at the end.
    ratio: Option<(BigInt, BigInt)>,
}

impl Extremes {
    fn meet(&mut self, force: &FloorForce<BigRational>, across: &BigRational) {
        let normal = &force.normal;
        self.normals = Some(match self.normals.take() {
            None => (normal.clone(), normal.clone()),
            Some((least, most)) if *normal < least => (normal.clone(), most),
            Some((least, most)) if *normal > most => (least, normal.clone()),
            Some(normals) => normals,
        });
        if normal.is_zero() {
            return;
        }
        let shear2 = &force.shear_x * &force.shear_x + &force.shear_y * &force.shear_y * across;
        let (n, d) = (
            shear2.numer() * normal.denom().pow(2),
            shear2.denom() * normal.numer().pow(2),
        );
        let greater = self
            .ratio
            .as_ref()
            .is_none_or(|(most_n, most_d)| &n * most_d > most_n * &d);
        if greater {
            self.ratio = Some((n, d));
        }
    }

    fn finish(self) -> Result<BaseExtremes, Error> {
        // A base has a sphere.
        let (normal_min, normal_max) = self.normals.unwrap_or_default();
        let (n, d) = self
            .ratio
            .unwrap_or_else(|| (BigInt::zero(), BigInt::one()));
        let squared = if d.is_positive() {
            BigRational::new(n, d)
        } else {
            BigRational::zero()
        };
        Ok(BaseExtremes {
            normal_min,
            normal_max,
            max_shear_ratio: Surd::sqrt(squared)?,
        })
    }
}
