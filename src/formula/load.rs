//! The increments of a sphere with a load of any direction.

use super::horizontal::signed;
use crate::each::Each;
use crate::geometry::Load;
use crate::lattice::Sign;
use crate::scalar::Ring;

/// Returns what a sphere with a load adds to its three lines, in f₀: (w − σ(X + WY), w − σ(X − WY), 2(sw + σX)).
///
/// Here w, X and Y are the components of the load, W = 2(1+s), and σ is the sign of the step below the sphere. For the
/// load (1, 0, 0) these are the [`increments`](super::increments). The forces balance the load: this is (5) of the
/// paper with a horizontal force.
///
/// # Examples
/// ```
/// use cannonpile::Load;
/// use cannonpile::formula::load_increments;
/// use cannonpile::lattice::Sign;
///
/// let load = Load { down: 1.0, x: 0.25, y: 0.0 };
/// assert_eq!(load_increments(&load, &0.5, Sign::Plus), [0.75, 0.75, 1.5]);
/// assert_eq!(load_increments(&load, &0.5, Sign::Minus), [1.25, 1.25, 0.5]);
/// ```
#[must_use]
pub fn load_increments<T: Ring>(load: &Load<T>, s: &T, sign: Sign) -> [T; 3] {
    let [x, y] = [&load.x, &load.y].each(|part| signed(part.clone(), sign));
    let half_sum = T::one() + s;
    let y = y * &(half_sum.clone() + &half_sum);
    let less_x = load.down.clone() - &x;
    let along = s.clone() * &load.down + &x;
    [less_x.clone() - &y, less_x + &y, along.clone() + &along]
}

/// Returns what a disc with a load adds to its lines, in f₀: (w − σX, w + σX, 0).
///
/// # Examples
/// ```
/// use cannonpile::Load;
/// use cannonpile::formula::disc_load_increments;
/// use cannonpile::lattice::Sign;
///
/// let load = Load { down: 1.0, x: 0.25, y: 0.0 };
/// assert_eq!(disc_load_increments(&load, Sign::Plus), [0.75, 1.25, 0.0]);
/// ```
#[must_use]
pub fn disc_load_increments<T: Ring>(load: &Load<T>, sign: Sign) -> [T; 3] {
    let x = signed(load.x.clone(), sign);
    [load.down.clone() - &x, load.down.clone() + &x, T::zero()]
}
