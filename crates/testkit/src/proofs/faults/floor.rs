//! Forces on the floor that are wrong.

use cannonpile::geometry::Vector;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::{Fault, P, RIGHT, faults, sum, twice};

/// The force on the floor, with a part of it changed.
macro_rules! force {
    (|$force:ident, $above:ident| $($component:ident = $wrong:expr),+) => {
        |$above, directions, weight| {
            let $force = (RIGHT.handed_on)($above, directions, weight);
            Vector { $($component: $wrong,)+ ..$force }
        }
    };
}

/// A load that sums to nothing, balanced about both axes, but presses towards the middle of a layer.
fn squeeze(above: &[P; 3]) -> P {
    let k = sum(above);
    let squares = above
        .iter()
        .fold(P::zero(), |sum, n| sum + &(n.clone() * n));
    twice(&squares) - &(k.clone() * &k) - &k
}

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "the bottom layer's weight left out": handed_on = |from_above, directions, _| {
            (RIGHT.resultant)(from_above, directions)
        } => ["equilibrium", "base-normal", "weight", "total-moment", "second-moment", "shear-ratio",
              "discs"];
        "shear of the floor on the pile": handed_on = force!(|f, above| x = -f.x, y = -f.y)
            => ["equilibrium", "shear", "shear-on-axis", "discs"];
        "a swirl": handed_on = force!(|f, above| x = -f.y, y = f.x)
            => ["equilibrium", "shear", "total-moment", "shear-on-axis", "shear-ratio", "discs"];
        "twice the shear": handed_on = force!(|f, above| x = twice(&f.x), y = twice(&f.y))
            => ["equilibrium", "shear", "shear-on-axis", "shear-ratio", "discs"];
        "a push to one side": handed_on = force!(|f, above| x = f.x + &P::one())
            => ["equilibrium", "shear", "total-shear", "shear-on-axis", "shear-ratio", "discs"];
        "a push out of the plane of discs": handed_on = force!(|f, above| y = f.y + &P::one())
            => ["equilibrium", "shear", "total-shear", "total-moment", "shear-on-axis",
                "shear-ratio", "discs"];
        "load shifted from γ to α": handed_on = force!(|f, above| z = f.z + &above[0] - &above[2])
            => ["equilibrium", "base-normal", "uniform-base", "weight", "total-moment", "second-moment",
                "shear-ratio",
                "discs"];
        "load drawn in from the rim": handed_on = force!(|f, above| z = f.z + &squeeze(above))
            => ["equilibrium", "base-normal", "uniform-base", "weight", "total-moment", "second-moment",
                "shear-ratio",
                "discs"];
    }
}
