//! Other ways to the same forces: what one would do who does not know the closed formulas.
//!
//! They see a pile through the public interface, as spheres at places that touch, and know nothing of lines, half-turns
//! or multiples of f₀: their answers are forces in mg, for spheres of a/R = 6/5. That makes them independent
//! of what they are compared with.

pub(crate) mod equations;
pub(crate) mod iterative;
pub(crate) mod lu;
pub(crate) mod network;
pub(crate) mod springs;

use cannonpile::Pile;
use cannonpile::geometry::{Inclination, Spacing};
use cannonpile::lattice::Dimension;
use cannonpile::scalar::Algebra;
use num_rational::BigRational;

/// θ at a/R = 6/5, where horizontal neighbours do not touch.
pub(crate) fn inclination() -> Inclination {
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).expect("a spacing");
    Inclination::new(&spacing, Dimension::Three).expect("an inclination")
}

/// (sinθ, 2cosφ·sinθ, cosθ): what the symbolic basis of vectors stands for.
fn basis(pile: &Pile) -> [f64; 3] {
    let inclination = inclination();
    let [sin, cos] =
        [inclination.sin(), inclination.cos()].map(|root| root.nearest().expect("a float"));
    let sin_phi = f64::from_rational(pile.sin_phi());
    [sin, 2.0 * (1.0 - sin_phi * sin_phi).sqrt() * sin, cos]
}
