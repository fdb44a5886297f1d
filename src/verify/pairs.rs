//! Measured pairs, each once, with the sphere of the lesser number first.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::measured::{MAX_ENTRIES, Measured};
use super::refusal::{Fault, Refusal};
use crate::{Error, Packing};

/// How many pairs a list may have for each sphere. No more than twelve spheres touch one, and each pair is listed once:
/// this leaves room for neighbours that do not touch.
const PAIRS_A_SPHERE: u64 = 20;

/// What entries a scene can have: pairs of its spheres, each once.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scope {
    spheres: u64,
    limit: u64,
    /// The pairs so far, and where they stand.
    seen: HashMap<[u64; 2], u64>,
}

impl Scope {
    pub(super) fn new(packing: &Packing<'_>) -> Result<Self, Refusal> {
        let contacts = packing.pile().contact_count();
        if u64::try_from(&contacts).is_ok_and(|contacts| contacts <= MAX_ENTRIES) {
            let spheres = packing.pile().numbering()?.sphere_count();
            return Ok(Self {
                spheres,
                limit: spheres.saturating_mul(PAIRS_A_SPHERE).min(MAX_ENTRIES),
                seen: HashMap::new(),
            });
        }
        Err(Refusal::Scene(Error::TooLarge {
            quantity: "a comparison of all contacts",
            needed: contacts,
            limit: MAX_ENTRIES,
            remedy: "use fewer layers, or a smaller top or base",
        }))
    }

    /// Forgets what it has seen.
    pub(super) fn clear(&mut self) {
        self.seen.clear();
    }

    /// Admits the entry at a place, if it is of two spheres of the pile, with a finite force, and was not there before.
    pub(super) fn admit(&mut self, measured: &Measured, place: u64) -> Result<(), Fault> {
        let [first, second] = measured.ids;
        let spheres = self.spheres;
        let stranger = measured
            .ids
            .into_iter()
            .find(|id| *id == 0 || *id > spheres);
        if let Some(id) = stranger {
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
        let ids = [first.min(second), first.max(second)];
        let count = self.seen.len() as u64;
        match self.seen.entry(ids) {
            Entry::Occupied(seen) => Err(Fault::Twice {
                ids,
                first: *seen.get(),
            }),
            Entry::Vacant(_) if count >= self.limit => Err(Fault::TooMany { limit: self.limit }),
            Entry::Vacant(unseen) => {
                unseen.insert(place);
                Ok(())
            }
        }
    }
}

/// What was measured, each pair with the lesser number first.
#[derive(Default)]
pub(super) struct Pairs(Vec<Pair>);

struct Pair {
    measured: Measured,
    /// Whether the pile has this contact.
    met: bool,
}

impl Pairs {
    pub(super) fn add(&mut self, measured: Measured) {
        let [first, second] = measured.ids;
        self.0.push(Pair {
            measured: if first < second {
                measured
            } else {
                measured.reversed()
            },
            met: false,
        });
    }

    pub(super) fn sort(&mut self) {
        self.0.sort_unstable_by_key(|pair| pair.measured.ids);
    }

    /// What was measured of a contact of the pile, if anything; all must be [sorted](Self::sort).
    pub(super) fn meet(&mut self, ids: [u64; 2]) -> Option<Measured> {
        let place = self.0.binary_search_by_key(&ids, |pair| pair.measured.ids);
        let pair = place.ok().and_then(|place| self.0.get_mut(place))?;
        pair.met = true;
        Some(pair.measured)
    }

    /// Whether there is a vector.
    pub(super) fn has_vectors(&self) -> bool {
        self.0.iter().any(|pair| pair.measured.vector.is_some())
    }

    /// The pairs that are no contacts of the pile.
    pub(super) fn left(&self) -> impl Iterator<Item = &Measured> {
        let left = self.0.iter().filter(|pair| !pair.met);
        left.map(|pair| &pair.measured)
    }
}
