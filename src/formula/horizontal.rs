//! Horizontal contacts, at a = R: how they enter the balance of a sphere.

use super::passed_on;
use crate::lattice::{Direction, Sign};
use crate::scalar::Ring;

/// Returns how a horizontal contact of a sphere shifts force between the three lines below the sphere.
///
/// A contact of force X adds −X on a and +X on b to H of the sphere p if it leads away from p to p + d_b − d_a, and the
/// reverse if it leads here, from p − d_b + d_a. `ends` are a and b.
///
/// # Examples
/// ```
/// use cannonpile::formula::pushed;
/// use cannonpile::lattice::Axis;
///
/// assert_eq!(pushed(&2.0, Axis::AlphaGamma.ends(), true), [-2.0, 0.0, 2.0]);
/// ```
#[must_use]
pub fn pushed<T: Ring>(force: &T, ends: [Direction; 2], leads_away: bool) -> [T; 3] {
    let [a, b] = ends;
    let [from, to] = if leads_away { [a, b] } else { [b, a] };
    let mut entries = [T::zero(), T::zero(), T::zero()];
    entries[from.index()] = -force.clone();
    entries[to.index()] = force.clone();
    entries
}

/// Returns the force on a line below a sphere that horizontal contacts push, in f₀.
///
/// It is f = g + w − σH: `received` is g, after the [half-turn](super::half_turn) where the sign changes, `own` is w,
/// `pushed` the sum H of what [contacts push](pushed), and σ the sign of the step below. Horizontal forces are in f₀ too.
///
/// # Examples
/// ```
/// use cannonpile::formula::beside;
/// use cannonpile::lattice::Sign;
///
/// assert_eq!(beside(4.0, &1.0, &2.0, Sign::Minus), 7.0);
/// ```
#[must_use]
pub fn beside<T: Ring>(received: T, own: &T, pushed: &T, sign: Sign) -> T {
    passed_on(received, own) - &signed(pushed.clone(), sign)
}

fn signed<T: Ring>(x: T, sign: Sign) -> T {
    match sign {
        Sign::Plus => x,
        Sign::Minus => -x,
    }
}
