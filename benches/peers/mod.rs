//! Other methods that compute the same forces without the closed form.
//!
//! They use the public interface of a pile only: positions of spheres, and contacts. They do not use contact lines,
//! half-turns or multiples of f₀, so they are independent of the library. Their forces are in mg, for a/R = 6/5.

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

/// Returns θ at a/R = 6/5, where horizontal neighbours do not touch.
pub(crate) fn inclination() -> Inclination {
    let spacing = Spacing::new(BigRational::new(6.into(), 5.into())).expect("a spacing");
    Inclination::new(&spacing, Dimension::Three).expect("an inclination")
}

/// Returns (sinθ, 2cosφ·sinθ, cosθ), the values of the symbolic basis of vectors.
fn basis(pile: &Pile) -> [f64; 3] {
    let inclination = inclination();
    let [sin, cos] =
        [inclination.sin(), inclination.cos()].map(|root| root.nearest().expect("a float"));
    let sin_phi = f64::from_rational(pile.sin_phi());
    [sin, 2.0 * (1.0 - sin_phi * sin_phi).sqrt() * sin, cos]
}
