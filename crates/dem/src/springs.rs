//! What a pile of stiff spheres is to a code that has springs: how stiff, how damped, in which steps.

use num_rational::BigRational;
use num_traits::Zero;

use super::numbered::{NumberedPile, nearest};
use super::weights::{checked, greatest_extra, nearest_rational, normal, ordinary_weight};
use crate::Error;
use cannonpile::lattice::Site;
use cannonpile::scalar::Ring;

/// Springs, dashpots and steps that let a pile relax to its exact forces.
///
/// With the spring constant k and forces up to F, spheres sink into each other by F/k: forces are wrong by some F/(kR),
/// and by the last digit of a position times k. Here F/(kR) is 10⁻⁶, a hundred times what the last digits bring.
pub(super) struct Springs {
    pub(super) radius: f64,
    pub(super) mass: f64,
    /// The gravity, 0 for spheres that weigh nothing.
    pub(super) gravity: f64,
    /// k = 10⁶ L·mg/(R cos²θ), for the greatest load in place of mg where that is more.
    pub(super) stiffness: f64,
    /// A tenth of √(m/k).
    pub(super) timestep: f64,
    /// The distance of the floats at the greatest coordinate: a sphere whose steps are shorter stays where it is.
    pub(super) last_digit: f64,
    /// The number of layers.
    pub(super) layers: f64,
    /// Steps after which a pile that comes to no rest is given up.
    pub(super) most_steps: u64,
    /// The least and the greatest x, y and z of the centres.
    pub(super) bounds: [[f64; 2]; 3],
}

impl Springs {
    pub(super) fn of(numbered: &NumberedPile<'_>) -> Result<Self, Error> {
        let (pile, packing) = (numbered.pile(), numbered.packing());
        let layers = BigRational::from_i128(pile.layers());
        let most = greatest_extra(pile)?;
        // In mg. Of spheres that weigh nothing only the loads matter, and without any nothing does.
        let greatest = match (pile.is_weightless(), most.is_zero()) {
            (true, false) => layers.clone() * most,
            _ => layers.clone() + most,
        };
        let cos2 = packing.inclination().cos2();
        let million = BigRational::from_i128(1_000_000);
        let stiffness = million * greatest * packing.sphere_weight() / cos2 / packing.radius();
        let stiffness = normal(&stiffness, "the stiffness of springs")?;
        let mass = normal(packing.mass(), "mass")?;
        let gravity = ordinary_weight(pile) * packing.gravity();
        let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        // Layers are convex: their corners are their extremes.
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
            gravity: nearest_rational(&gravity, "gravity")?,
            stiffness,
            timestep: checked(0.1 * (mass / stiffness).sqrt(), "a time step")?,
            last_digit: farthest.next_up() - farthest,
            layers: nearest_rational(&layers, "layers")?,
            most_steps: steps.saturating_mul(2000).saturating_add(20_000),
            bounds,
        })
    }

    /// The dashpot between two spheres, in kg/s: critical for the two on the spring.
    pub(super) fn dashpot(&self) -> f64 {
        (2.0 * self.stiffness * self.mass).sqrt()
    }

    /// The drag on each sphere, in kg/s: critical for the slowest swing of the whole pile, whose frequency is about
    /// √(k/m)/L. It stops with the spheres, and leaves no force behind.
    pub(super) fn drag(&self) -> f64 {
        2.0 * (self.stiffness * self.mass).sqrt() / self.layers
    }

    /// The greatest force on a sphere that is left over where coordinates end.
    pub(super) fn rest(&self) -> f64 {
        4.0 * self.stiffness * self.last_digit
    }
}

/// ρ of a sphere of this mass: m/(4/3·πR³).
pub(super) fn density(mass: f64, radius: f64) -> Result<f64, Error> {
    let volume = 4.0 / 3.0 * core::f64::consts::PI * radius * radius * radius;
    checked(
        mass / checked(volume, "the volume of a sphere")?,
        "a density",
    )
}
