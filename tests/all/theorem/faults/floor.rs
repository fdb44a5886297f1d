//! Forces on the floor that are wrong.

use cannonpile::geometry::Vector;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::{Fault, P, RIGHT, faults, sum, twice};

/// The force on the floor, with a part of it changed.
macro_rules! force {
    (|$force:ident, $above:ident| $($component:ident = $wrong:expr),+) => {
        |$above, increments, directions, weight| {
            let $force = (RIGHT.force_on_floor)($above, increments, directions, weight);
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
        "the sphere's own weight left out": carried = |increments, above| {
            increments.carried(above) - increments.sum()
        } => ["base-normal"];
        "nothing along γ": carried = |increments, above| {
            increments.carried(above) - &increments.force(above[2].clone(), 2)
        } => ["base-normal"];

        "the bottom layer's weight left out": force_on_floor = |above, increments, directions, _| {
            (RIGHT.resultant_above)(above, increments, directions)
        } => ["equilibrium", "base-normal", "weight", "total-moment", "second-moment", "shear-ratio",
              "discs"];
        "shear of the floor on the pile": force_on_floor = force!(|f, above| x = -f.x, y = -f.y)
            => ["equilibrium", "shear", "shear-on-axis", "discs"];
        "a swirl": force_on_floor = force!(|f, above| x = -f.y, y = f.x)
            => ["equilibrium", "shear", "total-moment", "shear-on-axis", "shear-ratio", "discs"];
        "twice the shear": force_on_floor = force!(|f, above| x = twice(&f.x), y = twice(&f.y))
            => ["equilibrium", "shear", "shear-on-axis", "shear-ratio", "discs"];
        "a push to one side": force_on_floor = force!(|f, above| x = f.x + &P::one())
            => ["equilibrium", "shear", "total-shear", "shear-on-axis", "shear-ratio", "discs"];
        "a push out of the plane of discs": force_on_floor = force!(|f, above| y = f.y + &P::one())
            => ["equilibrium", "shear", "total-shear", "total-moment", "shear-on-axis",
                "shear-ratio", "discs"];
        "load shifted from γ to α": force_on_floor = force!(|f, above| z = f.z + &above[0] - &above[2])
            => ["equilibrium", "base-normal", "uniform-base", "total-moment", "second-moment",
                "shear-ratio", "discs"];
        "load drawn in from the rim": force_on_floor = force!(|f, above| z = f.z + &squeeze(above))
            => ["equilibrium", "base-normal", "uniform-base", "second-moment", "shear-ratio", "discs"];

        "L for L−1": corner_shear_ratio = |l, increments, line| {
            (RIGHT.corner_shear_ratio)(&(l.clone() + &P::one()), increments, line)
        } => ["shear-ratio"];
        "the γ corner forgotten": corner_shear_ratio = |l, increments, line| match line {
            2 => (P::zero(), P::zero()),
            _ => (RIGHT.corner_shear_ratio)(l, increments, line),
        } => ["shear-ratio"];
    }
}
