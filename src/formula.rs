//! The equations of the paper, each once, under its printed number; generic over the scalar, or the ring of its numerators.
//!
//! Whoever computes a force calls these functions, and no other body computes one: the engines with integers, floats,
//! bounds and limbs, [`theorem`](crate::theorem) with polynomials. So what is proved is what answers. All equations
//! and the mathematics behind them are in [`paper`](crate::paper).
//!
//! A sphere that stands on d others shares its weight among d lines of contacts, and every line just counts up: a
//! sphere with N spheres above it on a line receives N increments along that line, and passes N + 1 of them on.
//!
//! | printed | what | function |
//! |---|---|---|
//! | (1) | unit vectors along the contacts | [`geometry::directions`](crate::geometry::directions) |
//! | (3) | equilibrium of a sphere | [`unbalanced`] |
//! | (5) | Σ of the increments is the weight | [`weight`] |
//! | (6), (7) | increments of one sphere | [`increments`] |
//! | (8) | force after N spheres of a line | [`force`] |
//! | (9) | N, on the paper's pile and any other | [`count::above`](crate::lattice::count::above), [`count::bounds_above`](crate::lattice::count::bounds_above) |
//! | (10) | force on a contact | [`passed_on`], from what [`force`] says of the spheres above |
//! | (11)–(14) | force on the floor | [`handed_on`] |
//! | | forces across a change of sign, which the paper's pile has not | [`half_turn`], [`tripled_half_turn`], [`tripled_apart`] |
//! | | horizontal contacts, which the paper leaves out | [`pushed`], [`beside`] |
//!
//! | pile | increments | their sum W |
//! |---|---|---|
//! | equilateral, d = 3 | (1, 1, 1) | 3 |
//! | isosceles, s = sin φ | (1, 1, 2s) | 2(1+s) |
//! | discs, d = 2 | (1, 1) | 2 |
//!
//! They are numbers in the unit f₀ = mg/(W cosθ), which is mg/(3 cosθ) on an equilateral base, so that every formula is
//! a polynomial in s and the counts. Who wants mg divides by W once.

mod horizontal;
mod turn;

pub use horizontal::{beside, pushed};
pub(crate) use turn::triples;
pub use turn::{half_turn, tripled_apart, tripled_half_turn};

use core::ops::Add;

use crate::geometry::Vector;
use crate::scalar::Ring;

/// Returns what a sphere adds to each of its three lines of contacts, in f₀: (1, 1, 2s), with s = sin φ, 0 < s < 1.
///
/// Paper, (6), with the denominator 2(1+s)cosθ in f₀; with s = ½ it is (7). At s = 0 the γ lines carry nothing: that is
/// the pile of discs.
///
/// # Examples
/// ```
/// use cannonpile::formula::increments;
///
/// assert_eq!(increments(&0.25), [1.0, 1.0, 0.5]);
/// ```
#[must_use]
pub fn increments<T: Ring>(s: &T) -> [T; 3] {
    [T::one(), T::one(), s.clone() + s]
}

/// Returns W, the sum of the increments: the weight of the sphere that adds them, in f₀ cosθ = mg/W.
///
/// Paper, (5), the third equation: Δα + Δβ + Δγ = mg/cosθ. There is one increment for each line, in any dimension.
///
/// # Examples
/// ```
/// use cannonpile::formula::{increments, weight};
///
/// // 2(1+s).
/// assert_eq!(weight(&increments(&0.25)), 2.5);
/// ```
#[must_use]
pub fn weight<T: Ring>(increments: &[T]) -> T {
    increments.iter().fold(T::zero(), |sum, w| sum + w)
}

/// Returns what `n` spheres on a line add to it, n·w in f₀, with w the increment of each.
///
/// Paper, (8): α′ = N_α Δα. As w = mg/W is the increment of a sphere of weight mg, n may be a weight in mg too.
///
/// # Examples
/// ```
/// use cannonpile::formula::force;
///
/// assert_eq!(force(3.0, &0.5), 1.5);
/// ```
#[must_use]
#[inline]
pub fn force<T: Ring>(n: T, increment: &T) -> T {
    n * increment
}

/// Returns what a line carries below a sphere, or several, that receives `received` on it and adds `own`: their sum.
///
/// Paper, (4) and (5): α = α′ + Δα. A load on a sphere is passed on as its weight is.
///
/// # Examples
/// ```
/// use cannonpile::formula::{force, increments, passed_on};
///
/// // N + 1 = 4 increments below a sphere with N = 3 above it on its line γ.
/// let [_, _, w] = increments(&0.25);
/// assert_eq!(passed_on(force(3.0, &w), &w), force(4.0, &w));
/// ```
#[must_use]
#[inline]
pub fn passed_on<T: for<'a> Add<&'a T, Output = T>>(received: T, own: &T) -> T {
    received + own
}

/// Returns the sum of the forces from above on a sphere, each along its direction: a′ + b′ + c′ = −(α′ê_a + β′ê_b + γ′ê_c).
///
/// Paper, (1): `from_above` are α′, β′, γ′ in any unit of force; the answer is in that unit, in the basis of `directions`.
///
/// # Examples
/// ```
/// use cannonpile::formula::resultant;
/// use cannonpile::geometry::{directions, Vector};
///
/// let force = resultant(&[1.0, 1.0, 1.0], &directions(&0.5));
/// assert_eq!(force, Vector { x: 0.0, y: 0.0, z: 3.0 });
/// ```
#[must_use]
pub fn resultant<T: Ring>(from_above: &[T; 3], directions: &[Vector<T>; 3]) -> Vector<T> {
    -Vector::combination(from_above, directions)
}

/// Returns what a sphere presses with on what it stands on, the forces from above and its weight: F_s = a′ + b′ + c′ + w.
///
/// Paper, (11); with (10) it is (12), whose vertical part over W is the normal force on the floor (13), and whose
/// horizontal part over W is the shear (14). `weight` is w in the unit of forces: [`weight`] in f₀, times the scale of
/// the directions if they are integer numerators.
///
/// # Examples
/// ```
/// use cannonpile::formula::handed_on;
/// use cannonpile::geometry::{directions, Vector};
///
/// // The corner of the base of 10 layers, with 9 spheres above it on one line: (10 + 2)/3 mg.
/// let force = handed_on(&[9.0, 0.0, 0.0], &directions(&0.5), &3.0);
/// assert_eq!(force, Vector { x: -4.5, y: -4.5, z: 12.0 });
/// ```
#[must_use]
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

/// Returns the sum of all forces on a sphere that stands on others: the zero vector in equilibrium.
///
/// Paper, (3), with the terms a′ + b′ + c′ that are missing there in print: the supports push with `to_below` along the
/// directions `below`, the spheres above with `from_above` along the directions `above`, and there is the weight, as for
/// [`handed_on`]. The two sets of directions differ where the stacking changes its sign.
///
/// # Examples
/// ```
/// use cannonpile::formula::unbalanced;
/// use cannonpile::geometry::{directions, Vector};
///
/// let e = directions(&0.5);
/// let left = unbalanced(&[2.0, 3.0, 4.0], &e, &[1.0, 2.0, 3.0], &e, &3.0);
/// assert_eq!(left, Vector::zero());
/// ```
#[must_use]
pub fn unbalanced<T: Ring>(
    to_below: &[T; 3],
    below: &[Vector<T>; 3],
    from_above: &[T; 3],
    above: &[Vector<T>; 3],
    weight: &T,
) -> Vector<T> {
    Vector::combination(to_below, below) + &handed_on(from_above, above, weight)
}
