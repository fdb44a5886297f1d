//! Faults in the forces on the floor.

use cannonpile::geometry::Vector;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::parts::{Fault, P, RIGHT, faults, sum, twice};

/// The force on the floor with one changed component.
macro_rules! force {
    (|$force:ident, $above:ident| $($component:ident = $wrong:expr),+) => {
        |$above, directions, weight| {
            let $force = (RIGHT.support_load)($above, directions, weight);
            Vector { $($component: $wrong,)+ ..$force }
        }
    };
}

/// A load with zero sum and zero moments that presses towards the middle of a layer.
fn squeeze(above: &[P; 3]) -> P {
    let k = sum(above);
    let squares = above
        .iter()
        .fold(P::zero(), |sum, n| sum + &(n.clone() * n));
    twice(&squares) - &(k.clone() * &k) - &k
}

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "the bottom layer's weight left out": support_load = |from_above, directions, _| {
            (RIGHT.resultant)(from_above, directions)
        } => ["equilibrium", "base-normal", "weight", "total-moment", "second-moment", "shear-ratio", "discs",
                "tilt-total", "rough-floor"];
        "the shear reversed": support_load = force!(|f, above| x = -f.x, y = -f.y)
            => ["equilibrium", "shear", "shear-on-axis", "discs", "tilt-total", "rough-floor"];
        "the shear rotated by 90°": support_load = force!(|f, above| x = -f.y, y = f.x)
            => ["equilibrium", "shear", "total-moment", "shear-on-axis", "shear-ratio", "discs", "tilt-total",
                "rough-floor"];
        "twice the shear": support_load = force!(|f, above| x = twice(&f.x), y = twice(&f.y))
            => ["equilibrium", "shear", "shear-on-axis", "shear-ratio", "discs", "tilt-total", "rough-floor"];
        "a constant shear along x": support_load = force!(|f, above| x = f.x + &P::one())
            => ["equilibrium", "shear", "total-shear", "shear-on-axis", "shear-ratio", "discs", "tilt-total",
                "rough-floor"];
        "a constant shear along y": support_load = force!(|f, above| y = f.y + &P::one())
            => ["equilibrium", "shear", "total-shear", "total-moment", "shear-on-axis", "shear-ratio", "discs",
                "tilt-total", "rough-floor"];
        "load shifted from γ to α": support_load = force!(|f, above| z = f.z + &above[0] - &above[2])
            => ["equilibrium", "base-normal", "uniform-base", "weight", "total-moment", "second-moment",
                "shear-ratio", "discs", "tilt-total", "rough-floor"];
        "load shifted from the rim to the middle": support_load = force!(|f, above| z = f.z + &squeeze(above))
            => ["equilibrium", "base-normal", "uniform-base", "weight", "total-moment", "second-moment",
                "shear-ratio", "discs", "tilt-total", "rough-floor"];
    }
}
