//! The equations of the paper, with their printed numbers, generic over the scalar or its numerators.
//!
//! Each equation is implemented once. The engines call these functions with integers, floats, bounds and limbs. The
//! proofs of [`theorem`](crate::theorem) and of the crate `cannonpile-proof` evaluate them on polynomials. So the
//! theorems hold for the code that computes the forces. All equations and the mathematics behind them are in
//! [`paper`](crate::paper).
//!
//! The weight of a sphere with d supports is shared among d lines of contacts. The force on a line grows by one
//! increment per sphere. A sphere with N spheres above it on a line receives N increments along that line and transmits
//! N + 1.
//!
//! | printed | content | function |
//! |---|---|---|
//! | (1) | unit vectors along the contacts | [`geometry::directions`](crate::geometry::directions) |
//! | (3) | equilibrium of a sphere | [`unbalanced`] |
//! | (5) | the sum of the increments is the weight | [`weight`] |
//! | (6), (7) | increments of one sphere | [`increments`] |
//! | (8) | force after N spheres of a line | [`force`] |
//! | (9) | N, in the paper's pile and in any other | [`count::above`](crate::lattice::count::above), [`count::bounds_above`](crate::lattice::count::bounds_above) |
//! | (10) | forces from above, and what a sphere adds to them | [`force`], [`transmitted`] |
//! | (11)–(14) | force on the floor | [`support_load`] |
//! | | transfer across a sign change, not in the paper | [`half_turn`], [`tripled_half_turn`], [`tripled_apart`] |
//! | | horizontal contacts, not in the paper | [`pushed`], [`beside`] |
//! | | loads of any direction, not in the paper | [`load_increments`], [`disc_load_increments`] |
//!
//! | pile | increments | their sum W |
//! |---|---|---|
//! | equilateral, d = 3 | (1, 1, 1) | 3 |
//! | isosceles, s = sin φ | (1, 1, 2s) | 2(1+s) |
//! | discs, d = 2 | (1, 1) | 2 |
//!
//! The increments are in units of f₀ = mg/(W cosθ), which is mg/(3 cosθ) on an equilateral base. In this unit every
//! formula is a polynomial in s and the counts. Division by W converts to mg.

mod horizontal;
mod load;
mod turn;

pub use horizontal::{beside, pushed};
pub use load::{disc_load_increments, load_increments};
pub use turn::half_turn;

pub use crate::scalar::turn::{tripled_apart, tripled_half_turn};

use core::ops::Add;

use crate::geometry::Vector;
use crate::scalar::Ring;

/// Returns the increments that a sphere adds to its three lines of contacts, in f₀: (1, 1, 2s), where s = sin φ and 0 <
/// s < 1.
///
/// This is (6) of the paper, whose denominator 2(1+s)cosθ is part of f₀. For s = ½ it is (7). At s = 0 the γ lines
/// carry no force, as in the pile of discs.
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

/// Returns W, the sum of the increments. It is the weight mg of a sphere in units of f₀ cosθ = mg/W.
///
/// This is the third equation of (5) in the paper: Δα + Δβ + Δγ = mg/cosθ. In any dimension each line has one
/// increment.
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

/// Returns the force that `n` spheres on a line add to it: n·w in f₀, where w is the increment of each sphere.
///
/// This is (8) of the paper: α′ = N_α Δα. Since w is the increment of a sphere of weight mg, n may also be a weight in
/// mg.
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

/// Returns the force on a line below one or several spheres: `received` + `own`. `received` is the force from above on
/// this line, and `own` is the increment of the spheres. Both have the same unit.
///
/// These are (4) and (5) of the paper: α = α′ + Δα. A load on a sphere is transmitted in the same way as its weight.
///
/// # Examples
/// ```
/// use cannonpile::formula::{force, increments, transmitted};
///
/// // N + 1 = 4 increments below a sphere with N = 3 above it on its line γ.
/// let [_, _, w] = increments(&0.25);
/// assert_eq!(transmitted(force(3.0, &w), &w), force(4.0, &w));
/// ```
#[must_use]
#[inline]
pub fn transmitted<T: for<'a> Add<&'a T, Output = T>>(received: T, own: &T) -> T {
    received + own
}

/// Returns the resultant of the forces from above on a sphere: a′ + b′ + c′ = −(α′ê_a + β′ê_b + γ′ê_c).
///
/// See (1) of the paper. `from_above` contains α′, β′, γ′ in any unit of force. The result has the same unit and the
/// basis of `directions`.
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

/// Returns the force F_s = a′ + b′ + c′ + w of a sphere on its supports or on the floor: the forces from above plus its
/// weight.
///
/// This is (11) of the paper, and with (10) it is (12). Its vertical part over W is the normal force on the floor (13),
/// and its horizontal part over W is the shear (14). `weight` is w in the unit of the forces. In f₀ this is [`weight`],
/// times the scale of the directions if they are integer numerators.
///
/// # Examples
/// ```
/// use cannonpile::formula::support_load;
/// use cannonpile::geometry::{directions, Vector};
///
/// // The corner of the base of 10 layers, with 9 spheres above it on one line: (10 + 2)/3 mg.
/// let force = support_load(&[9.0, 0.0, 0.0], &directions(&0.5), &3.0);
/// assert_eq!(force, Vector { x: -4.5, y: -4.5, z: 12.0 });
/// ```
#[must_use]
pub fn support_load<T: Ring>(
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

/// Returns the resultant of all forces on a sphere with supports. It is zero in equilibrium.
///
/// This is (3) of the paper, with the terms a′ + b′ + c′ that are missing in print. The supports act with `to_below`
/// along the directions `below`, and the spheres above with `from_above` along the directions `above`. `weight` is as
/// for [`support_load`]. The two sets of directions differ at a sign change.
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
    Vector::combination(to_below, below) + &support_load(from_above, above, weight)
}
