//! Springs for simulation codes: their stiffness, their damping and the timestep.

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::numbered::{NumberedPile, nearest};
use super::weights::{checked, gravity, greatest_extra, magnitude, nearest_rational, normal};
use crate::Error;
use cannonpile::Load;
use cannonpile::lattice::Site;

/// Springs, dashpots and timesteps that relax a pile to its exact forces.
///
/// With the spring constant k and forces up to F, overlaps are F/k. The relative error of forces is about F/(kR), plus
/// the rounding error of positions times k. Here F/(kR) is 10⁻⁶, a hundred times the effect of rounding.
pub(super) struct Springs {
    pub(super) radius: f64,
    pub(super) mass: f64,
    /// The acceleration of gravity as x, y and z (up); 0 for weightless spheres.
    pub(super) gravity: [f64; 3],
    /// k = 10⁶ L·mg/(R cos²θ), with the greatest load instead of mg if it is larger. Under gravity that leans by (x, y),
    /// mg has the factor 1 + |x| + 2|y|.
    pub(super) stiffness: f64,
    /// A tenth of √(m/k).
    pub(super) timestep: f64,
    /// The spacing of floats at the greatest coordinate. A shorter step does not move a sphere.
    pub(super) last_digit: f64,
    /// The number of layers.
    pub(super) layers: f64,
    /// The number of steps before the script gives up.
    pub(super) most_steps: u64,
    /// The least and the greatest x, y and z of the centres.
    pub(super) bounds: [[f64; 2]; 3],
}

impl Springs {
    pub(super) fn of(numbered: &NumberedPile<'_>) -> Result<Self, Error> {
        let (pile, packing) = (numbered.pile(), numbered.packing());
        let layers = BigRational::from_integer(pile.layers().into());
        let most = greatest_extra(pile)?;
        // In mg. For weightless spheres only the loads matter; without loads any value is correct.
        let greatest = match (pile.is_weightless(), most.is_zero()) {
            (true, false) => layers.clone() * most,
            _ => &layers * magnitude(&Load::leaning(BigRational::one(), pile.tilt())) + most,
        };
        let cos2 = packing.inclination().cos2();
        let million = BigRational::from_integer(1_000_000.into());
        let stiffness = million * greatest * packing.sphere_weight() / cos2 / packing.radius();
        let stiffness = normal(&stiffness, "the stiffness of springs")?;
        let mass = normal(packing.mass(), "mass")?;
        let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        // Layers are convex, so corners have the extreme coordinates.
        for k in 0..pile.layers() {
            for [i, j] in pile.shape().layer(k)?.corners() {
                for (bound, x) in bounds.iter_mut().zip(packing.position(Site { i, j, k })?) {
                    let x = nearest(&x, "a position")?;
                    *bound = [bound[0].min(x), bound[1].max(x)];
                }
            }
        }
        let radius = normal(packing.radius(), "radius")?;
        let farthest = bounds
            .as_flattened()
            .iter()
            .fold(0.0_f64, |far, x| far.max(x.abs()))
            + radius;
        let steps = u64::try_from(pile.layers()).unwrap_or(u64::MAX);
        Ok(Self {
            radius,
            mass,
            gravity: gravity(numbered)?,
            stiffness,
            timestep: checked(0.1 * (mass / stiffness).sqrt(), "a time step")?,
            last_digit: farthest.next_up() - farthest,
            layers: nearest_rational(&layers, "layers")?,
            most_steps: steps.saturating_mul(2000).saturating_add(20_000),
            bounds,
        })
    }

    /// Returns the dashpot between two spheres, in kg/s: the critical damping of two spheres on the spring.
    pub(super) fn dashpot(&self) -> f64 {
        (2.0 * self.stiffness * self.mass).sqrt()
    }

    /// Returns the drag on each sphere, in kg/s: the critical damping of the slowest mode of the pile, whose frequency
    /// is about √(k/m)/L. At rest the drag exerts no force.
    pub(super) fn drag(&self) -> f64 {
        2.0 * (self.stiffness * self.mass).sqrt() / self.layers
    }

    /// Returns the greatest force on a sphere that can remain because of the rounding of coordinates.
    pub(super) fn rest(&self) -> f64 {
        4.0 * self.stiffness * self.last_digit
    }
}

/// Returns the density of a sphere of this mass: m/(4/3·πR³).
pub(super) fn density(mass: f64, radius: f64) -> Result<f64, Error> {
    let volume = 4.0 / 3.0 * core::f64::consts::PI * radius * radius * radius;
    checked(
        mass / checked(volume, "the volume of a sphere")?,
        "a density",
    )
}
