//! External forces on a sphere, of any direction.

use core::fmt;
use core::hash::{Hash, Hasher};
use core::ops::Add;

use num_rational::BigRational;

use exact_surd::layout::{padded, part};

use crate::each::Each;
use crate::scalar::{ByValue, Ring};

/// An external force on a sphere, in the units of the forces on the floor.
///
/// A sphere of weight mg has the load (1, 0, 0). Under gravity that leans by (x, y), it has the load (1, x, y).
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::{Load, Pile, ratio};
///
/// let push = Load { down: ratio!(0), x: ratio!(1/4), y: ratio!(0) };
/// let pile = Pile::triangular(10)?.with_load(Site::APEX, push)?;
/// let forces = pile.forces::<f64>();
/// // The push of mg·tanθ/4 loads the support γ, which lies ahead, and relieves the others.
/// assert_eq!(forces.contact(Site::APEX, Direction::Gamma)?, 1.5);
/// assert_eq!(forces.contact(Site::APEX, Direction::Alpha)?, 0.75);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(
    feature = "serde",
    derive(::serde::Serialize, ::serde::Deserialize),
    serde(bound = "T: crate::data::Number", deny_unknown_fields)
)]
pub struct Load<T = BigRational> {
    /// The force downwards, in mg.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub down: T,
    /// The force along x, in mg·tanθ.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub x: T,
    /// The force along y, in 2cosφ·mg·tanθ, which is √3·mg·tanθ on an equilateral base.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub y: T,
}

exact_surd::equality!(Load<T>, T: Ring; |Self { down, x, y }| [down, x, y].map(Ring::comparison_key));

impl Hash for Load {
    fn hash<H: Hasher>(&self, state: &mut H) {
        [&self.down, &self.x, &self.y].map(ByValue).hash(state);
    }
}

impl<T> Load<T> {
    /// Returns the load with `convert` applied to each component.
    pub fn map<U>(self, mut convert: impl FnMut(T) -> U) -> Load<U> {
        Load {
            down: convert(self.down),
            x: convert(self.x),
            y: convert(self.y),
        }
    }
}

impl<T: Ring> Load<T> {
    /// Returns the load of no force.
    #[must_use]
    pub fn zero() -> Self {
        T::zero().into()
    }

    /// Returns the loads of 1 mg downwards, 1 mg·tanθ along x, and 1 mg·tanθ·2cosφ along y.
    ///
    /// # Examples
    /// See [`Pile::bare`](crate::Pile::bare).
    #[must_use]
    pub fn units() -> [Self; 3] {
        let zero = Self::zero();
        [
            Self {
                down: T::one(),
                ..zero.clone()
            },
            Self {
                x: T::one(),
                ..zero.clone()
            },
            Self {
                y: T::one(),
                ..zero
            },
        ]
    }

    /// Returns the weight of a sphere under gravity that leans by `tilt`: (w, w·x, w·y).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Load;
    ///
    /// assert_eq!(Load::leaning(2.0, &[0.25, 0.0]), Load { down: 2.0, x: 0.5, y: 0.0 });
    /// ```
    #[must_use]
    pub fn leaning(weight: T, [x, y]: &[T; 2]) -> Self {
        Self {
            x: weight.clone() * x,
            y: weight.clone() * y,
            down: weight,
        }
    }

    /// Returns whether all components are zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.down.is_zero() && self.is_vertical()
    }

    /// Returns whether the load is vertical.
    #[must_use]
    pub fn is_vertical(&self) -> bool {
        self.x.is_zero() && self.y.is_zero()
    }
}

impl<T: Ring> Add<&Self> for Load<T> {
    type Output = Self;

    fn add(self, other: &Self) -> Self {
        Self {
            down: self.down + &other.down,
            x: self.x + &other.x,
            y: self.y + &other.y,
        }
    }
}

/// A vertical load.
impl<T: Ring> From<T> for Load<T> {
    fn from(down: T) -> Self {
        Self {
            down,
            x: T::zero(),
            y: T::zero(),
        }
    }
}

impl<T: fmt::Display + Ring> fmt::Display for Load<T> {
    /// Prints `2` for a vertical load, and `(2, 1/4, 0)` for any other.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [down, x, y] = [&self.down, &self.x, &self.y].each(|component| part(f, component));
        if self.is_vertical() {
            padded(f, format_args!("{down}"))
        } else {
            padded(f, format_args!("({down}, {x}, {y})"))
        }
    }
}
