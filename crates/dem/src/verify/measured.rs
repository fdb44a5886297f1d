//! The measured force between two spheres.

use contact_tables::{Contact, Force};

use super::refusal::Fault;
use crate::Each;
use crate::vector::plus;

/// The maximum number of entries that are read, and of contacts in a pile that are compared.
pub const MAX_ENTRIES: u64 = 100_000_000;

/// A measured force between two spheres.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::Measured;
///
/// let push = Measured::new([1, 4], 2.0).with_vector([-1.2, 0.0, 1.6]);
/// assert_eq!(push.reversed(), Measured::new([4, 1], 2.0).with_vector([1.2, 0.0, -1.6]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The numbers of the two spheres, from 1.
    pub ids: [u64; 2],
    /// The force along the line between their centres; compressive forces are positive.
    pub force: f64,
    /// The force on the first sphere, with z upwards, if it was measured.
    pub vector: Option<[f64; 3]>,
    /// The tangential force on the first sphere, if the table lists it besides the normal force `vector`.
    pub tangential: Option<[f64; 3]>,
    /// True if `force` is the length of the vector, and was not measured itself.
    pub is_length: bool,
}

impl Measured {
    /// Returns a measurement of the magnitude only.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Measured;
    ///
    /// let pull = Measured::new([1, 4], -2.0);
    /// assert_eq!((pull.ids, pull.force, pull.vector), ([1, 4], -2.0, None));
    /// ```
    #[must_use]
    pub const fn new(ids: [u64; 2], force: f64) -> Self {
        Self {
            ids,
            force,
            vector: None,
            tangential: None,
            is_length: false,
        }
    }

    /// Returns a measurement of the vector on the first sphere. The force is tensile if it pulls the upper sphere down,
    /// and compressive otherwise. The upper sphere has the smaller number.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Measured;
    ///
    /// assert_eq!(Measured::of_vector([1, 4], [3.0, 0.0, 4.0]).force, 5.0);
    /// assert_eq!(Measured::of_vector([4, 1], [3.0, 0.0, 4.0]).force, -5.0);
    /// ```
    #[must_use]
    pub fn of_vector(ids: [u64; 2], vector: [f64; 3]) -> Self {
        let ([first, second], [_, _, z]) = (ids, vector);
        let upwards = if first < second { z } else { -z };
        let force = if upwards < 0.0 {
            -norm(vector)
        } else {
            norm(vector)
        };
        let measured = Self::new(ids, force).with_vector(vector);
        Self {
            is_length: true,
            ..measured
        }
    }

    /// Adds the vector of the force on the first sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Measured;
    ///
    /// // The magnitude keeps its measured value, even if it disagrees with the vector.
    /// let turned = Measured::new([1, 4], 2.0).with_vector([0.0, 0.0, 2.5]);
    /// assert_eq!((turned.force, turned.vector), (2.0, Some([0.0, 0.0, 2.5])));
    /// ```
    #[must_use]
    pub const fn with_vector(mut self, vector: [f64; 3]) -> Self {
        self.vector = Some(vector);
        self
    }

    /// Adds the tangential force on the first sphere. The vector is then the normal force only.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Measured;
    ///
    /// let normal = Measured::of_vector([1, 4], [-1.2, 0.0, 1.6]);
    /// let rubbing = normal.with_tangential([0.4, 0.0, 0.3]);
    /// assert_eq!(rubbing.reversed().tangential, Some([-0.4, 0.0, -0.3]));
    /// ```
    #[must_use]
    pub const fn with_tangential(mut self, vector: [f64; 3]) -> Self {
        self.tangential = Some(vector);
        self
    }

    /// Returns this measurement with its two spheres swapped. The vector then acts on the other sphere, so it changes
    /// its sign.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Measured;
    ///
    /// let pull = Measured::new([1, 4], -2.0).with_vector([1.2, 0.0, -1.6]);
    /// // A tensile force is tensile for both spheres.
    /// assert_eq!((pull.reversed().ids, pull.reversed().force), ([4, 1], -2.0));
    /// assert_eq!(pull.reversed().reversed(), pull);
    /// ```
    #[must_use]
    pub fn reversed(self) -> Self {
        let [first, second] = self.ids;
        Self {
            ids: [second, first],
            vector: self.vector.map(opposite),
            tangential: self.tangential.map(opposite),
            ..self
        }
    }

    /// Returns the force of a row between two numbered spheres. A vector acts on the first.
    pub(super) fn of(ids: [u64; 2], row: &Contact) -> Self {
        Self {
            tangential: row.tangential,
            ..Self::between(ids, row.force)
        }
    }

    /// Returns a force between two numbered spheres. A vector acts on the first.
    pub(super) fn between(ids: [u64; 2], force: Force) -> Self {
        match force {
            Force::Along(force) => Self::new(ids, force),
            Force::Vector(vector) => Self::of_vector(ids, vector),
            Force::Both(force, vector) => Self::new(ids, force).with_vector(vector),
        }
    }

    /// Returns the force on the first sphere.
    pub(super) fn on_first(&self) -> Force {
        match self.vector {
            Some(vector) => Force::Both(self.force, vector),
            None => Force::Along(self.force),
        }
    }

    /// Returns the greater of |f − g| and |**F** − **G**|, for another measurement of the same pair.
    pub(super) fn difference(&self, other: &Self) -> f64 {
        let vectors = [
            self.vector.zip(other.vector),
            self.tangential.zip(other.tangential),
        ];
        let apart = vectors.into_iter().flatten();
        let apart = apart.map(|(one, other)| distance(one, other));
        apart.fold((self.force - other.force).abs(), f64::max)
    }

    /// Returns the sum of two shares of one force.
    pub(super) fn plus(&self, other: &Self) -> Self {
        let sum = |one: Option<[f64; 3]>, other: Option<[f64; 3]>| {
            one.zip(other).map(|(one, other)| plus(one, other))
        };
        Self {
            force: self.force + other.force,
            vector: sum(self.vector, other.vector),
            tangential: sum(self.tangential, other.tangential),
            ..*self
        }
    }

    /// Returns whether the force and the vector are 0.
    pub(super) fn is_zero(&self) -> bool {
        self.magnitude() == 0.0
    }

    /// Returns the greatest of the magnitude and the lengths of the vectors.
    pub(super) fn magnitude(&self) -> f64 {
        let vectors = [self.vector, self.tangential].into_iter().flatten();
        vectors.map(norm).fold(self.force.abs(), f64::max)
    }
}

/// Returns the whole force of a contact with a floor or a wall: the sum of the normal and the tangential vector.
pub(super) fn whole(force: Force, tangential: Option<[f64; 3]>) -> Force {
    match tangential {
        Some(tangential) => force.map(|normal| plus(normal, tangential)),
        None => force,
    }
}

/// Refuses a force that is infinite or NaN.
pub(super) fn refuse_infinite(force: Force) -> Result<(), Fault> {
    let (along, vector) = force.parts();
    let [x, y, z] = vector.unwrap_or_default();
    let numbers = [
        ("force", along.unwrap_or(0.0)),
        ("fx", x),
        ("fy", y),
        ("fz", z),
    ];
    match numbers.into_iter().find(|(_, x)| !x.is_finite()) {
        Some((column, value)) => Err(Fault::NotFinite { column, value }),
        None => Ok(()),
    }
}

/// Returns the largest absolute value among the magnitude and the components of the vector.
pub(super) fn magnitude(force: Force) -> f64 {
    let (along, vector) = force.parts();
    let numbers = vector.into_iter().flatten().chain(along);
    numbers.fold(0.0, |most, x| most.max(x.abs()))
}

/// Returns how many numbers exceed a limit, in a list in decreasing order.
pub(super) fn over(sorted: &[f64], limit: f64) -> u64 {
    sorted.partition_point(|number| *number > limit) as u64
}

/// Returns −v, with 0 instead of −0.
pub(super) fn opposite(vector: [f64; 3]) -> [f64; 3] {
    vector.each(|x| 0.0 - x)
}

/// Returns a difference relative to a force. Only a difference of 0 gives 0. A difference of infinite sums, which is unknown,
/// is infinite.
pub(super) fn relative(difference: f64, force: f64) -> f64 {
    let share = difference / force;
    if difference == 0.0 {
        0.0
    } else if share.is_nan() {
        f64::INFINITY
    } else {
        share.max(f64::from_bits(1))
    }
}

/// Sorts errors. All callers share this code.
pub(super) fn sort_decreasing(errors: &mut [f64]) {
    errors.sort_unstable_by(|a, b| b.total_cmp(a));
}

/// Returns |a − b|.
pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [[x, y, z], [u, v, w]] = [a, b];
    norm([x - u, y - v, z - w])
}

/// Returns √(x² + y² + z²), without overflow or underflow of the squares. NaN if a component is.
pub(super) fn norm(vector: [f64; 3]) -> f64 {
    if vector.iter().any(|x| x.is_nan()) {
        return f64::NAN;
    }
    let scale = vector.iter().fold(0.0, |scale: f64, x| scale.max(x.abs()));
    if scale == 0.0 || !scale.is_finite() {
        return scale;
    }
    let squares = vector.each(|x| (x / scale) * (x / scale));
    scale * squares.iter().sum::<f64>().sqrt()
}
