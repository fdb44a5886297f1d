//! The measured forces of the floor and of walls on the bottom spheres.

use std::collections::BTreeMap;

use contact_tables::Force;

use super::measured::{distance, relative, sort_decreasing};
use super::refusal::Refusal;
use crate::vector::plus;
use crate::{Each, NumberedPile};

/// The measured contacts of the bottom spheres with the floor and with walls.
#[derive(Default)]
pub(super) struct Floor {
    /// The contacts by sphere and wall. A wall has a number, unless it was found by position.
    contacts: BTreeMap<(u64, Option<i128>), Contact>,
}

/// The contact of a sphere with the floor or with a wall.
struct Contact {
    /// The sum of the forces of the rows that name the sphere first, and of those that name it second. Equal rows in a row
    /// count once.
    sums: [Option<[f64; 3]>; 2],
    /// The sum of the forces of all rows.
    total: [f64; 3],
    /// The last force of either order.
    last: [Option<[f64; 3]>; 2],
    /// The number of rows that are part of a sum, and of these with a force.
    rows: u64,
    loaded: u64,
    has_vector: bool,
    line: u64,
}

/// The judged force of the floor on a sphere, with z upwards.
#[derive(Clone, Copy)]
pub(super) struct Upward {
    /// On a floor with glue, or without a vector, x and y are 0.
    force: [f64; 3],
    has_vector: bool,
}

/// The result for the floor.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct OnFloor {
    /// The number of rows whose normal forces were judged.
    pub(super) judged: u64,
    /// The relative errors of the judged spheres, in decreasing order.
    pub(super) errors: Vec<f64>,
    /// The relative differences between two rows of one contact.
    pub(super) contradictions: Vec<f64>,
    /// The whole force of the floor on each judged sphere, if it is known: the sums over the rows of either order.
    pub(super) forces: Vec<(u64, Option<[[f64; 3]; 2]>)>,
    /// The number of bottom spheres that lack a row, and the first of them.
    pub(super) missing: Option<(u64, u64)>,
    /// True if several rows of one contact are shares of its force, and not repetitions.
    pub(super) are_shares: bool,
}

impl Upward {
    /// Returns the force on a sphere. A magnitude is the normal force. The friction of a floor with glue is not judged.
    pub(super) fn of(on_sphere: Force, is_rough: bool) -> Self {
        let (force, has_vector) = match on_sphere {
            Force::Along(force) => ([0.0, 0.0, force], false),
            Force::Vector(vector) | Force::Both(_, vector) if is_rough => (vector, true),
            Force::Vector([.., z]) | Force::Both(_, [.., z]) => ([0.0, 0.0, z], true),
        };
        Self { force, has_vector }
    }

    /// Returns the normal force.
    const fn normal(self) -> f64 {
        let [_, _, z] = self.force;
        z
    }
}

impl Floor {
    pub(super) fn is_empty(&self) -> bool {
        self.contacts.is_empty()
    }

    /// Returns the number of contacts.
    pub(super) fn len(&self) -> u64 {
        self.contacts.len() as u64
    }

    /// Adds a row between a sphere and a numbered wall. `is_second` tells that the row names the wall first. Returns
    /// whether the row repeats another one.
    pub(super) fn add(
        &mut self,
        (sphere, wall): (u64, i128),
        is_second: bool,
        upward: Upward,
        line: u64,
    ) -> bool {
        let contact = self.contacts.entry((sphere, Some(wall)));
        let contact = contact.or_insert_with(|| Contact::new(line));
        let is_repeated = contact.add(is_second, upward);
        contact.count(upward, is_repeated);
        is_repeated
    }

    /// Adds a row that was found below a sphere. Returns whether the row repeats another one. The position is that of
    /// one contact, so the two most different forces are kept instead of a sum.
    pub(super) fn add_below(&mut self, sphere: u64, upward: Upward, line: u64) -> bool {
        let contact = self.contacts.entry((sphere, None));
        let contact = contact.or_insert_with(|| Contact::new(line));
        let is_repeated = match &mut contact.sums {
            [Some(first), second] => {
                let apart = |force| distance(force, *first);
                if second.map_or(0.0, apart) < apart(upward.force) {
                    *second = Some(upward.force);
                }
                true
            }
            [first, _] => {
                *first = Some(upward.force);
                false
            }
        };
        contact.count(upward, is_repeated);
        is_repeated
    }

    /// Returns the number of rows that are not judged. If several walls push a sphere, only vectors tell the part of
    /// each in the vertical force.
    pub(super) fn unjudged(&self) -> u64 {
        let mut rows = 0;
        for (_, contacts) in self.by_sphere() {
            if !is_judged(&contacts) {
                rows += contacts.iter().map(|contact| contact.rows).sum::<u64>();
            }
        }
        rows
    }

    /// Returns the first number beyond the last sphere, with its line, if these numbers are the spheres of a higher
    /// pile instead of walls. Each of them touches at most `directions` spheres above, and one of these touches several.
    pub(super) fn sphere_below(&self, directions: usize) -> Option<(i128, u64)> {
        let mut touched = BTreeMap::new();
        for (_, wall) in self.contacts.keys() {
            let wall = wall.filter(|wall| *wall > 0)?;
            *touched.entry(wall).or_insert(0) += 1;
        }
        let is_pile = touched.values().all(|count| *count <= directions)
            && self.by_sphere().any(|(_, contacts)| contacts.len() > 1);
        let contacts = self.contacts.iter();
        let walls = contacts.filter_map(|((_, wall), contact)| Some(((*wall)?, contact.line)));
        walls.min_by_key(|(_, line)| *line).filter(|_| is_pile)
    }

    /// Compares the forces with the exact ones of the floor. Every bottom sphere with a force needs a row if one of them has
    /// one, or if all are `needed`. Equal rows of a contact are repetitions or shares, whichever leaves the smaller error.
    pub(super) fn judge(
        &self,
        numbered: &NumberedPile<'_>,
        largest_force: f64,
        are_needed: bool,
    ) -> Result<OnFloor, Refusal> {
        if self.is_empty() && !are_needed {
            return Ok(OnFloor::default());
        }
        let once = self.judged(numbered, largest_force, false)?;
        let shares = self.judged(numbered, largest_force, true)?;
        Ok(if shares.errors.first() < once.errors.first() {
            shares
        } else {
            once
        })
    }

    fn judged(
        &self,
        numbered: &NumberedPile<'_>,
        largest_force: f64,
        are_shares: bool,
    ) -> Result<OnFloor, Refusal> {
        let mut on_floor = OnFloor {
            are_shares,
            ..OnFloor::default()
        };
        let mut measured = self.by_sphere().peekable();
        for exact in numbered.on_floor().map_err(Refusal::of_forces)? {
            let (id, exact) = exact.map_err(Refusal::of_forces)?;
            let Some((_, contacts)) = measured.next_if(|(sphere, _)| *sphere == id) else {
                if exact.normal != 0.0 {
                    let (count, first) = on_floor.missing.unwrap_or((0, id));
                    on_floor.missing = Some((count + 1, first));
                }
                continue;
            };
            if !is_judged(&contacts) {
                continue;
            }
            // A contact that is listed in one order only counts in both sums.
            let sum = |[one, other]: [usize; 2]| {
                let sums = contacts.iter().map(|contact| {
                    let of = |order: usize| contact.sums.get(order).copied().flatten();
                    let total = Some(contact.total).filter(|_| are_shares);
                    total.or(of(one)).or(of(other))
                });
                sums.flatten().fold([0.0; 3], plus)
            };
            if !exact.normal.is_finite() {
                return Err(Refusal::OutOfRange);
            }
            let sums = [sum([0, 1]), sum([1, 0])];
            let has_vectors = contacts.iter().all(|contact| contact.has_vector);
            on_floor.forces.push((id, has_vectors.then_some(sums)));
            let [one, other] = sums.each(|[.., normal]| normal);
            let unit = if exact.normal == 0.0 {
                largest_force
            } else {
                exact.normal.abs()
            };
            let apart = (one - exact.normal).abs().max((other - exact.normal).abs());
            on_floor.errors.push(relative(apart, unit));
            let apart = relative(distance(sums[0], sums[1]), unit);
            on_floor
                .contradictions
                .extend(Some(apart).filter(|apart| *apart > 0.0));
            on_floor.judged += contacts.iter().map(|contact| contact.rows).sum::<u64>();
        }
        sort_decreasing(&mut on_floor.errors);
        Ok(on_floor)
    }

    /// Returns the contacts of each sphere, in the order of the numbers.
    fn by_sphere(&self) -> impl Iterator<Item = (u64, Vec<&Contact>)> {
        let mut contacts = self.contacts.iter().peekable();
        core::iter::from_fn(move || {
            let ((sphere, _), first) = contacts.next()?;
            let mut all = vec![first];
            while let Some((_, contact)) = contacts.next_if(|((next, _), _)| next == sphere) {
                all.push(contact);
            }
            Some((*sphere, all))
        })
    }
}

impl Contact {
    fn new(line: u64) -> Self {
        Self {
            sums: [None; 2],
            total: [0.0; 3],
            last: [None; 2],
            rows: 0,
            loaded: 0,
            has_vector: true,
            line,
        }
    }

    /// Adds a force to the sum of its order. Returns whether the row repeats another one: in the same order if it
    /// agrees, or in the other order.
    fn add(&mut self, is_second: bool, upward: Upward) -> bool {
        let ([first, second], [last, other]) = (&mut self.sums, &mut self.last);
        let (sum, last, reverse) = if is_second {
            (second, other, first)
        } else {
            (first, last, second)
        };
        if last.replace(upward.force) == Some(upward.force) {
            return true;
        }
        *sum = Some(sum.map_or(upward.force, |sum| plus(sum, upward.force)));
        reverse.is_some()
    }

    fn count(&mut self, upward: Upward, is_repeated: bool) {
        self.has_vector &= upward.has_vector;
        self.total = plus(self.total, upward.force);
        if !is_repeated {
            self.rows += 1;
            self.loaded += u64::from(upward.normal() != 0.0);
        }
    }
}

/// Returns whether the sum of these forces is the force of the floor: one force, or vectors.
fn is_judged(contacts: &[&Contact]) -> bool {
    let loaded = contacts.iter().map(|contact| contact.loaded).sum::<u64>();
    loaded <= 1 || contacts.iter().all(|contact| contact.has_vector)
}
