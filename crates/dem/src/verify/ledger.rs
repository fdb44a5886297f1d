//! The measured forces of a pile, stored by contact.

use std::collections::BTreeMap;

use super::entry::{Entry, Sink};
use super::measured::{MAX_ENTRIES, Measured};
use super::refusal::{Fault, Refusal};
use super::slots::Slots;
use super::tally::{Judged, Tally};
use super::unbalanced::{Balance, Unbalanced};
use crate::NumberedPile;
use cannonpile::Packing;
use cannonpile::engine::refuse_beyond_memory;

/// The largest number of pairs without a contact, for each sphere. At most twelve spheres touch a sphere, and each pair
/// is listed once. The limit leaves room for neighbours that do not touch.
const PAIRS_A_SPHERE: u64 = 20;

/// The memory of a force and a vector.
const BYTES_A_CONTACT: usize = size_of::<[f64; 4]>();

/// The largest number of runs of lines. Beyond it, messages about repeated pairs omit the line.
const MAX_RUNS: usize = 1 << 20;

/// The measured forces of a pile. A contact takes eight bytes, and 24 more if vectors were measured.
pub(super) struct Ledger<'p> {
    numbered: NumberedPile<'p>,
    slots: Slots,
    spheres: u64,
    /// The force of each contact: 0 if it was not measured, and −0 if the measured force is 0. The memory starts as
    /// zeros, so the system allocates only the pages that are written.
    forces: Vec<f64>,
    /// The vector on the sphere with the smaller number; NaN if none was measured.
    vectors: Vec<[f64; 3]>,
    /// Pairs without a contact, with their lines.
    strays: BTreeMap<[u64; 2], (Measured, u64)>,
    lines: Lines,
    snapshots: u64,
    timestep: Option<i64>,
    walls: u64,
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
            forces: vec![0.0; slots.len()],
            vectors: Vec::new(),
            strays: BTreeMap::new(),
            lines: Lines::default(),
            snapshots: 0,
            timestep: None,
            walls: 0,
            numbered,
            slots,
        })
    }

    pub(super) fn numbered(&self) -> &NumberedPile<'p> {
        &self.numbered
    }

    /// Returns the index of the contact between two spheres.
    pub(super) fn slot(&self, [one, other]: [u64; 2]) -> Option<usize> {
        self.slots.find([one.min(other), one.max(other)])
    }

    pub(super) fn snapshots(&self) -> u64 {
        self.snapshots
    }

    pub(super) fn timestep(&self) -> Option<i64> {
        self.timestep
    }

    pub(super) fn walls(&self) -> u64 {
        self.walls
    }

    /// Stores the measurement of a line. Both spheres must be in the pile, the force must be finite, and the pair must
    /// be new.
    pub(super) fn admit(&mut self, measured: &Measured, line: u64) -> Result<(), Fault> {
        let spheres = self.spheres;
        let [first, second] = measured.ids;
        let mut ids = measured.ids.into_iter();
        if let Some(id) = ids.find(|id| *id == 0 || *id > spheres) {
            return Err(Fault::NoSuchSphere { id, spheres });
        }
        if first == second {
            return Err(Fault::OneSphere { id: first });
        }
        let [x, y, z] = measured.vector.unwrap_or([0.0; 3]);
        let numbers = [("force", measured.force), ("fx", x), ("fy", y), ("fz", z)];
        if let Some((column, value)) = numbers.into_iter().find(|(_, x)| !x.is_finite()) {
            return Err(Fault::NotFinite { column, value });
        }
        let measured = if first < second {
            *measured
        } else {
            measured.reversed()
        };
        match self.slots.find(measured.ids) {
            Some(slot) => self.fill(slot, &measured, line),
            None => self.stray(measured, line),
        }
    }

    fn fill(&mut self, slot: usize, measured: &Measured, line: u64) -> Result<(), Fault> {
        let force = self.forces.get_mut(slot);
        let force = force.ok_or_else(|| Fault::of_bug("every contact has a slot"))?;
        if force.to_bits() != 0 {
            let (ids, first) = (measured.ids, self.lines.of(slot));
            return Err(Fault::Twice { ids, first });
        }
        *force = if measured.force == 0.0 {
            -0.0
        } else {
            measured.force
        };
        self.lines.note(slot, line);
        if measured.vector.is_some() && self.vectors.is_empty() {
            self.vectors = vec![[f64::NAN; 3]; self.forces.len()];
        }
        if let Some(vector) = measured.vector {
            let place = self.vectors.get_mut(slot);
            *place.ok_or_else(|| Fault::of_bug("every contact has a slot"))? = vector;
        }
        Ok(())
    }

    fn stray(&mut self, measured: Measured, line: u64) -> Result<(), Fault> {
        let limit = self.spheres.saturating_mul(PAIRS_A_SPHERE).min(MAX_ENTRIES);
        if let Some((_, first)) = self.strays.get(&measured.ids) {
            let (ids, first) = (measured.ids, Some(*first));
            return Err(Fault::Twice { ids, first });
        }
        if self.strays.len() as u64 >= limit {
            return Err(Fault::TooMany { limit });
        }
        self.strays.insert(measured.ids, (measured, line));
        Ok(())
    }

    /// Compares all measured forces with the exact ones.
    ///
    /// With `with_balance`, also adds up the forces on each sphere.
    pub(super) fn judge(
        mut self,
        with_balance: bool,
    ) -> Result<(Judged, Option<Unbalanced>), Refusal> {
        let strays = self.strays.values();
        let with_vectors =
            !self.vectors.is_empty() || strays.clone().any(|(stray, _)| stray.vector.is_some());
        let mut tally = Tally::new(&self.numbered, with_vectors);
        let balance = with_balance.then(|| Balance::new(&self.numbered));
        let mut balance = balance.transpose()?;
        let contacts = self.numbered.contacts().map_err(Refusal::of_forces)?;
        // Each error overwrites a force that has already been read.
        let mut errors = 0;
        for (slot, contact) in contacts.enumerate() {
            let contact = contact.map_err(Refusal::of_forces)?.in_order();
            let force = self.forces.get(slot).copied();
            let vector = self.vectors.get(slot).copied();
            let vector = vector.filter(|[x, ..]| !x.is_nan());
            let measured = force.filter(|force| force.to_bits() != 0);
            let measured = measured.map(|force| Measured {
                ids: contact.ids,
                force: force + 0.0,
                vector,
            });
            if let (Some(balance), Some(measured)) = (&mut balance, &measured) {
                balance.add(&contact, measured)?;
            }
            if let Some(error) = tally.add(&contact, measured)
                && let Some(place) = self.forces.get_mut(errors)
            {
                *place = error;
                errors += 1;
            }
        }
        self.forces.truncate(errors);
        let strays = self.strays.values().map(|(stray, _)| stray);
        if let Some(balance) = &mut balance {
            for stray in strays.clone() {
                balance.add_stray(stray)?;
            }
        }
        let judged = tally.close(self.forces, strays, self.numbered.numbering());
        Ok((judged, balance.map(Balance::close)))
    }
}

impl Sink for Ledger<'_> {
    fn begin_snapshot(&mut self, timestep: Option<i64>) {
        if self.snapshots > 0 {
            self.forces.fill(0.0);
            self.vectors.clear();
            self.strays.clear();
            self.lines = Lines::default();
            self.walls = 0;
        }
        self.snapshots += 1;
        self.timestep = timestep;
    }

    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal> {
        self.admit(&entry.named()?, line)
            .map_err(|fault| fault.at(line))
    }

    fn pass_over(&mut self) {
        self.walls += 1;
    }
}

/// The lines of the contacts, stored as runs of consecutive lines. Only a table in random order needs more runs than
/// are kept.
#[derive(Default)]
struct Lines {
    /// For the first contact of each run: its line, and the length of the run.
    runs: BTreeMap<usize, (u64, usize)>,
    last: Option<usize>,
}

impl Lines {
    fn note(&mut self, slot: usize, line: u64) {
        let run = self
            .last
            .and_then(|last| Some((last, self.runs.get_mut(&last)?)));
        if let Some((first, (begun, length))) = run
            && slot == first + *length
            && line == *begun + *length as u64
        {
            *length += 1;
        } else if self.runs.len() < MAX_RUNS {
            self.runs.insert(slot, (line, 1));
            self.last = Some(slot);
        } else {
            self.last = None;
        }
    }

    fn of(&self, slot: usize) -> Option<u64> {
        let (first, (line, length)) = self.runs.range(..=slot).next_back()?;
        let along = slot - first;
        (along < *length).then(|| line + along as u64)
    }
}
