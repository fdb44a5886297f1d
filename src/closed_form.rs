//! The paper's formulas, each once, generic over the scalar. No validation, no I/O.
//!
//! A sphere that stands on d others shares its weight among d lines of contacts, and every line just
//! counts up: a sphere with N spheres above it on a line receives N increments along that line and
//! passes N+1 on. One [`Increments`] says how much a sphere adds, one body covers the general
//! azimuth φ, the equilateral base, and d dimensions:
//!
//! | pile | increments | their sum W |
//! |---|---|---|
//! | equilateral, d = 3 | (1, 1, 1) | 3 |
//! | isosceles, s = sin φ | (1, 1, 2s) | 2(1+s) |
//! | d dimensions | (1, …, 1) | d |
//!
//! They are numbers in the unit f₀ = mg/(W cosθ) — mg/(3 cosθ) on an equilateral base — so that every
//! formula is a polynomial in s and the counts; the one division by W stays with whoever wants mg.
//! [`count::above`](crate::lattice::count::above) gives the counts of a site.

use core::array;

use crate::geometry::Vector;
use crate::scalar::Ring;

/// What a sphere adds to each of its D lines of contacts, in f₀ = mg/(W cosθ).
///
/// Paper, eqs. (Δα, Δβ, Δγ) with the common denominator W taken out.
#[derive(Clone, Debug, PartialEq)]
pub struct Increments<T, const D: usize> {
    per_line: [T; D],
    sum: T,
}

impl<T: Ring> Increments<T, 3> {
    /// (1, 1, 2s) on an isosceles base with s = sin φ, 0 < s < 1; s = ½ is the equilateral one, and
    /// s = 0 a pile of discs, whose γ lines carry nothing.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    ///
    /// let increments = Increments::isosceles(&0.25);
    /// assert_eq!(increments.per_line(), &[1.0, 1.0, 0.5]);
    /// assert_eq!(increments.sum(), &2.5);
    /// ```
    pub fn isosceles(s: &T) -> Self {
        Self::new([T::one(), T::one(), s.clone() + s])
    }
}

impl<T: Ring, const D: usize> Increments<T, D> {
    /// Any increments, such as integer numerators of these.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    /// use num_bigint::BigInt;
    ///
    /// // (1, 1, 2s) with s = 1/5, over 5.
    /// let increments = Increments::new([5, 5, 2].map(BigInt::from));
    /// assert_eq!(increments.sum(), &BigInt::from(12));
    /// assert_eq!(increments.from_above(&[1, 0, 3].map(BigInt::from)), [5, 0, 6].map(BigInt::from));
    /// ```
    #[must_use]
    pub fn new(per_line: [T; D]) -> Self {
        let sum = per_line.iter().fold(T::zero(), |sum, w| sum + w);
        Self { per_line, sum }
    }

    /// (1, …, 1) in D dimensions, D contacts below each sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    ///
    /// assert_eq!(Increments::<f64, 3>::regular(), Increments::isosceles(&0.5));
    /// assert_eq!(Increments::<f64, 2>::regular().sum(), &2.0);
    /// ```
    #[must_use]
    pub fn regular() -> Self {
        Self::new(array::from_fn(|_| T::one()))
    }

    /// What a sphere adds, by direction.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    /// use cannonpile::lattice::Direction;
    ///
    /// let increments = Increments::isosceles(&0.25);
    /// assert_eq!(increments.per_line()[Direction::Gamma.index()], 0.5);
    /// ```
    #[must_use]
    pub fn per_line(&self) -> &[T; D] {
        &self.per_line
    }

    /// W, the sum over the lines: a weight mg is W in the unit mg/W.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    ///
    /// // 2(1+s), and the number of contacts below a sphere.
    /// assert_eq!(Increments::isosceles(&0.25).sum(), &2.5);
    /// assert_eq!(Increments::<f64, 4>::regular().sum(), &4.0);
    /// ```
    #[must_use]
    pub fn sum(&self) -> &T {
        &self.sum
    }

    /// The force of a contact with `n` spheres above its lower end on the line, in f₀: n w_m.
    ///
    /// Paper, eq. (forces1). A sphere receives N w_m from above and passes (N+1) w_m on below; zero past
    /// the last line.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    ///
    /// let increments = Increments::isosceles(&0.25);
    /// assert_eq!(increments.force(3.0, 2), 1.5);
    /// ```
    #[must_use]
    pub fn force(&self, n: T, line: usize) -> T {
        self.per_line.get(line).map_or_else(T::zero, |w| n * w)
    }

    /// The force from the sphere above, by direction, in f₀: N_m w_m.
    ///
    /// Paper, eq. (forces2): (k−i−j, i, j) on an equilateral base. Zero at the surface.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    ///
    /// let increments = Increments::isosceles(&0.25);
    /// assert_eq!(increments.from_above(&[3.0, 0.0, 2.0]), [3.0, 0.0, 1.0]);
    /// ```
    #[must_use]
    pub fn from_above(&self, above: &[T; D]) -> [T; D] {
        array::from_fn(|m| self.force(above[m].clone(), m))
    }

    /// The force to the sphere below, by direction, in f₀: (N_m + 1) w_m, one increment more.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    ///
    /// let increments = Increments::isosceles(&0.25);
    /// assert_eq!(increments.to_below(&[3.0, 0.0, 2.0]), [4.0, 1.0, 1.5]);
    /// ```
    #[must_use]
    pub fn to_below(&self, above: &[T; D]) -> [T; D] {
        array::from_fn(|m| self.force(above[m].clone() + &T::one(), m))
    }

    /// The weight that passes through a sphere, its own included, in mg/W: Σ N_m w_m + W.
    ///
    /// Of a sphere on the floor this is the normal force on the base. Divided by W it is
    /// mg(L+2)/3 on an equilateral base (paper, eq. (result-normal)), mg(L+d−1)/d in d dimensions and
    /// mg[1 + ((L−1−j) + 2sj)/(2(1+s))] on an isosceles one.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::closed_form::Increments;
    ///
    /// // 10 layers: (10 + 2)/3 = 4 mg under every sphere of the base.
    /// let increments = Increments::isosceles(&0.5);
    /// assert_eq!(increments.carried(&[4.0, 3.0, 2.0]) / increments.sum(), 4.0);
    /// ```
    #[must_use]
    pub fn carried(&self, above: &[T; D]) -> T {
        self.from_above(above)
            .iter()
            .fold(self.sum.clone(), |sum, f| sum + f)
    }
}

/// The sum of forces from above on a sphere, each along its direction: −Σ g_m ê_m.
///
/// # Examples
/// ```
/// use cannonpile::closed_form::resultant;
/// use cannonpile::geometry::{Vector, directions};
///
/// let force = resultant(&[1.0, 1.0, 1.0], &directions(&0.5));
/// assert_eq!(force, Vector { x: 0.0, y: 0.0, z: 3.0 });
/// ```
pub fn resultant<T: Ring>(from_above: &[T; 3], directions: &[Vector<T>; 3]) -> Vector<T> {
    -Vector::combination(from_above, directions)
}

/// What a sphere hands on: the forces from above and its weight, −Σ g_m ê_m + w ẑ.
///
/// # Examples
/// ```
/// use cannonpile::closed_form::handed_on;
/// use cannonpile::geometry::{Vector, directions};
///
/// let force = handed_on(&[1.0, 1.0, 1.0], &directions(&0.5), &3.0);
/// assert_eq!(force, Vector { x: 0.0, y: 0.0, z: 6.0 });
/// ```
pub fn handed_on<T: Ring>(
    from_above: &[T; 3],
    directions: &[Vector<T>; 3],
    weight: &T,
) -> Vector<T> {
    let weight = Vector {
        x: T::zero(),
        y: T::zero(),
        z: weight.clone(),
    };
    resultant(from_above, directions) + &weight
}

/// The sum of the forces from above on a sphere, in f₀ and the symbolic basis: −Σ N_m w_m ê_m.
///
/// On an equilateral base this is r/(2R), with r the position from the apex: the central force
/// mg/(6R cosθ)·r (THEORY §2). Exact in exact scalars.
///
/// # Examples
/// ```
/// use cannonpile::closed_form::{Increments, resultant_above};
/// use cannonpile::geometry::{directions, position};
///
/// let (above, e) = ([1.0, 2.0, 0.0], directions(&0.5));
/// let force = resultant_above(&above, &Increments::isosceles(&0.5), &e);
/// assert_eq!(force, position(&above, &e));
/// ```
pub fn resultant_above<T: Ring>(
    above: &[T; 3],
    increments: &Increments<T, 3>,
    directions: &[Vector<T>; 3],
) -> Vector<T> {
    resultant(&increments.from_above(above), directions)
}

/// The force of a bottom sphere on the floor, in f₀ and the symbolic basis: the resultant from above
/// and the weight, F_s = a′ + b′ + c′ + w.
///
/// `weight` is w in the same unit, [`Increments::sum`]; times the scale of the directions, if they are
/// integer numerators.
///
/// Paper, eq. (F_s): f₀·(−(L−1−3j)/2·sinθ, −√3/2·(L−1−2i−j)·sinθ, (L+2)·cosθ) on an equilateral base;
/// with y in units of √3·sinθ its coefficient is −(L−1−2i−j)/2. Exact in exact scalars.
///
/// # Examples
/// ```
/// use cannonpile::closed_form::{Increments, force_on_floor};
/// use cannonpile::geometry::{Vector, directions};
/// use cannonpile::lattice::count;
///
/// // The corner i = j = 0 of 10 layers, k = 9.
/// let above = count::above(&0.0, &0.0, &9.0);
/// let force = force_on_floor(&above, &Increments::isosceles(&0.5), &directions(&0.5), &3.0);
/// assert_eq!(force, Vector { x: -4.5, y: -4.5, z: 12.0 });
/// ```
pub fn force_on_floor<T: Ring>(
    above: &[T; 3],
    increments: &Increments<T, 3>,
    directions: &[Vector<T>; 3],
    weight: &T,
) -> Vector<T> {
    handed_on(&increments.from_above(above), directions, weight)
}

/// What is left over of all forces on a sphere that stands on others, in f₀: the zero vector.
///
/// The supports push with (N_m+1)w_m ê_m, the spheres above with −N_m w_m ê_m, and there is the
/// weight: the paper's equilibrium equation with the terms a′ + b′ + c′ that it leaves out. `weight` is as
/// for [`force_on_floor`].
///
/// # Examples
/// ```
/// use cannonpile::closed_form::{Increments, unbalanced};
/// use cannonpile::geometry::{Vector, directions};
///
/// let left = unbalanced(&[1.0, 2.0, 3.0], &Increments::isosceles(&0.5), &directions(&0.5), &3.0);
/// assert_eq!(left, Vector::zero());
/// ```
pub fn unbalanced<T: Ring>(
    above: &[T; 3],
    increments: &Increments<T, 3>,
    directions: &[Vector<T>; 3],
    weight: &T,
) -> Vector<T> {
    let supports = Vector::combination(&increments.to_below(above), directions);
    supports + &force_on_floor(above, increments, directions, weight)
}

/// The greatest ratio of shear to normal force that one line can cause on the base, in tanθ, as
/// numerator and denominator: ((L−1)w_m, (L−1)w_m + W), at the corner where the line m ends.
///
/// On an equilateral base (L−1)/(L+2), at all three corners (THEORY §2). The ratio is the norm of a
/// linear function over a positive linear one, so its maximum over the base lies at a corner.
///
/// # Examples
/// ```
/// use cannonpile::closed_form::{Increments, corner_shear_ratio};
///
/// let increments = Increments::<f64, 3>::regular();
/// assert_eq!(corner_shear_ratio(&10.0, &increments, 0), (9.0, 12.0));
/// ```
pub fn corner_shear_ratio<T: Ring, const D: usize>(
    layers: &T,
    increments: &Increments<T, D>,
    line: usize,
) -> (T, T) {
    let above: [T; D] = array::from_fn(|m| {
        if m == line {
            layers.clone() - &T::one()
        } else {
            T::zero()
        }
    });
    let shear = increments
        .from_above(&above)
        .iter()
        .fold(T::zero(), |sum, f| sum + f);
    (shear, increments.carried(&above))
}
