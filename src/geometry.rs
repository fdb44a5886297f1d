//! Geometry of piles: angles, contact directions, positions and overlap.
//!
//! The basis is that of the paper: x and y are horizontal, and z points **down**. A contact has the angle θ to the
//! vertical. The unit vectors along the contacts point from the lower sphere to the upper one (paper, (1)):
//!
//! ê_a = (sinθ sinφ, sinθ cosφ, −cosθ), ê_b = (sinθ sinφ, −sinθ cosφ, −cosθ), ê_c = (−sinθ, 0, −cosθ).
//!
//! For rational s = sin φ their components are rational in the *symbolic basis* (sinθ, 2cosφ·sinθ, cosθ): ê_a = (s, ½,
//! −1), ê_b = (s, −½, −1), ê_c = (−1, 0, −1). A [`Vector`] contains such components in any scalar type. The roots sinθ,
//! cosφ and cosθ enter only in the output. With q = (a/R)², sin²θ = q/3 for spheres and q/4 for discs, so sin²θ is
//! rational whenever a/R is.

mod clearance;
mod load;
mod spacing;
mod vector;

pub use clearance::{Clearance, LayerGap};
pub use load::Load;
pub(crate) use spacing::Bound;
pub use spacing::Spacing;
pub use vector::Vector;

use alloc::boxed::Box;

use num_rational::BigRational;
use num_traits::One;

use crate::each::Each;
use crate::lattice::Dimension;
use crate::scalar::{Algebra, ByValue, Ring, Surd, TWO};
use crate::{Error, ratio};

/// Returns the contact directions ê_a, ê_b, ê_c in the symbolic basis: (s, ½, −1), (s, −½, −1), (−1, 0, −1).
///
/// See (1) of the paper. `s` is sin φ: ½ for the equilateral base, 0 < s < 1 in general. The result is exact in exact
/// scalars.
///
/// # Examples
/// ```
/// use cannonpile::geometry::{directions, Vector};
///
/// let [a, b, c] = directions(&0.5);
/// assert_eq!(a, Vector { x: 0.5, y: 0.5, z: -1.0 });
/// // On an equilateral base the horizontal parts cancel.
/// assert_eq!(a + &b + &c, Vector { x: 0.0, y: 0.0, z: -3.0 });
/// ```
#[must_use]
pub fn directions<T: Algebra>(s: &T) -> [Vector<T>; 3] {
    let half = T::one().div_int(TWO);
    let up = -T::one();
    [
        Vector {
            x: s.clone(),
            y: half.clone(),
            z: up.clone(),
        },
        Vector {
            x: s.clone(),
            y: -half,
            z: up.clone(),
        },
        Vector {
            x: -T::one(),
            y: T::zero(),
            z: up,
        },
    ]
}

/// Returns the contact directions of a pile of discs, in the basis (sinθ, 2sinθ, cosθ): ê_a = (1, 0, −1) and ê_b = (−1,
/// 0, −1).
///
/// The plane of the discs is x–z. The pile of discs is the pile of spheres with s = 0, whose γ contacts carry no force,
/// rotated by 90° about z. The third vector ê_c = (0, ½, −1) completes the array and is not used.
///
/// # Examples
/// ```
/// use cannonpile::geometry::{disc_directions, Vector};
///
/// let [a, b, _] = disc_directions();
/// assert_eq!(a + &b, Vector { x: 0.0, y: 0.0, z: -2.0 });
/// ```
#[must_use]
pub fn disc_directions<T: Algebra>() -> [Vector<T>; 3] {
    let half = T::one().div_int(TWO);
    let up = -T::one();
    [
        Vector {
            x: T::one(),
            y: T::zero(),
            z: up.clone(),
        },
        Vector {
            x: -T::one(),
            y: T::zero(),
            z: up.clone(),
        },
        Vector {
            x: T::zero(),
            y: half,
            z: up,
        },
    ]
}

/// Returns the position of a sphere relative to the apex, in units of 2R and in the symbolic basis: −(N_α ê_a + N_β ê_b
/// + N_γ ê_c).
///
/// `above` contains the numbers of spheres above it on its lines ([`count::above`](crate::lattice::count::above)). So r
/// = −2R[(k−i−j) ê_a + i ê_b + j ê_c]. The result is exact in exact scalars.
///
/// # Examples
/// ```
/// use cannonpile::geometry::{directions, position, Vector};
/// use cannonpile::lattice::count;
///
/// let r = position(&count::above(&1.0, &0.0, &1.0), &directions(&0.5));
/// assert_eq!(r, Vector { x: -0.5, y: 0.5, z: 1.0 });
/// ```
#[must_use]
pub fn position<T: Ring>(above: &[T; 3], directions: &[Vector<T>; 3]) -> Vector<T> {
    -Vector::combination(above, directions)
}

/// Returns the squared distance between two sphere centres over 4R². The centres differ by n_a ê_a + n_b ê_b + n_c ê_c,
/// in units of 2R.
///
/// The Gram matrix is ê·ê = 1, ê_a·ê_b = cos²θ + (2s²−1) sin²θ, ê_a·ê_c = ê_b·ê_c = cos²θ − s sin²θ. For discs, `s` and
/// n_c are 0. Two spheres overlap if the result is below 1 and touch if it is 1. The result is exact in exact scalars.
///
/// # Examples
/// ```
/// use cannonpile::geometry::squared_distance;
///
/// // In the fcc case a = R, sin²θ = 1/3, neighbours in a layer touch.
/// let d = squared_distance(&[1.0, -1.0, 0.0], &0.5, &(1.0 / 3.0));
/// assert!((d - 1.0_f64).abs() < 1e-15);
/// ```
#[must_use]
pub fn squared_distance<T: Ring>(n: &[T; 3], s: &T, sin2: &T) -> T {
    let two = T::from_integer(2);
    let cos2 = T::one() - sin2;
    let ab = cos2.clone() + &((two.clone() * s * s - &T::one()) * sin2);
    let ac = cos2 - &(s.clone() * sin2);
    let [a, b, c] = n;
    let squares = a.clone() * a + &(b.clone() * b) + &(c.clone() * c);
    let mixed = a.clone() * b * &ab + &((a.clone() + b) * c * &ac);
    squares + &(two * &mixed)
}

/// The angle θ between a contact and the vertical, stored as the rational sin²θ.
///
/// # Examples
/// ```
/// use cannonpile::geometry::{Inclination, Spacing};
/// use cannonpile::lattice::Dimension;
///
/// let spacing: Spacing = "6/5".parse()?;
/// let angle = Inclination::new(&spacing, Dimension::Three)?;
/// assert_eq!(angle.sin2().to_string(), "12/25");
/// assert_eq!(angle.tan2().to_string(), "12/13");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Inclination {
    sin2: BigRational,
}

exact_surd::equality!(Hash for Inclination; |Self { sin2 }| ByValue(sin2));

impl Inclination {
    /// Returns the angle for this spacing: sin²θ = q(d−1)/(2d), with q = (a/R)² and the dimension d.
    ///
    /// # Errors
    /// [`Error::TooFlat`] if sin²θ ≥ 1: a sphere would fall between its supports.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Error;
    /// use cannonpile::geometry::{Inclination, Spacing};
    /// use cannonpile::lattice::Dimension;
    /// use num_rational::BigRational;
    ///
    /// let flat = Spacing::from_square(BigRational::from_integer(3.into()))?;
    /// assert!(matches!(Inclination::new(&flat, Dimension::Three), Err(Error::TooFlat { .. })));
    /// assert!(Inclination::new(&flat, Dimension::Two).is_ok());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(spacing: &Spacing, dimension: Dimension) -> Result<Self, Error> {
        let sin2 = spacing.square() / square_per_sin2(dimension);
        if sin2 < BigRational::one() {
            Ok(Self { sin2 })
        } else {
            Err(Error::TooFlat {
                spacing: Box::new(spacing.clone()),
                limit: Box::new(Spacing::from_square(square_per_sin2(dimension))?),
            })
        }
    }

    /// Returns sin²θ, which lies between 0 and 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::{Inclination, Spacing};
    /// use cannonpile::lattice::Dimension;
    ///
    /// let spacing: Spacing = "6/5".parse()?;
    /// // sin²θ is q/3 for spheres and q/4 for discs.
    /// assert_eq!(Inclination::new(&spacing, Dimension::Three)?.sin2().to_string(), "12/25");
    /// assert_eq!(Inclination::new(&spacing, Dimension::Two)?.sin2().to_string(), "9/25");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn sin2(&self) -> &BigRational {
        &self.sin2
    }

    /// Returns cos²θ = 1 − sin²θ, which is positive.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::{Inclination, Spacing};
    /// use cannonpile::lattice::Dimension;
    ///
    /// let spacing: Spacing = "6/5".parse()?;
    /// assert_eq!(Inclination::new(&spacing, Dimension::Three)?.cos2().to_string(), "13/25");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn cos2(&self) -> BigRational {
        BigRational::one() - &self.sin2
    }

    /// Returns tan²θ = sin²θ / cos²θ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::{Inclination, Spacing};
    /// use cannonpile::lattice::Dimension;
    ///
    /// let spacing: Spacing = "6/5".parse()?;
    /// assert_eq!(Inclination::new(&spacing, Dimension::Three)?.tan2().to_string(), "12/13");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn tan2(&self) -> BigRational {
        &self.sin2 / self.cos2()
    }

    /// Returns the exact value of sinθ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::{Inclination, Spacing};
    /// use cannonpile::lattice::Dimension;
    ///
    /// let spacing: Spacing = "6/5".parse()?;
    /// let angle = Inclination::new(&spacing, Dimension::Three)?;
    /// assert_eq!(angle.sin().to_string(), "2/5*sqrt(3)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn sin(&self) -> Surd {
        Surd::root_of(self.sin2.clone())
    }

    /// Returns the exact value of cosθ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::{Inclination, Spacing};
    /// use cannonpile::lattice::Dimension;
    ///
    /// let spacing: Spacing = "6/5".parse()?;
    /// let angle = Inclination::new(&spacing, Dimension::Three)?;
    /// assert_eq!(angle.cos().to_string(), "1/5*sqrt(13)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn cos(&self) -> Surd {
        Surd::root_of(self.cos2())
    }

    /// Returns the exact value of tanθ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::{Inclination, Spacing};
    /// use cannonpile::lattice::Dimension;
    ///
    /// let spacing: Spacing = "6/5".parse()?;
    /// let angle = Inclination::new(&spacing, Dimension::Three)?;
    /// assert_eq!(angle.tan().to_string(), "2/13*sqrt(39)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn tan(&self) -> Surd {
        Surd::root_of(self.tan2())
    }
}

/// Returns q / sin²θ = 2d/(d−1): 4 for discs, 3 for spheres.
pub(crate) fn square_per_sin2(dimension: Dimension) -> BigRational {
    match dimension {
        Dimension::Two => ratio!(4),
        Dimension::Three => ratio!(3),
    }
}

/// Returns 4cos²φ, the squared length of the unit along y in the symbolic basis over sin²θ.
///
/// # Examples
/// ```
/// use cannonpile::geometry::square_across;
/// use cannonpile::ratio;
///
/// assert_eq!(square_across(&ratio!(1/2)), ratio!(3));
/// ```
#[must_use]
pub fn square_across(sin_phi: &BigRational) -> BigRational {
    let [p2, q2] = [sin_phi.numer(), sin_phi.denom()].each(|x| x * x);
    BigRational::new((&q2 - p2) * 4, q2)
}
