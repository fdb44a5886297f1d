//! Faults in directions, positions and distances.

use cannonpile::geometry::Vector;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::parts::{Fault, P, RIGHT, faults, over, swapped, twice};

/// The sphere's position with one changed component.
macro_rules! moved {
    (|$at:ident| $($coordinate:ident = $wrong:expr),+) => {
        |above, directions| {
            let $at = (RIGHT.position)(above, directions);
            Vector { $($coordinate: $wrong,)+ ..$at }
        }
    };
}

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "ê_c reversed": directions = |s| {
            let [a, b, c] = (RIGHT.directions)(s);
            [a, b, Vector { x: -c.x, ..c }]
        } => ["paper-system", "unit-directions", "equilibrium", "central-force", "shear", "total-shear",
                "total-moment", "second-moment", "shear-on-axis", "shear-ratio", "change-of-sign", "point-load",
                "load", "tilt", "tilt-total", "secondary-closure", "mean-closure", "isometry", "rough-contact",
                "rough-floor", "rough-unique", "horizontal-balance", "resultant-form", "third-moment", "fourth-moment",
                "one-fault"];
        "ê_c twice as long": directions = |s| {
            let [a, b, c] = (RIGHT.directions)(s);
            [a, b, c.map(|part| twice(&part))]
        } => ["paper-system", "unit-directions", "equilibrium", "central-force", "base-normal", "uniform-base",
                "weight", "shear", "total-shear", "total-moment", "second-moment", "shear-on-axis", "shear-ratio",
                "change-of-sign", "point-load", "load", "tilt", "tilt-total", "secondary-closure", "mean-closure",
                "isometry", "rough-contact", "rough-floor", "rough-unique", "horizontal-balance", "resultant-form",
                "third-moment", "fourth-moment", "one-fault"];
        "contacts point down": directions = |s| (RIGHT.directions)(s).map(|e| -e)
            => ["paper-system", "equilibrium", "central-force", "base-normal", "uniform-base", "weight",
                "shear", "total-moment", "second-moment", "shear-on-axis", "shear-ratio", "change-of-sign",
                "load", "tilt", "tilt-total", "rough-contact", "rough-floor", "rough-unique",
                "horizontal-balance"];
        "φ = π/6 whatever s": directions = |_| (RIGHT.directions)(&over(P::one(), 2))
            => ["paper-system", "unit-directions", "equilibrium", "total-shear", "total-moment", "second-moment",
                "load", "tilt", "tilt-total", "primary-closure", "secondary-closure", "isometry", "rough-contact",
                "rough-floor", "rough-unique"];
        "ê_a for ê_b": directions = |s| swapped(&(RIGHT.directions)(s)) => ["paper-system", "central-force",
                "shear", "shear-on-axis", "load", "tilt", "tilt-total", "rough-contact", "rough-unique"];
        "y in units of cosφ": directions = |s| {
            (RIGHT.directions)(s).map(|e| Vector { y: twice(&e.y), ..e })
        } => ["paper-system", "unit-directions", "central-force", "shear", "second-moment", "shear-on-axis",
                "shear-ratio", "point-load", "load", "tilt", "tilt-total", "primary-closure",
                "secondary-closure", "mean-closure", "rough-contact", "rough-unique", "third-moment",
                "fourth-moment", "one-fault"];
        "ê_c leans along y": directions = |s| {
            let [a, b, c] = (RIGHT.directions)(s);
            [a, b, Vector { y: P::one(), ..c }]
        } => ["paper-system", "unit-directions", "equilibrium", "central-force", "shear", "total-shear",
                "total-moment", "second-moment", "shear-on-axis", "shear-ratio", "change-of-sign", "point-load",
                "load", "tilt", "tilt-total", "primary-closure", "secondary-closure", "mean-closure", "isometry",
                "rough-contact", "rough-floor", "rough-unique", "horizontal-balance", "resultant-form", "third-moment",
                "fourth-moment", "one-fault"];

        "both supports of a disc on one side": disc_directions = || {
            let [a, _, c] = (RIGHT.disc_directions)();
            [a.clone(), a, c]
        } => ["discs", "load", "rough-contact", "rough-floor"];
        "ê_a of discs for ê_b": disc_directions = || swapped(&(RIGHT.disc_directions)()) => ["discs", "load",
                "rough-contact"];
        "discs lean out of their plane": disc_directions = || {
            (RIGHT.disc_directions)().map(|e| Vector { y: P::one(), ..e })
        } => ["discs", "load", "primary-closure", "rough-contact", "rough-floor"];
        "contacts of discs point down": disc_directions = || {
            (RIGHT.disc_directions)().map(|e| Vector { z: P::one(), ..e })
        } => ["discs", "load", "rough-contact", "rough-floor"];

        "under − as under +": turned_about_z = |v| v => ["change-of-sign", "point-load", "load", "secondary-closure",
                "isometry", "horizontal-balance", "resultant-form", "third-moment", "fourth-moment", "one-fault"];
        "upside down": turned_about_z = |v| -v
            => ["equilibrium", "change-of-sign", "load", "secondary-closure", "isometry", "rough-floor",
                "horizontal-balance", "resultant-form"];
        "mirrored": turned_about_z = |v| Vector { x: -v.x, ..v } => ["change-of-sign", "point-load", "load",
                "secondary-closure", "mean-closure", "isometry", "horizontal-balance", "resultant-form",
                "third-moment", "fourth-moment", "one-fault"];

        "above the apex": position = |above, directions| -(RIGHT.position)(above, directions)
            => ["central-force", "shear-on-axis", "rough-contact", "rough-floor"];
        "from a corner": position = moved!(|at| x = at.x + &P::one())
            => ["central-force", "shear-on-axis", "point-load", "mean-closure", "rough-contact", "rough-floor",
                "third-moment", "fourth-moment", "one-fault"];
        "mirrored": position = moved!(|at| y = -at.y) => ["central-force", "shear-on-axis", "tilt-total",
                "rough-contact", "rough-floor"];
        "half as deep": position = moved!(|at| z = over(at.z, 2)) => ["central-force", "tilt-total",
                "rough-contact", "rough-floor"];
        "turned by 90°": position = moved!(|at| x = -at.y.clone(), y = at.x.clone())
            => ["central-force", "total-moment", "second-moment", "shear-on-axis", "point-load", "tilt-total",
                "mean-closure", "rough-contact", "rough-floor", "third-moment", "fourth-moment", "one-fault"];
        // Moments balance in every coordinate that is linear in the counts.
        "growing faster than the pile": position = moved!(|at| x = at.x.clone() * &at.z, y = at.y.clone() * &at.z)
            => ["central-force", "total-moment", "second-moment", "shear-on-axis", "tilt-total"];

        "a wrong sign in ê_a·ê_c": squared_distance = |n, s, sin2| {
            (RIGHT.squared_distance)(n, &-s.clone(), sin2)
        } => ["unit-directions", "horizontal-balance"];
        "mixed products once": squared_distance = |n, s, sin2| {
            let squares = n.iter().fold(P::zero(), |sum, n| sum + &(n.clone() * n));
            over((RIGHT.squared_distance)(n, s, sin2) + &squares, 2)
        } => ["unit-directions", "horizontal-balance"];
    }
}
