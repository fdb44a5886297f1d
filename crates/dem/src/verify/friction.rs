//! Tangential forces, the friction of the floor, and moments, for a pile on a rough floor.

use super::finding::{Finding, FrictionFault, FrictionOf};
use super::floor::OnFloor;
use super::measured::{Measured, distance, norm, opposite, over, relative, sort_decreasing};
use super::refusal::Refusal;
use super::unbalanced::between;
use crate::error::bug;
use crate::vector::{cross, dot, minus, plus};
use crate::{Each, Error, NumberedContact, NumberedPile};

/// The largest distance of a factor from 0 or −1 that counts as this value.
const NEAR: f64 = 1e-3;

/// The unit vectors from the lower to the upper sphere of the contacts of two layers, in the order of the directions.
pub(super) struct Directions(Vec<[f64; 3]>);

/// The comparison of tangential forces, contact by contact.
pub(super) struct FrictionTally<'n, 'p> {
    numbered: &'n NumberedPile<'p>,
    directions: &'n Directions,
    contacts: Tangential,
    /// The net force on each sphere without its weight, and the net moment about its centre over R. NaN if a force on the
    /// sphere is unknown.
    nets: Vec<[[f64; 3]; 2]>,
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

/// The net moment on a sphere, with the horizontal net force on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NetMoment {
    pub(super) sphere: u64,
    /// The moment, over R times the largest exact tangential force.
    pub(super) moment: f64,
    /// The force, over the largest exact tangential force.
    pub(super) force: f64,
}

impl Directions {
    pub(super) fn of(numbered: &NumberedPile<'_>) -> Result<Self, Error> {
        let (packing, pile) = (numbered.packing(), numbered.pile());
        let top = numbered.sites()?.next();
        let top = top.ok_or_else(|| bug("a pile has a sphere"))?;
        let directions = pile.dimension().directions().iter().map(|direction| {
            let below = pile.shape().below(top, *direction);
            between(packing, top, below.ok_or_else(|| Error::on_floor(top))?)
        });
        Ok(Self(directions.collect::<Result<_, Error>>()?))
    }

    /// Returns the direction of the n-th contact. The contacts are in the order of their upper spheres.
    fn of_contact(&self, n: usize) -> Result<[f64; 3], Error> {
        let direction = n.checked_rem(self.0.len()).and_then(|n| self.0.get(n));
        direction
            .copied()
            .ok_or_else(|| bug("a pile has directions"))
    }

    /// Returns the measurement of the n-th contact with its normal and its tangential force. If the latter is not listed, the
    /// vector is the whole force. The upper sphere is the first.
    pub(super) fn split(&self, n: usize, measured: Measured) -> Result<Measured, Error> {
        let (Some(vector), None) = (measured.vector, measured.tangential) else {
            return Ok(measured);
        };
        let up = self.of_contact(n)?;
        let along = dot(vector, up);
        let normal = up.each(|component| component * along);
        Ok(Measured {
            force: if measured.is_length {
                along
            } else {
                measured.force
            },
            vector: Some(normal),
            tangential: Some(minus(vector, normal)),
            ..measured
        })
    }
}

impl<'n, 'p> FrictionTally<'n, 'p> {
    pub(super) fn new(
        numbered: &'n NumberedPile<'p>,
        directions: &'n Directions,
    ) -> Result<Self, Error> {
        let spheres = usize::try_from(numbered.numbering().sphere_count());
        let spheres = spheres.map_err(|_| bug("contacts that are compared fit in memory"))?;
        Ok(Self {
            numbered,
            directions,
            contacts: Tangential::default(),
            nets: vec![[[0.0; 3]; 2]; spheres],
            largest: 0.0,
        })
    }

    /// Adds the n-th contact with the exact tangential force on the upper sphere, and the split rows with measured forces.
    pub(super) fn add(
        &mut self,
        (n, exact): (usize, &NumberedContact),
        tangential: [f64; 3],
        rows: [Option<Measured>; 2],
    ) -> Result<(), Error> {
        self.largest = self.largest.max(norm(tangential));
        let is_measured = rows.iter().any(Option::is_some);
        let rows = rows.iter().flatten();
        let measured = rows.filter_map(|row| row.tangential.map(|force| (row, force)));
        let apart = |(_, force): &(&Measured, [f64; 3])| distance(*force, tangential);
        let worse = measured.max_by(|one, other| apart(one).total_cmp(&apart(other)));
        let mut acting = [[f64::NAN; 3]; 2];
        if let Some((row, force)) = worse {
            self.contacts.add(exact.ids, force, tangential);
            let up = self.directions.of_contact(n)?;
            let normal = row.vector.unwrap_or_else(|| up.each(|x| x * row.force));
            // The contact is below the upper sphere and above the lower one. Force and place change their signs together,
            // so both moments are equal.
            acting = [plus(normal, force), cross(force, up)];
        } else if is_measured && norm(tangential) > 0.0 {
            self.contacts.unknown += 1;
        }
        let [force, moment] = acting;
        let [upper, lower] = exact.ids;
        self.act(upper, [force, moment])?;
        self.act(lower, [opposite(force), moment])
    }

    /// Finishes the comparison with the forces of the floor.
    pub(super) fn close(mut self, on_floor: &OnFloor) -> Result<WithFriction, Refusal> {
        let mut floor = Tangential::default();
        let mut on_floor = on_floor.forces.iter().peekable();
        for exact in self.numbered.of_rough_floor().map_err(Refusal::of_forces)? {
            let (id, [x, y, _]) = exact.map_err(Refusal::of_forces)?;
            let exact = [x, y, 0.0];
            let measured = on_floor.next_if(|(sphere, _)| *sphere == id);
            let friction = |[x, y, _]: [f64; 3]| [x, y, 0.0];
            let apart = |sum: &[f64; 3]| distance(friction(*sum), exact);
            let mut acting = [[f64::NAN; 3]; 2];
            match measured {
                None => {}
                Some((_, None)) => floor.unknown += u64::from(norm(exact) > 0.0),
                Some((_, Some([one, other]))) => {
                    let force = if apart(other) > apart(one) {
                        other
                    } else {
                        one
                    };
                    let friction = friction(*force);
                    floor.add([id, id], friction, exact);
                    acting = [*force, cross(friction, [0.0, 0.0, 1.0])];
                }
            }
            self.act(id, acting)?;
        }
        let largest = self.largest;
        let nets = (1_u64..).zip(&self.nets);
        let known = nets.filter(|(_, nets)| nets.as_flattened().iter().all(|x| !x.is_nan()));
        let moments = known.map(|(sphere, [[x, y, _], moment])| NetMoment {
            sphere,
            moment: relative(norm(*moment), largest),
            force: relative(norm([*x, *y, 0.0]), largest),
        });
        Ok(WithFriction {
            moments: moments.collect(),
            contacts: self.contacts.closed(largest),
            floor: floor.closed(largest),
        })
    }

    /// Adds a force and a moment on a sphere.
    fn act(&mut self, id: u64, [force, moment]: [[f64; 3]; 2]) -> Result<(), Error> {
        let place = id.checked_sub(1).and_then(|id| usize::try_from(id).ok());
        let place = place.and_then(|place| self.nets.get_mut(place));
        let [net, turning] = place.ok_or_else(|| bug("a contact has spheres of the pile"))?;
        (*net, *turning) = (plus(*net, force), plus(*turning, moment));
        Ok(())
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
        let finding = |forces: &Tangential, of: fn([u64; 2]) -> FrictionOf| {
            let (ids, error) = forces.worst?;
            (error > tolerance).then(|| Finding::Friction {
                of: of(ids),
                fault: forces.fault(tolerance),
                count: over(&forces.errors, tolerance),
                error,
                normals_are_right,
            })
        };
        let balanced = self.moments.iter().filter(|net| net.force <= tolerance);
        let moment = greatest(balanced).filter(|net| net.moment > tolerance);
        let unknown =
            (self.contacts.unknown + self.floor.unknown > 0).then_some(Finding::Unknown {
                contacts: self.contacts.unknown,
                spheres: self.floor.unknown,
            });
        [
            finding(&self.contacts, FrictionOf::Spheres),
            finding(&self.floor, |[sphere, _]| FrictionOf::Floor(sphere)),
            moment.map(|NetMoment { sphere, moment, .. }| Finding::Moment { sphere, moment }),
            unknown,
        ]
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
    /// Returns the kind of fault of forces that are not accepted.
    fn fault(&self, tolerance: f64) -> FrictionFault {
        let near = tolerance.min(NEAR);
        match self.factor(tolerance) {
            Some(factor) if factor.abs() <= near => FrictionFault::Absent,
            Some(factor) if (factor + 1.0).abs() <= near => FrictionFault::Reversed,
            Some(factor) if (factor - 1.0).abs() > tolerance => FrictionFault::Factor(factor),
            _ => FrictionFault::Other,
        }
    }

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
