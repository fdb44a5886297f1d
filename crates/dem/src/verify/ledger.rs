//! The measured forces of a pile, stored by contact.

use std::collections::{BTreeMap, BTreeSet};

use contact_tables::{Contact, Force, Spheres};

use super::floor::{Floor, Upward};
use super::friction::FrictionTally;
use super::listed::{Forces, Listed, Order};
use super::measured::{
    MAX_ENTRIES, Measured, magnitude, opposite, refuse_infinite, relative, whole,
};
use super::refusal::{Fault, Refusal};
use super::slots::Slots;
use super::soft;
use super::tally::{Judged, Tally};
use super::unbalanced::{Balance, Directions, Unbalanced};
use crate::error::bug;
use crate::{Each, Error, NumberedContact, NumberedPile};
use cannonpile::Packing;
use cannonpile::engine::refuse_beyond_memory;
use cannonpile_stability::RoughPacking;

/// The largest number of pairs without a contact, and of contacts with walls, for each sphere. At most twelve spheres
/// touch a sphere. The limit leaves room for neighbours that do not touch.
const PAIRS_A_SPHERE: u64 = 20;

/// The memory of a force, a vector, the count of its rows, and the line of the first.
const BYTES_A_CONTACT: usize = size_of::<[f64; 4]>() + size_of::<Listed>() + size_of::<u64>();

/// The largest number of contacts whose errors are compared with those of springs.
const MAX_FITTED: usize = 1_000_000;

/// The measured forces of a pile. A contact takes 17 bytes, and 24 more if vectors were measured. It takes as much
/// again if pairs are listed twice with different forces.
pub(super) struct Ledger<'p> {
    numbered: NumberedPile<'p>,
    slots: Slots,
    spheres: u64,
    first_on_floor: u64,
    listed: Vec<Listed>,
    forces: Forces,
    /// The forces of second rows that differ from the first.
    seconds: Forces,
    /// Pairs without a contact.
    strays: BTreeMap<[u64; 2], Stray>,
    floor: Floor,
    /// The number of rows that list a pair of spheres a second time, and a contact with the floor.
    repeated: [u64; 2],
    /// The line of the first row of each contact.
    lines: Vec<u64>,
    /// On a rough floor, the directions of the contacts.
    rough: Option<Directions>,
    /// The spheres above the bottom layer that touch the floor, with their forces.
    fallen: Vec<(u64, f64)>,
}

/// A pair without a contact. Of two rows with different forces, the greater force counts.
struct Stray {
    measured: Measured,
    line: u64,
    listed: Listed,
    /// The difference between the forces of two rows.
    contradiction: f64,
}

impl<'p> Ledger<'p> {
    pub(super) fn new(packing: &Packing<'p>) -> Result<Self, Refusal> {
        refuse_beyond_memory(
            "a comparison of all contacts",
            &packing.pile().contact_count(),
            (MAX_ENTRIES, BYTES_A_CONTACT),
            "use fewer layers, or a smaller top or base",
        )?;
        let numbered = NumberedPile::new(packing)?;
        let slots = Slots::new(&numbered)?;
        Ok(Self {
            spheres: numbered.numbering().sphere_count(),
            first_on_floor: numbered.numbering().first_on_floor(),
            listed: vec![Listed::Never; slots.len()],
            forces: Forces::default(),
            seconds: Forces::default(),
            strays: BTreeMap::new(),
            floor: Floor::default(),
            repeated: [0; 2],
            lines: vec![0; slots.len()],
            rough: None,
            fallen: Vec::new(),
            numbered,
            slots,
        })
    }

    /// Returns the ledger of a pile on a rough floor.
    pub(super) fn on_rough_floor(packing: &Packing<'p>) -> Result<Self, Refusal> {
        RoughPacking::new(packing).map_err(crate::Error::from)?;
        let ledger = Self::new(packing)?;
        let rough = Some(Directions::of(&ledger.numbered)?);
        Ok(Self { rough, ..ledger })
    }

    pub(super) fn numbered(&self) -> &NumberedPile<'p> {
        &self.numbered
    }

    /// Returns the index of the contact between two spheres.
    pub(super) fn slot(&self, [one, other]: [u64; 2]) -> Option<usize> {
        self.slots.find([one.min(other), one.max(other)])
    }

    /// Returns the number of rows that are contacts with walls and are not judged.
    pub(super) fn unjudged_walls(&self) -> u64 {
        self.floor.unjudged()
    }

    /// Stores the measurement of a line. A number outside the pile is that of a wall, if the other sphere is at the
    /// bottom.
    ///
    /// The force must be finite. A pair may be in two rows: in both orders, or with the same force.
    pub(super) fn admit(&mut self, measured: &Measured, line: u64) -> Result<(), Fault> {
        let [first, second] = measured.ids;
        let order = if first < second {
            Order::Forward
        } else {
            Order::Backward
        };
        self.admit_in(order, measured, line)
    }

    /// Stores the measurement of a line that does not tell the order of its spheres.
    pub(super) fn admit_unordered(&mut self, measured: &Measured, line: u64) -> Result<(), Fault> {
        self.admit_in(Order::Unknown, measured, line)
    }

    /// Stores the contact of a bottom sphere with the floor below it.
    pub(super) fn admit_floor(
        &mut self,
        sphere: u64,
        on_sphere: Force,
        line: u64,
    ) -> Result<(), Fault> {
        if !self.is_at_bottom(sphere) {
            return Err(Fault::of_bug("the floor touches bottom spheres only"));
        }
        refuse_infinite(on_sphere)?;
        let is_repeated =
            self.floor
                .add_below(sphere, Upward::of(on_sphere, self.rough.is_some()), line);
        self.repeated[1] += u64::from(is_repeated);
        Ok(())
    }

    fn is_at_bottom(&self, sphere: u64) -> bool {
        (self.first_on_floor..=self.spheres).contains(&sphere)
    }

    fn admit_in(&mut self, order: Order, measured: &Measured, line: u64) -> Result<(), Fault> {
        let [first, second] = measured.ids;
        let spheres = 1..=self.spheres;
        if !spheres.contains(&first) || !spheres.contains(&second) {
            let force = whole(measured.on_first(), measured.tangential);
            return self.admit_wall([first.into(), second.into()], force, line);
        }
        if first == second {
            return Err(Fault::OneSphere { id: first });
        }
        refuse_infinite(measured.on_first())?;
        let tangential = measured.tangential.into_iter().flatten();
        if let Some(value) = tangential.into_iter().find(|x| !x.is_finite()) {
            let column = "a tangential force";
            return Err(Fault::NotFinite { column, value });
        }
        let measured = if first < second {
            *measured
        } else {
            measured.reversed()
        };
        match self.slots.find(measured.ids) {
            Some(slot) => self.fill(slot, order, &measured, line),
            None => self.stray(order, measured, line),
        }
    }

    /// Stores the contact of a bottom sphere with a wall, whose number is outside the pile.
    fn admit_wall(&mut self, ids: [i128; 2], on_first: Force, line: u64) -> Result<(), Fault> {
        let (first, spheres) = (1, self.spheres);
        let no_sphere = |id| Err(Fault::NoSuchSphere { id, first, spheres });
        let sphere = |id| {
            u64::try_from(id)
                .ok()
                .filter(|id| (1..=spheres).contains(id))
        };
        let ([one, other], is_second) = (ids, sphere(ids[0]).is_none());
        let (wall, sphere) = if is_second {
            (one, sphere(other))
        } else {
            (other, sphere(one))
        };
        let Some(sphere) = sphere.filter(|sphere| self.is_at_bottom(*sphere)) else {
            return no_sphere(wall);
        };
        refuse_infinite(on_first)?;
        let limit = self.limit();
        if self.floor.len() >= limit {
            return Err(Fault::TooMany { limit });
        }
        let on_sphere = if is_second {
            on_first.map(opposite)
        } else {
            on_first
        };
        let upward = Upward::of(on_sphere, self.rough.is_some());
        let is_repeated = self.floor.add((sphere, wall), is_second, upward, line);
        self.repeated[1] += u64::from(is_repeated);
        Ok(())
    }

    fn fill(
        &mut self,
        slot: usize,
        order: Order,
        measured: &Measured,
        line: u64,
    ) -> Result<(), Fault> {
        let split = match &self.rough {
            Some(rough) => rough.split(slot, *measured).map_err(Fault::of_error)?,
            None => *measured,
        };
        let measured = &Measured {
            is_length: false,
            ..split
        };
        let (ids, contacts) = (measured.ids, self.slots.len());
        let listed = self.listed.get_mut(slot).zip(self.lines.get_mut(slot));
        let (listed, own_line) = listed.ok_or_else(|| Fault::of_bug("every contact has a slot"))?;
        let is_first = *listed == Listed::Never;
        let agrees = !is_first && self.forces.get(slot, ids) == Some(*measured);
        let Some(after) = listed.after(order, agrees) else {
            let first = *own_line;
            return Err(Fault::Twice { ids, first });
        };
        *listed = after;
        if is_first {
            *own_line = line;
            return self.forces.set(slot, contacts, measured);
        }
        self.repeated[0] += 1;
        if agrees {
            return Ok(());
        }
        self.seconds.set(slot, contacts, measured)
    }

    fn stray(&mut self, order: Order, measured: Measured, line: u64) -> Result<(), Fault> {
        let (ids, limit) = (measured.ids, self.limit());
        if let Some(stray) = self.strays.get_mut(&ids) {
            let after = stray.listed.after(order, stray.measured == measured);
            let first = stray.line;
            stray.listed = after.ok_or(Fault::Twice { ids, first })?;
            stray.contradiction = stray.measured.difference(&measured);
            if measured.magnitude() > stray.measured.magnitude() {
                stray.measured = measured;
            }
            self.repeated[0] += 1;
            return Ok(());
        }
        if self.strays.len() as u64 >= limit {
            return Err(Fault::TooMany { limit });
        }
        let stray = Stray {
            measured,
            line,
            listed: Listed::Once(order),
            contradiction: 0.0,
        };
        self.strays.insert(ids, stray);
        Ok(())
    }

    /// Returns the largest number of pairs without a contact.
    fn limit(&self) -> u64 {
        self.spheres.saturating_mul(PAIRS_A_SPHERE).min(MAX_ENTRIES)
    }

    /// Returns whether a row was the contact of a bottom sphere with the floor or with a wall.
    pub(super) fn has_floor(&self) -> bool {
        !self.floor.is_empty()
    }

    /// Returns whether two rows of a pair are shares of its force: for most pairs the sum is nearer to the exact force than
    /// each row. A row of 0 beside the exact force is a contradiction.
    fn are_shares(&self) -> Result<bool, Refusal> {
        let mut votes = [0_u64; 2];
        let is_twice = |listed: &Listed| matches!(listed, Listed::Twice | Listed::Differently);
        if !self.listed.iter().any(is_twice) {
            return Ok(false);
        }
        let contacts = self.numbered.contacts().map_err(Refusal::of_forces)?;
        for (slot, contact) in contacts.enumerate() {
            let exact = contact.map_err(Refusal::of_forces)?;
            let rows = rows(&self.listed, [&self.forces, &self.seconds], slot, exact.ids);
            if let [Some(first), Some(second)] = rows
                && exact.force != 0.0
            {
                let [first, second] = [first, second].each(|row| row.force);
                let off = |force: f64| (force - exact.force).abs();
                let are_shares = off(first + second) < off(first).min(off(second));
                votes[usize::from(are_shares)] += 1;
            }
        }
        Ok(votes[1] > votes[0])
    }

    /// Compares all measured forces with the exact ones, and adds up the forces on each sphere.
    pub(super) fn judge(mut self) -> Result<(Judged, Unbalanced), Refusal> {
        let directions = self.numbered.pile().dimension().directions().len();
        if let Some((id, line)) = self.floor.sphere_below(directions) {
            let (first, spheres) = (1, self.spheres);
            return Err(Fault::NoSuchSphere { id, first, spheres }.at(line));
        }
        let mut strays = self.strays.values().map(|stray| &stray.measured);
        let with_vectors =
            !self.forces.vectors.is_empty() || strays.any(|stray| stray.vector.is_some());
        let is_rough = self.rough.is_some();
        let are_shares = self.are_shares()?;
        let mut tally = Tally::new(&self.numbered, with_vectors, is_rough);
        let mut balance = Balance::new(&self.numbered, is_rough)?;
        let mut friction = FrictionTally::default();
        // Each error overwrites a force that has already been read.
        let mut errors = 0;
        let mut see = |slot, exact: NumberedContact, tangential: [f64; 3]| {
            let rows = rows(&self.listed, [&self.forces, &self.seconds], slot, exact.ids);
            let [measured, second] = match rows {
                [Some(first), Some(second)] if are_shares => [Some(first.plus(&second)), None],
                // An equal row says nothing new.
                [first, second] if first == second => [first, None],
                rows => rows,
            };
            friction.add(exact.ids, tangential, [measured, second]);
            balance.add(&exact, measured.as_ref())?;
            if let Some(error) = tally.add(&exact, measured, second)
                && let Some(place) = self.forces.along.get_mut(errors)
            {
                *place = error;
                errors += 1;
            }
            Ok::<(), Refusal>(())
        };
        if is_rough {
            let contacts = self.numbered.rough_contacts().map_err(Refusal::of_forces)?;
            for (slot, contact) in contacts.enumerate() {
                let (exact, tangential) = contact.map_err(Refusal::of_forces)?;
                see(slot, exact, tangential)?;
            }
        } else {
            let contacts = self.numbered.contacts().map_err(Refusal::of_forces)?;
            for (slot, contact) in contacts.enumerate() {
                let exact = contact.map_err(Refusal::of_forces)?.in_order();
                see(slot, exact, [0.0; 3])?;
            }
        }
        let mut relative_errors = self.forces.along;
        relative_errors.truncate(errors);
        for stray in self.strays.values() {
            balance.add_stray(&stray.measured)?;
        }
        // Without one of the contacts no stiffness is known, and for many it would take long.
        let contacts = relative_errors.len();
        let is_whole = contacts == self.slots.len() && contacts <= MAX_FITTED && !is_rough;
        let stiffness = is_whole
            .then(|| soft::stiffness(self.numbered.packing(), &relative_errors, with_vectors));
        let floor = self
            .floor
            .judge(&self.numbered, tally.largest_force(), is_rough)?;
        let friction = is_rough.then(|| friction.close(&self.numbered, &floor, &mut balance));
        let friction = friction.transpose()?;
        let (unbalanced, loads) = balance.close()?;
        let strays = self.strays.values();
        let strays = strays.map(|stray| (&stray.measured, stray.contradiction));
        let strays: Vec<_> = strays.collect();
        let mut judged = tally.close(relative_errors, &strays, self.numbered.numbering());
        judged.friction = friction;
        judged.off_floor = floor.missing;
        (judged.loads, judged.stiffness) = (loads, stiffness.flatten());
        for (repeated, are_shares) in self
            .repeated
            .into_iter()
            .zip([are_shares, floor.are_shares])
        {
            *(if are_shares {
                &mut judged.shares
            } else {
                &mut judged.repeated
            }) += repeated;
        }
        judged.add_floor(floor);
        let largest = judged.largest_force;
        let fallen = self.fallen.into_iter();
        judged.fallen = fallen
            .map(|(id, force)| (id, relative(force, largest)))
            .collect();
        Ok((judged, unbalanced))
    }
}

impl Ledger<'_> {
    /// Stores a row with the numbers of its spheres.
    pub(super) fn take(&mut self, row: &Contact) -> Result<(), Refusal> {
        let ids = numbers(row)?;
        let admitted = if let [Ok(one), Ok(other)] = ids.each(u64::try_from) {
            self.admit(&Measured::of([one, other], row), row.line)
        } else {
            let force = whole(row.force, row.tangential);
            self.admit_wall(ids.each(Into::into), force, row.line)
        };
        admitted.map_err(|fault| fault.at(row.line))
    }

    /// Stores a row with the force of the floor on its first sphere. The first spheres of all rows before are `seen`.
    pub(super) fn take_of_floor(
        &mut self,
        row: &Contact,
        seen: &mut BTreeSet<i64>,
    ) -> Result<(), Refusal> {
        let ids = numbers(row)?;
        if !seen.insert(ids[0]) {
            let id = ids[0].unsigned_abs();
            return Err(Fault::SphereTwice { id }.at(row.line));
        }
        let sphere = u64::try_from(ids[0]).ok();
        let above = sphere.filter(|sphere| (1..self.first_on_floor).contains(sphere));
        let force = whole(row.force, row.tangential);
        let Some(sphere) = above else {
            let admitted = self.admit_wall(ids.each(Into::into), force, row.line);
            return admitted.map_err(|fault| fault.at(row.line));
        };
        // Codes list all spheres, also those that do not touch the floor.
        if magnitude(force) > 0.0 {
            self.fallen.push((sphere, magnitude(force)));
        }
        Ok(())
    }
}

/// Returns the numbers of the spheres of a row.
pub(super) fn numbers(row: &Contact) -> Result<[i64; 2], Error> {
    match row.spheres {
        Spheres::Numbers(ids) => Ok(ids),
        Spheres::Places(_) => Err(bug("a table is read by numbers, or by place")),
    }
}

/// Returns the rows of a contact. Equal ones are stored once.
fn rows(
    listed: &[Listed],
    [first, second]: [&Forces; 2],
    slot: usize,
    ids: [u64; 2],
) -> [Option<Measured>; 2] {
    let first = first.get(slot, ids);
    match listed.get(slot) {
        None | Some(Listed::Never) => [None; 2],
        Some(Listed::Once(_)) => [first, None],
        Some(Listed::Twice) => [first; 2],
        Some(Listed::Differently) => [first, second.get(slot, ids)],
    }
}

#[cfg(test)]
mod tests {
    use cannonpile::Pile;

    use super::*;

    #[test]
    fn the_floor_below_a_sphere_is_judged() {
        let pile = Pile::triangular(2).unwrap();
        let packing = Packing::new(&pile, &"1.2".parse().unwrap()).unwrap();
        let judged = |rows: &[(u64, Force)]| {
            let mut ledger = Ledger::new(&packing).unwrap();
            for (sphere, force) in rows {
                ledger.admit_floor(*sphere, *force, 1).unwrap();
            }
            ledger.judge().unwrap().0
        };
        let normal = 4.0 / 3.0;
        let right = [2, 3, 4].map(|sphere| (sphere, Force::Along(normal)));
        let floor = judged(&right);
        assert_eq!((floor.floor, floor.floor_errors), (3, vec![0.0; 3]));
        // A second row repeats the contact. The worse of two forces is judged.
        let vector = (3, Force::Vector([0.1, 0.2, 2.0 * normal]));
        for rows in [[right[1], vector], [vector, right[1]]] {
            let floor = judged(&rows);
            assert_eq!((floor.floor, floor.repeated), (1, 1));
            assert_eq!(floor.floor_errors, [1.0]);
            assert_eq!(floor.contradictions, [1.0]);
        }
        assert_eq!(judged(&[right[0], right[0], right[0]]).repeated, 2);
        let mut ledger = Ledger::new(&packing).unwrap();
        let infinite = Force::Along(f64::INFINITY);
        assert!(ledger.admit_floor(2, infinite, 1).is_err());
    }
}
