//! Horizontal contacts, at a = R, in the equilibrium of a sphere.

use super::transmitted;
use crate::lattice::{Direction, Sign};
use crate::scalar::Ring;

/// Returns the contribution of a horizontal contact to H, which shifts force between the three lines below a sphere.
///
/// A contact between p and p + d_b − d_a with force X contributes −X on a and +X on b to H of the sphere p. To H of the
/// other sphere it contributes the opposite. `ends` contains a and b, and `leads_away` is true for p. Forces are in f₀.
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

/// Returns the force on a line below a sphere with horizontal contacts, in f₀: f = g + w − σH.
///
/// `received` is g, after the [half-turn](super::half_turn) at a sign change, and `own` is w. `pushed` is H, the sum of
/// the [contributions](pushed) of the contacts, and σ is the sign of the step below. All forces are in f₀.
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
    transmitted(received, own) - &signed(pushed.clone(), sign)
}

/// Returns σx.
pub(super) fn signed<T: Ring>(x: T, sign: Sign) -> T {
    match sign {
        Sign::Plus => x,
        Sign::Minus => -x,
    }
}
