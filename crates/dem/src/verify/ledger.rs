//! The measured forces of a pile, row by row.

use std::collections::BTreeSet;

use contact_tables::{Contact, Force, Spheres};
use num_traits::ToPrimitive;

use super::floor::{Floor, Upward};
use super::friction::FrictionTally;
use super::measured::{
    MAX_ENTRIES, Measured, magnitude, opposite, refuse_infinite, relative, whole,
};
use super::refusal::{Fault, Refusal};
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

/// The largest number of contacts whose errors are compared with those of springs.
const MAX_FITTED: usize = 1_000_000;

/// The measured forces of a pile. A row takes 80 bytes, and 24 more for a tangential force.
pub(super) struct Ledger<'p> {
    numbered: NumberedPile<'p>,
    spheres: u64,
    first_on_floor: u64,
    contacts: u64,
    /// The number of rows.
    taken: u64,
    /// The rows of pairs of spheres. They are sorted before they are judged.
    rows: Vec<Row>,
    floor: Floor,
    /// The number of rows that list a contact with the floor a second time.
    repeated: u64,
    /// On a rough floor, the directions of the contacts.
    rough: Option<Directions>,
    /// The spheres above the bottom layer that touch the floor, with their forces.
    fallen: Vec<(u64, f64)>,
}

/// A row of a pair of spheres, as seen from the sphere with the smaller number.
struct Row {
    measured: Measured,
    line: u64,
    order: Order,
}

/// The order of the two spheres in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    /// The sphere with the smaller number is first.
    Forward,
    /// The sphere with the greater number is first.
    Backward,
    /// The row has no order: a contact point belongs to both spheres.
    Unknown,
}

/// A contact of the pile with its rows.
struct Pair {
    exact: NumberedContact,
    /// The exact tangential force on the upper sphere.
    tangential: [f64; 3],
    /// The place of the first row among all.
    place: usize,
    rows: [Option<Measured>; 2],
}

impl Row {
    fn is_of_pair(&self, other: &Self) -> bool {
        self.measured.ids == other.measured.ids
    }

    /// Returns whether a second row of the pair has the same force.
    fn agrees(&self, other: &Self) -> bool {
        let forces =
            |Self { measured, .. }: &Self| (measured.force, measured.vector, measured.tangential);
        forces(self) == forces(other)
    }
}

impl<'p> Ledger<'p> {
    pub(super) fn new(packing: &Packing<'p>) -> Result<Self, Refusal> {
        refuse_beyond_memory(
            "a comparison of all contacts",
            &packing.pile().contact_count(),
            (MAX_ENTRIES, size_of::<Row>()),
            "use fewer layers, or a smaller top or base",
        )?;
        let numbered = NumberedPile::new(packing)?;
        let contacts = numbered.contact_count().to_u64();
        Ok(Self {
            spheres: numbered.numbering().sphere_count(),
            first_on_floor: numbered.numbering().first_on_floor(),
            contacts: contacts.ok_or_else(|| bug("contacts that are compared fit in memory"))?,
            taken: 0,
            rows: Vec::new(),
            floor: Floor::default(),
            repeated: 0,
            rough: None,
            fallen: Vec::new(),
            numbered,
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
        let upward = Upward::of(on_sphere, self.rough.is_some());
        self.repeated += u64::from(self.floor.add_below(sphere, upward, line));
        Ok(())
    }

    /// Counts a row. Refuses the first one beyond the largest number, so that a table without end is refused too. Among so
    /// many rows one repeats a pair, as in a table of several steps, or pairs without a contact are too many.
    pub(super) fn count(&mut self, line: u64) -> Result<(), Refusal> {
        let limit = self.most_rows();
        self.taken += 1;
        if self.taken <= limit {
            return Ok(());
        }
        self.sort()?;
        Err(Fault::TooMany { limit }.at(line))
    }

    /// Returns the largest number of rows of a table: two for each pair, and two for each contact with a wall.
    pub(super) fn most_rows(&self) -> u64 {
        2 * (self.contacts + 2 * self.limit())
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
        self.rows.push(Row {
            measured,
            line,
            order,
        });
        Ok(())
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
        self.repeated += u64::from(is_repeated);
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

    /// Sorts the rows by pairs. A third row of a pair is refused, and another force in the same order, as in a table of
    /// several steps.
    fn sort(&mut self) -> Result<(), Refusal> {
        self.rows
            .sort_unstable_by_key(|row| (row.measured.ids, row.line));
        let pairs = self.rows.chunk_by(Row::is_of_pair);
        let refused = pairs.filter_map(|rows| {
            let (first, second) = (rows.first()?, rows.get(1)?);
            let is_once = first.order == second.order && first.order != Order::Unknown;
            let again = if is_once && !first.agrees(second) {
                second
            } else {
                rows.get(2)?
            };
            Some((again.line, first))
        });
        let Some((line, first)) = refused.min_by_key(|(line, _)| *line) else {
            return Ok(());
        };
        let (ids, first) = (first.measured.ids, first.line);
        Err(Fault::Twice { ids, first }.at(line))
    }

    /// Returns the contacts of the pile, each with its rows.
    fn pairs(&self) -> Result<impl Iterator<Item = Result<Pair, Refusal>>, Refusal> {
        type Exact<'e> = Box<dyn Iterator<Item = Result<(NumberedContact, [f64; 3]), Error>> + 'e>;
        let exact: Exact<'_> = if self.rough.is_some() {
            Box::new(self.numbered.rough_contacts().map_err(Refusal::of_forces)?)
        } else {
            let contacts = self.numbered.contacts().map_err(Refusal::of_forces)?;
            Box::new(contacts.map(|contact| Ok((contact?.in_order(), [0.0; 3]))))
        };
        Ok(exact.enumerate().map(|(n, exact)| {
            let (exact, tangential) = exact.map_err(Refusal::of_forces)?;
            let place = self
                .rows
                .partition_point(|row| row.measured.ids < exact.ids);
            let row = |place: usize| {
                let row = self
                    .rows
                    .get(place)
                    .filter(|row| row.measured.ids == exact.ids);
                let measured = row.map(|row| match &self.rough {
                    Some(rough) => rough.split(n, row.measured),
                    None => Ok(row.measured),
                });
                let measured = measured.transpose()?;
                let is_length = false;
                Ok::<_, Error>(measured.map(|measured| Measured {
                    is_length,
                    ..measured
                }))
            };
            let rows = [row(place)?, row(place + 1)?];
            Ok(Pair {
                exact,
                tangential,
                place,
                rows,
            })
        }))
    }

    /// Returns whether two rows of a pair are shares of its force: for most pairs the sum is nearer to the exact force than
    /// each row. A row of 0 beside the exact force is a contradiction.
    fn are_shares(&self) -> Result<bool, Refusal> {
        if self.rows.is_sorted_by(|one, other| !one.is_of_pair(other)) {
            return Ok(false);
        }
        let mut votes = [0_u64; 2];
        for pair in self.pairs()? {
            let Pair { exact, rows, .. } = pair?;
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
        self.sort()?;
        let with_vectors = self.rows.iter().any(|row| row.measured.vector.is_some());
        let is_rough = self.rough.is_some();
        let are_shares = self.are_shares()?;
        let mut tally = Tally::new(&self.numbered, with_vectors, is_rough);
        let mut balance = Balance::new(&self.numbered, is_rough)?;
        let mut friction = FrictionTally::default();
        let (mut relative_errors, mut places) = (Vec::new(), Vec::new());
        for pair in self.pairs()? {
            let Pair {
                exact,
                tangential,
                place,
                rows,
            } = pair?;
            places.extend(rows[0].map(|_| place));
            let [measured, second] = match rows {
                [Some(first), Some(second)] if are_shares => [Some(first.plus(&second)), None],
                // An equal row says nothing new.
                [first, second] if first == second => [first, None],
                rows => rows,
            };
            friction.add(exact.ids, tangential, [measured, second]);
            balance.add(&exact, measured.as_ref())?;
            relative_errors.extend(tally.add(&exact, measured, second));
        }
        places.sort_unstable();
        let (mut place, mut pairs, mut strays) = (0, 0, Vec::new());
        for rows in self.rows.chunk_by(Row::is_of_pair) {
            let is_contact = places.binary_search(&place).is_ok();
            (place, pairs) = (place + rows.len(), pairs + 1);
            let forces = rows.iter().map(|row| row.measured);
            let greatest =
                forces.max_by(|one, other| one.magnitude().total_cmp(&other.magnitude()));
            if let (Some(stray), false) = (greatest, is_contact) {
                balance.add_stray(&stray)?;
                let apart = rows.iter().map(|row| row.measured.difference(&stray));
                strays.push((stray, apart.fold(0.0, f64::max)));
            }
        }
        let repeated = [(self.rows.len() - pairs) as u64, self.repeated];
        // Without one of the contacts no stiffness is known, and for many it would take long.
        let contacts = relative_errors.len();
        let is_whole = contacts as u64 == self.contacts && contacts <= MAX_FITTED && !is_rough;
        let stiffness = is_whole
            .then(|| soft::stiffness(self.numbered.packing(), &relative_errors, with_vectors));
        let stiffness = stiffness.transpose()?.flatten();
        let floor = self
            .floor
            .judge(&self.numbered, tally.largest_force(), is_rough)?;
        let friction = is_rough.then(|| friction.close(&self.numbered, &floor, &mut balance));
        let friction = friction.transpose()?;
        let (unbalanced, loads) = balance.close()?;
        let mut judged = tally.close(relative_errors, &strays, self.numbered.numbering());
        judged.friction = friction;
        judged.off_floor = floor.missing;
        (judged.loads, judged.stiffness) = (loads, stiffness);
        for (repeated, are_shares) in repeated.into_iter().zip([are_shares, floor.are_shares]) {
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
        self.count(row.line)?;
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
        // The sums of these rows are infinite, so that their difference is not a number.
        let mut ledger = Ledger::new(&packing).unwrap();
        for (first, sign) in [(0, 1.0), (-1, -1.0)] {
            for force in [1.7e308, 1.6e308].map(|force| sign * force) {
                let ids = [2.into(), first.into()];
                ledger
                    .admit_wall(ids, Force::Vector([0.0, 0.0, force]), 1)
                    .unwrap();
            }
        }
        assert_eq!(ledger.judge().unwrap().0.floor_errors, [f64::INFINITY]);
        let mut ledger = Ledger::new(&packing).unwrap();
        let infinite = Force::Along(f64::INFINITY);
        assert!(ledger.admit_floor(2, infinite, 1).is_err());
    }
}
