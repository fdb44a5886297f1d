//! Tangential forces, the friction of the floor, and moments, for a pile on a rough floor.

use super::finding::{Finding, FindingKind, counted};
use super::floor::OnFloor;
use super::measured::{Measured, distance, norm, over, relative, sort_decreasing};
use super::refusal::Refusal;
use super::unbalanced::{Balance, NetMoment};
use crate::vector::dot;
use crate::{Each, NumberedPile};

/// The largest distance of a factor from 0 or −1 that counts as this value.
const NEAR: f64 = 1e-3;

/// The comparison of tangential forces, contact by contact.
#[derive(Default)]
pub(super) struct FrictionTally {
    contacts: Tangential,
    largest: f64,
}

/// Measured tangential forces and exact ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tangential {
    /// The errors relative to the exact force, or to the largest one where it is 0, in decreasing order.
    pub(super) errors: Vec<f64>,
    /// The number of rows without a tangential force where there is an exact one.
    pub(super) unknown: u64,
    /// The largest error where the exact force is 0.
    idle_error: f64,
    /// The spheres and the errors where the exact force is 0.
    idle: Vec<([u64; 2], f64)>,
    /// The range of the ratios of measured to exact forces, along the exact ones.
    ratios: Option<[f64; 2]>,
    /// The largest part of a measured force across the exact one, relative to that.
    aside: f64,
    /// The spheres with the largest error. For the floor, both are the same.
    worst: Option<([u64; 2], f64)>,
}

/// The result for a pile on a rough floor.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct WithFriction {
    pub(super) contacts: Tangential,
    pub(super) floor: Tangential,
    /// Those of the spheres whose forces are all known.
    pub(super) moments: Vec<NetMoment>,
}

impl FrictionTally {
    /// Adds a contact with the exact tangential force on the upper sphere, and the split rows with measured forces.
    pub(super) fn add(&mut self, ids: [u64; 2], exact: [f64; 3], rows: [Option<Measured>; 2]) {
        self.largest = self.largest.max(norm(exact));
        let measured = rows.iter().flatten().filter_map(|row| row.tangential);
        let apart = |force: &[f64; 3]| distance(*force, exact);
        match measured.max_by(|one, other| apart(one).total_cmp(&apart(other))) {
            Some(worse) => self.contacts.add(ids, worse, exact),
            None if rows.iter().any(Option::is_some) && norm(exact) > 0.0 => {
                self.contacts.unknown += 1;
            }
            None => {}
        }
    }

    /// Finishes the comparison with the forces of the floor, which act on the spheres.
    pub(super) fn close(
        self,
        numbered: &NumberedPile<'_>,
        on_floor: &OnFloor,
        balance: &mut Balance<'_>,
    ) -> Result<WithFriction, Refusal> {
        let mut floor = Tangential::default();
        let mut on_floor = on_floor.forces.iter().peekable();
        for exact in numbered.of_rough_floor().map_err(Refusal::of_forces)? {
            let (id, [x, y, _]) = exact.map_err(Refusal::of_forces)?;
            let exact = [x, y, 0.0];
            let measured = on_floor.next_if(|(sphere, _)| *sphere == id);
            let friction = |[x, y, _]: [f64; 3]| [x, y, 0.0];
            let apart = |sum: &[f64; 3]| distance(friction(*sum), exact);
            let sums = measured.and_then(|(_, sums)| *sums);
            let force = sums.map(|[one, other]| {
                if apart(&other) > apart(&one) {
                    other
                } else {
                    one
                }
            });
            match force {
                Some(force) => floor.add([id, id], friction(force), exact),
                None => floor.unknown += u64::from(measured.is_some() && norm(exact) > 0.0),
            }
            balance.add_floor(id, force);
        }
        let largest = self.largest;
        Ok(WithFriction {
            moments: balance.moments(largest),
            contacts: self.contacts.closed(largest),
            floor: floor.closed(largest),
        })
    }
}

impl WithFriction {
    /// Returns whether no row lacks a tangential force.
    pub(super) fn is_known(&self) -> bool {
        self.contacts.unknown == 0 && self.floor.unknown == 0
    }

    /// Returns the greatest net moment.
    pub(super) fn moment(&self) -> Option<NetMoment> {
        greatest(self.moments.iter())
    }

    /// Returns whether all tangential forces are this multiple of the exact ones.
    pub(super) fn has_factor(&self, factor: f64, tolerance: f64) -> bool {
        [&self.contacts, &self.floor].into_iter().all(|forces| {
            let is_other = |other: f64| (other - factor).abs() > tolerance * factor.abs();
            forces.ratios.is_none() || !forces.factor(tolerance).is_none_or(is_other)
        })
    }

    /// Returns the explanations at an accepted error.
    pub(super) fn findings(&self, tolerance: f64, normals_are_right: bool) -> Vec<Finding> {
        let balanced = self.moments.iter().filter(|net| net.force <= tolerance);
        let moment = greatest(balanced.clone()).filter(|net| net.moment > tolerance);
        let moment = moment.map(|NetMoment { sphere, moment, .. }| {
            let text = format!(
                "the horizontal forces on sphere {sphere} balance, but the moments do not: their sum is {moment:.1e} R times the \
                 largest tangential force; do spheres turn?"
            );
            Finding::new(FindingKind::Moment, text)
        });
        // Spheres that do not turn change all forces.
        if moment.is_some() && balanced.count() == self.moments.len() {
            return moment.into_iter().collect();
        }
        let finding = |forces: &Tangential, kind, of: &str, noun: &str, words: [&str; 3]| {
            let (ids, error) = forces.worst.filter(|(_, error)| *error > tolerance)?;
            let at = format!("{of} {}", counted(over(&forces.errors, tolerance), noun));
            let near = tolerance.min(NEAR);
            let [name, absent, reversed] = words;
            let text = match forces.factor(tolerance) {
                Some(factor) if factor.abs() <= near => absent.replace('#', &at),
                Some(factor) if (factor + 1.0).abs() <= near => reversed.replace('#', &at),
                Some(factor) if (factor - 1.0).abs() > tolerance => {
                    format!("{name} {factor:?} times the exact values, {at}")
                }
                _ => {
                    let [one, other] = ids;
                    let spheres = if one == other {
                        format!("below sphere {one}")
                    } else {
                        format!("between spheres {one} and {other}")
                    };
                    format!("{name} wrong {at}, most {spheres}, with an error of {error:.1e}")
                }
            };
            Some((kind, text))
        };
        let contacts = finding(
            &self.contacts,
            FindingKind::Friction,
            "at",
            "contact",
            [
                "tangential forces are",
                "all tangential forces are 0, #: does the table hold normal forces only?",
                "all tangential forces have the wrong sign, #: are they the forces on the second sphere?",
            ],
        );
        let contacts = contacts.map(|(kind, text)| {
            let normal = if normals_are_right {
                "right, but"
            } else {
                "wrong, and"
            };
            Finding::new(kind, format!("normal forces are {normal} {text}"))
        });
        let floor = finding(
            &self.floor,
            FindingKind::FloorFriction,
            "below",
            "sphere",
            [
                "the friction of the floor is",
                "the floor has no friction, #: does the plane have a coefficient of friction?",
                "the friction of the floor has the wrong sign, #: is it the force of the spheres on the floor?",
            ],
        );
        let floor = floor.map(|(kind, text)| Finding::new(kind, text));
        let (lacking, spheres) = (self.contacts.unknown, self.floor.unknown);
        let unknown = (lacking + spheres > 0).then(|| {
            let text = format!(
                "the tangential force is not known at {lacking} contacts between spheres and {spheres} with the floor: add \
                 columns tx, ty, tz, or the whole force as fx, fy, fz"
            );
            Finding::new(FindingKind::Unknown, text)
        });
        [contacts, floor, moment, unknown]
            .into_iter()
            .flatten()
            .collect()
    }
}

fn greatest<'m>(moments: impl Iterator<Item = &'m NetMoment>) -> Option<NetMoment> {
    let moment = moments.max_by(|one, other| one.moment.total_cmp(&other.moment));
    moment.copied()
}

impl Tangential {
    /// Returns the ratio of measured to exact forces, if it is the same for all within an error.
    fn factor(&self, tolerance: f64) -> Option<f64> {
        let [least, most] = self.ratios?;
        let half = (most - least) / 2.0;
        let scale = tolerance * least.abs().max(most.abs()).max(1.0);
        let is_alike = half <= scale && self.aside <= scale && self.idle_error <= scale;
        is_alike.then_some(least + half)
    }

    fn add(&mut self, ids: [u64; 2], measured: [f64; 3], exact: [f64; 3]) {
        let (apart, force) = (distance(measured, exact), norm(exact));
        if force == 0.0 {
            self.idle.push((ids, apart));
            return;
        }
        self.err(ids, relative(apart, force));
        let (along, ahead) = (measured.each(|x| x / force), exact.each(|x| x / force));
        let ratio = dot(along, ahead);
        let [least, most] = self.ratios.unwrap_or([ratio; 2]);
        self.ratios = Some([least.min(ratio), most.max(ratio)]);
        let aside = distance(along, ahead.each(|x| ratio * x));
        self.aside = self.aside.max(aside);
    }

    fn err(&mut self, ids: [u64; 2], error: f64) {
        self.errors.push(error);
        if self.worst.is_none_or(|(_, worst)| worst < error) {
            self.worst = Some((ids, error));
        }
    }

    fn closed(mut self, largest: f64) -> Self {
        for (ids, apart) in core::mem::take(&mut self.idle) {
            let error = relative(apart, largest);
            self.idle_error = self.idle_error.max(error);
            self.err(ids, error);
        }
        sort_decreasing(&mut self.errors);
        self
    }
}
