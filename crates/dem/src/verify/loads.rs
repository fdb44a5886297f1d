//! The loads that the measured forces give back, and the fault of a simulation that they show.

use super::finding::{Finding, FindingKind, counted, short};
use super::measured::norm;
use super::symptoms::{LEFT, Symptoms};
use crate::vector::minus;
use crate::{Each, Error, NumberedPile};
use cannonpile::lattice::Site;
use num_traits::ToPrimitive;

/// The largest turn of a force that has only a magnitude, by rounding.
const STRAIGHT: f64 = 1e-12;

/// The largest relative error of springs that falls as the inverse of their stiffness.
const LINEAR: f64 = 0.01;

/// A deficit of the lowest layer above the floor that shows friction: its share of the weight, and the least ratio to that of the
/// top layer. In a pile that still sinks, spheres near the floor come to rest first. Runs of LAMMPS have ratios of up to 0.51 above
/// this share and 0.68 below it; with friction they have at least 0.57, and mostly over 0.8.
const FRICTION: [(f64, f64); 2] = [(0.03, 0.55), (0.0, 0.72)];

/// The sums over the contacts of a sphere.
#[derive(Clone, Copy)]
pub(super) struct Sphere {
    /// The sum of all forces, with weight and load.
    pub(super) force: [f64; 3],
    /// The sum of the moments over R, with each contact at its exact place.
    pub(super) moment: [f64; 3],
    /// The largest turn of a force from below, relative to the exact direction.
    pub(super) turn: f64,
    /// True if the force of a contact is missing.
    pub(super) is_open: bool,
}

/// What the residual forces on the spheres above the floor have in common. A sphere with a missing contact is left out. Forces
/// are in weights of a sphere.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Loads {
    /// The number of spheres, and of those with at least a tenth of the greatest residual force.
    spheres: [u64; 2],
    /// The greatest residual force.
    greatest: f64,
    /// The median of each component.
    common: [f64; 3],
    /// The sphere farthest from the median, with the deviation, and the greatest deviation of another one.
    odd: Option<(u64, [f64; 3])>,
    others: f64,
    /// The mean of the vertical residual forces in each layer, from the top.
    layers: Vec<f64>,
    /// The greatest net moment over R.
    moment: f64,
    /// The square of the tangent of the exact angle of contacts to the vertical.
    tan2: f64,
    /// The largest turn of a force, relative to the exact direction, and the sphere with another size that explains all turns.
    turn: f64,
    sized: Option<u64>,
}

impl Loads {
    pub(super) fn of(
        pile: &NumberedPile<'_>,
        spheres: &[Sphere],
        unit: f64,
    ) -> Result<Self, Error> {
        let closed = || spheres.iter().filter(|sphere| !sphere.is_open);
        let residual = |sphere: &Sphere| sphere.force.each(|x| x / unit);
        let largest = |of: fn(&Sphere) -> f64| closed().map(of).fold(0.0, f64::max);
        let mut loads = Self {
            greatest: largest(|sphere| norm(sphere.force)) / unit,
            moment: largest(|sphere| norm(sphere.moment)) / unit,
            turn: largest(|sphere| sphere.turn),
            tan2: pile
                .packing()
                .inclination()
                .cos2()
                .to_f64()
                .map_or(0.0, |cos2| 1.0 / cos2 - 1.0),
            common: [0, 1, 2].each(|axis: usize| median(closed().map(|one| residual(one)[axis]))),
            ..Self::default()
        };
        let (mut layer, mut count) = (None, 0.0);
        let mut turned: Vec<Site> = Vec::new();
        for ((id, site), sphere) in (1..).zip(pile.sites()?).zip(spheres) {
            if sphere.turn > LEFT * loads.turn {
                if turned.last().is_some_and(|other| other.k != site.k) {
                    turned.clear();
                }
                turned.push(site);
            }
            if sphere.is_open {
                continue;
            }
            let residual = residual(sphere);
            let many = norm(residual) > LEFT * loads.greatest;
            loads.spheres = [loads.spheres[0] + 1, loads.spheres[1] + u64::from(many)];
            if layer.replace(site.k) != Some(site.k) {
                loads.layers.push(0.0);
                count = 0.0;
            }
            count += 1.0;
            if let Some(mean) = loads.layers.last_mut() {
                *mean += (residual[2] - *mean) / count;
            }
            let deviation = minus(residual, loads.common);
            let greatest = loads.odd.map_or(-1.0, |(_, odd)| norm(odd));
            if norm(deviation) > greatest {
                loads.others = loads.others.max(greatest);
                loads.odd = Some((id, deviation));
            } else {
                loads.others = loads.others.max(norm(deviation));
            }
        }
        loads.sized = sized(pile, &turned)?;
        Ok(loads)
    }

    /// Returns whether springs may cause this error: the forces balance, but for magnitudes along exact directions.
    pub(super) fn may_be_soft(&self, error: f64) -> bool {
        error <= LINEAR && (self.turn < STRAIGHT || self.greatest <= 3.0 * LEFT * error)
    }

    /// Returns the faults of the simulation that explain this largest error of the forces.
    pub(super) fn findings(&self, symptoms: &Symptoms, error: f64, tolerance: f64) -> Vec<Finding> {
        let [x, y, z] = self.common;
        let lean = norm([x, y, 0.0]);
        let is_common = self.odd.is_some_and(|(_, odd)| norm(odd) < LEFT * lean);
        let [closed, unbalanced] = self.spheres;
        if closed > 1 && is_common && lean > tolerance {
            // The sum of the forces carries the real weight.
            let part = |x: f64| {
                if x.abs() > LEFT * tolerance {
                    short(-x / (1.0 + z))
                } else {
                    0.0
                }
            };
            let text = format!(
                "all weights lean by ({:?}, {:?}) of their vertical part: is gravity vertical in one and not in the other?",
                part(x),
                part(y)
            );
            return vec![Finding::new(FindingKind::Lean, text)];
        }
        let factor = symptoms.factor(tolerance);
        if let Some(slope) = symptoms.slope(tolerance) {
            let turned = (1.0 + self.tan2) / (1.0 + slope * slope * self.tan2);
            let times = slope * turned.sqrt();
            let weight = factor.map_or(1.0, |(factor, _)| factor);
            let is_dense = (weight * times.powi(3) - 1.0).abs() < LEFT * (weight - 1.0).abs();
            let text = if is_dense {
                let times = 1.0 / times;
                format!("all diameters are {times:?} times those of the scene, at the same density")
            } else {
                format!(
                    "vertical forces fit the scene, horizontal ones do not: a/R is {times:?} times that of the scene; is the \
                     spacing another, or the diameter of all spheres?"
                )
            };
            let factor = factor.filter(|_| !is_dense).map(Finding::factor);
            let spacing = Finding::new(FindingKind::Spacing, text);
            return factor.into_iter().chain([spacing]).collect();
        }
        if let Some(factor) = factor {
            return vec![Finding::factor(factor)];
        }
        let odd = self.odd.filter(|(_, [x, y, z])| {
            norm([*x, *y, self.others]) <= LEFT * z.abs() && z.abs() > tolerance
        });
        let rest = odd.map_or(self.greatest, |_| self.others);
        let (is_balanced, is_turned) = (rest <= LEFT * error, self.turn > LEFT * error);
        let is_odd_size = odd.is_some_and(|(id, _)| self.sized == Some(id));
        let (kind, text) = if is_balanced
            && is_turned
            && (is_odd_size || odd.is_none() && self.moment > LEFT * self.turn)
        {
            let which = match self.sized {
                Some(sphere) => {
                    format!("does the diameter of sphere {sphere} differ, or that of one below it?")
                }
                None => "do diameters or the positions on the floor differ?".to_owned(),
            };
            let turn = self.turn;
            let text = format!(
                "forces balance, but lines of contacts are turned by up to {turn:.1e}: {which}"
            );
            (FindingKind::Size, text)
        } else if let Some((sphere, [.., more])) = odd.filter(|_| closed > 2) {
            let times = 1.0 + more;
            let text = format!(
                "the contacts of sphere {sphere} carry {times:.6} times its weight, those of all others once: does its mass differ?"
            );
            (FindingKind::Weight, text)
        } else if symptoms.is_rubbed(tolerance) || is_balanced && is_turned {
            let share = symptoms.tangential;
            let text = format!(
                "forces have a tangential part, of up to {share:.1e} of the exact force: is there friction?"
            );
            (FindingKind::Tangential, text)
        } else if unbalanced < 3 || 8 * unbalanced < closed {
            return Vec::new();
        } else if let Some(share) = self.borne_by_friction() {
            let text = format!(
                "normal forces do not carry {share:.1e} of each weight, in all layers: does friction carry it?"
            );
            (FindingKind::Rubbing, text)
        } else {
            let (spheres, share) = (counted(unbalanced, "sphere"), self.greatest);
            // Magnitudes along exact directions do not balance if sizes differ.
            let cause = if self.turn < STRAIGHT {
                "is the pile at rest, and has every sphere its size?"
            } else {
                "is the pile at rest? Run it longer"
            };
            let text = format!(
                "the forces on {spheres} do not balance, by up to {share:.1e} of a weight: {cause}"
            );
            (FindingKind::Motion, text)
        };
        vec![Finding::new(kind, text)]
    }

    /// Returns the share of the weight that friction bears in the lowest layer, if the layers lack forces as with friction.
    fn borne_by_friction(&self) -> Option<f64> {
        let (top, lowest) = (-self.layers.first()?, -self.layers.last()?);
        let greatest = self
            .layers
            .iter()
            .fold(0.0, |most: f64, mean| most.max(mean.abs()));
        let is_shown = |(share, ratio): &(f64, f64)| {
            // A single layer has no ratio.
            let is_even = lowest >= ratio * top && (*share > 0.0 || self.layers.len() > 1);
            lowest > *share && is_even
        };
        (top > 0.2 * greatest && FRICTION.iter().any(is_shown)).then_some(lowest)
    }
}

fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    let middle = numbers.len() / 2;
    if numbers.is_empty() {
        return 0.0;
    }
    *numbers.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Returns the sphere whose size turns the contacts of these spheres of one layer: the only one, or the one below all of them.
fn sized(pile: &NumberedPile<'_>, turned: &[Site]) -> Result<Option<u64>, Error> {
    let (shape, numbering) = (pile.pile().shape(), pile.numbering());
    let below = |site: &Site| {
        let directions = shape.dimension().directions().iter();
        directions
            .filter_map(|direction| shape.below(*site, *direction))
            .collect::<Vec<_>>()
    };
    let sphere = match turned {
        [] => None,
        [only] => Some(*only),
        [first, others @ ..] => {
            let is_common = |site: &Site| others.iter().all(|other| below(other).contains(site));
            below(first).into_iter().find(is_common)
        }
    };
    Ok(sphere.map(|site| numbering.id(site)).transpose()?)
}
