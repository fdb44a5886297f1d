//! Vectors in the symbolic basis.

use core::fmt;
use core::ops::{Add, Neg, Sub};

use exact_surd::layout::{padded, part};

use crate::each::Each;
use crate::scalar::Ring;

/// A vector with components in the symbolic basis (sinθ, 2cosφ·sinθ, cosθ), where z points down.
///
/// The components x, y, z represent x·sinθ, y·2cosφ·sinθ (√3·sinθ on an equilateral base) and z·cosθ. The function that
/// returns a vector documents its unit. [`on`](Self::on) multiplies by numerical values of the basis.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(bound = "T: crate::data::Number", deny_unknown_fields)
)]
pub struct Vector<T> {
    /// The component along x̂ sinθ.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub x: T,
    /// The component along ŷ 2cosφ sinθ.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub y: T,
    /// The component along ẑ cosθ, down.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub z: T,
}

exact_surd::equality!(Vector<T>, T: Ring; |Self { x, y, z }| [x, y, z].map(Ring::comparison_key));

impl<T: Ring> Vector<T> {
    /// Returns the zero vector.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Vector;
    ///
    /// let v = Vector { x: 1.0, y: 2.0, z: 3.0 };
    /// assert_eq!(v.clone() + &Vector::zero(), v);
    /// assert_eq!(v.clone() - &v, Vector::zero());
    /// ```
    #[must_use]
    pub fn zero() -> Self {
        Self {
            x: T::zero(),
            y: T::zero(),
            z: T::zero(),
        }
    }

    /// Returns the vector multiplied by a scalar.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Vector;
    ///
    /// let v = Vector { x: 1.0, y: 2.0, z: 3.0 };
    /// assert_eq!(v.scaled(&2.0), Vector { x: 2.0, y: 4.0, z: 6.0 });
    /// ```
    #[must_use]
    pub fn scaled(self, factor: &T) -> Self {
        self.map(|c| c * factor)
    }

    /// Returns the vector rotated by 180° about the vertical, (−x, −y, z). This maps contact directions under + steps
    /// to those under − steps.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Vector;
    ///
    /// let v = Vector { x: 1.0, y: 2.0, z: 3.0 };
    /// assert_eq!(v.turned_about_z(), Vector { x: -1.0, y: -2.0, z: 3.0 });
    /// ```
    #[must_use]
    pub fn turned_about_z(self) -> Self {
        Self {
            x: -self.x,
            y: -self.y,
            z: self.z,
        }
    }

    /// Returns the sum Σ c_m v_m.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::{directions, Vector};
    ///
    /// let sum = Vector::combination(&[1.0, 1.0, 0.0], &directions(&0.5));
    /// assert_eq!(sum, Vector { x: 1.0, y: 0.0, z: -2.0 });
    /// ```
    #[must_use]
    pub fn combination(coefficients: &[T; 3], vectors: &[Self; 3]) -> Self {
        coefficients
            .iter()
            .zip(vectors)
            .fold(Self::zero(), |sum, (c, v)| sum + &v.clone().scaled(c))
    }

    /// Returns the Cartesian components (x·b₀, y·b₁, z·b₂), for numerical values b of the basis.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Vector;
    ///
    /// let (sin, cos, phi) = (0.6, 0.8, core::f64::consts::FRAC_PI_6);
    /// let e_c = Vector { x: -1.0, y: 0.0, z: -1.0 };
    /// assert_eq!(e_c.on(&[sin, 2.0 * phi.cos() * sin, cos]), [-0.6, 0.0, -0.8]);
    /// ```
    #[must_use]
    pub fn on(self, basis: &[T; 3]) -> [T; 3] {
        let [sin, across, cos] = basis;
        [self.x * sin, self.y * across, self.z * cos]
    }
}

impl<T> Vector<T> {
    /// Returns the vector with `f` applied to each component.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Vector;
    ///
    /// let v = Vector { x: 1, y: -2, z: 3 };
    /// assert_eq!(v.map(f64::from), Vector { x: 1.0, y: -2.0, z: 3.0 });
    /// ```
    #[must_use]
    pub fn map<U>(self, f: impl FnMut(T) -> U) -> Vector<U> {
        let [x, y, z] = self.into_array().each(f);
        Vector { x, y, z }
    }

    /// Returns the components [x, y, z].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::{directions, Vector};
    ///
    /// let [a, _, _] = directions(&0.25);
    /// assert_eq!(a.into_array(), [0.25, 0.5, -1.0]);
    /// ```
    #[must_use]
    pub fn into_array(self) -> [T; 3] {
        [self.x, self.y, self.z]
    }
}

impl<T: fmt::Display> fmt::Display for Vector<T> {
    /// Prints `(1/2, 0, -1)`. The sign and precision of the format apply to the components.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Vector;
    ///
    /// let v = Vector { x: 0.25, y: 0.0, z: -1.0 };
    /// assert_eq!(v.to_string(), "(0.25, 0, -1)");
    /// assert_eq!(format!("{v:+.1}"), "(+0.2, +0.0, -1.0)");
    /// assert_eq!(format!("{v:>16}"), "   (0.25, 0, -1)");
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = [&self.x, &self.y, &self.z].each(|component| part(f, component));
        padded(f, format_args!("({x}, {y}, {z})"))
    }
}

impl<T: Ring> Add<&Self> for Vector<T> {
    type Output = Self;

    fn add(self, rhs: &Self) -> Self {
        Self {
            x: self.x + &rhs.x,
            y: self.y + &rhs.y,
            z: self.z + &rhs.z,
        }
    }
}

impl<T: Ring> Sub<&Self> for Vector<T> {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        Self {
            x: self.x - &rhs.x,
            y: self.y - &rhs.y,
            z: self.z - &rhs.z,
        }
    }
}

impl<T: Ring> Neg for Vector<T> {
    type Output = Self;

    fn neg(self) -> Self {
        self.map(|c| -c)
    }
}
