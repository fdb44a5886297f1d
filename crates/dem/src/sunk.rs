//! The equilibrium positions of spheres that overlap by f/k on springs.

use super::numbered::NumberedPile;
use super::springs::Springs;
use super::vector::{dot, minus, plus, solved};
use crate::{Each, Error};
use cannonpile::lattice::ContactKind;

/// The centres of the spheres in equilibrium on springs of stiffness k, in the order of their numbers. They are
/// translated by a multiple of R, so that all coordinates are at least 2R. Coordinates near 0 would make a comparison
/// by relative errors impossible.
///
/// From the floor up, the distance of each sphere from its supports is set to 2R − f/k, with the exact force f. The
/// rotation of the contacts, which this neglects, changes forces by a relative amount of F/(kR). So the error of
/// centres is (F/(kR))² R times the number of layers.
pub(super) struct Sunk {
    pub(super) rigid: Vec<[f64; 3]>,
    pub(super) at_rest: Vec<[f64; 3]>,
}

/// The index of a supporting sphere, and the contact force.
type Support = (usize, f64);

impl Sunk {
    pub(super) fn of(pile: &NumberedPile<'_>, springs: &Springs) -> Result<Self, Error> {
        let radius = springs.radius;
        let shift = springs
            .bounds
            .each(|[least, _]| (2.0 - (least / radius).floor()) * radius);
        let rigid = pile.centres()?.map(|centre| {
            let (_, centre) = centre?;
            Ok(plus(centre, shift))
        });
        let rigid: Vec<[f64; 3]> = rigid.collect::<Result<_, Error>>()?;
        let mut supports: Vec<Vec<Support>> = vec![Vec::new(); rigid.len()];
        for contact in pile.forces()? {
            let contact = contact?;
            let [upper, lower] = contact.ids.each(|id| usize::try_from(id - 1));
            // All numbers are indices of spheres in memory.
            let (Ok(upper), Ok(lower), ContactKind::Sloping(_)) = (upper, lower, contact.direction)
            else {
                continue;
            };
            if let Some(supports) = supports.get_mut(upper) {
                supports.push((lower, contact.force));
            }
        }
        let mut at_rest = rigid.clone();
        for sphere in (0..rigid.len()).rev() {
            let on: Vec<([f64; 3], f64)> = supports[sphere]
                .iter()
                .map(|(lower, force)| (at_rest[*lower], 2.0 * radius - force / springs.stiffness))
                .collect();
            if let [first, second, third] = on[..] {
                at_rest[sphere] = supported_by(at_rest[sphere], [first, second, third]);
            } else if let [first, second] = on[..] {
                // A third support along y keeps a disc in its plane.
                let aside = plus(at_rest[sphere], [0.0, radius, 0.0]);
                at_rest[sphere] = supported_by(at_rest[sphere], [first, second, (aside, radius)]);
            }
        }
        Ok(Self { rigid, at_rest })
    }
}

/// Returns the point at these distances from three others, by Newton's method from a nearby start.
fn supported_by(start: [f64; 3], supports: [([f64; 3], f64); 3]) -> [f64; 3] {
    let mut at = start;
    for _ in 0..8 {
        let apart = supports.each(|(centre, _)| minus(at, centre));
        let lengths = apart.each(|v| dot(v, v).sqrt());
        let missing = [0, 1, 2].each(|n| supports[n].1 - lengths[n]);
        let directions = [0, 1, 2].each(|n| apart[n].each(|x| x / lengths[n]));
        // Along these directions the step has the missing lengths as components.
        at = plus(at, solved(directions, missing));
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn returns_a_point_with_the_given_distances() {
        let supports = [
            ([1.0, 0.0, 0.0], 1.5),
            ([-0.5, 0.9, 0.0], 1.4),
            ([-0.5, -0.8, 0.1], 1.6),
        ];
        let at = supported_by([0.0, 0.0, 1.2], supports);
        for (centre, distance) in supports {
            let apart = minus(at, centre);
            assert!(
                (dot(apart, apart).sqrt() - distance).abs() < 1e-15,
                "{at:?}"
            );
        }
    }
}
