//! Measured pairs, each once, with the sphere of the lesser number first.

use super::{Fault, MAX_ENTRIES, Measured, Refusal};
use crate::shape::Numbering;

/// What was measured, sorted by pairs.
pub(super) struct Pairs(Vec<Pair>);

/// One pair.
pub(super) struct Pair {
    /// The force on the sphere of the lesser number.
    pub(super) measured: Measured,
    /// Whether the pile has this contact.
    pub(super) met: bool,
    /// Where it stands in what was given, from 1.
    entry: u64,
}

impl Pairs {
    /// All of them, if each is of two spheres of the pile, and none is there twice.
    pub(super) fn new(
        measured: impl IntoIterator<Item = Measured>,
        numbering: &Numbering<'_>,
    ) -> Result<Self, Refusal> {
        let spheres = numbering.spheres();
        let mut pairs = Vec::new();
        for (entry, measured) in (1..).zip(measured) {
            if let Some(fault) = fault(&measured, spheres) {
                return Err(Refusal::Entry { entry, fault });
            }
            if entry > MAX_ENTRIES {
                let fault = Fault::TooMany;
                return Err(Refusal::Entry { entry, fault });
            }
            let [first, second] = measured.ids;
            pairs.push(Pair {
                measured: if first < second {
                    measured
                } else {
                    measured.reversed()
                },
                met: false,
                entry,
            });
        }
        pairs.sort_unstable_by_key(|pair| (pair.measured.ids, pair.entry));
        // Of all that are there twice, the one that stands first.
        let twice = pairs
            .windows(2)
            .filter_map(|two| match two {
                [a, b] if a.measured.ids == b.measured.ids => Some((b, a.entry)),
                _ => None,
            })
            .min_by_key(|(pair, _)| pair.entry);
        match twice {
            None => Ok(Self(pairs)),
            Some((pair, first)) => Err(Refusal::Entry {
                entry: pair.entry,
                fault: Fault::Twice {
                    ids: pair.measured.ids,
                    first,
                },
            }),
        }
    }

    /// What was measured of a contact of the pile, if anything.
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

/// What is wrong with an entry by itself.
fn fault(measured: &Measured, spheres: u64) -> Option<Fault> {
    let [first, second] = measured.ids;
    for id in measured.ids {
        if id == 0 || id > spheres {
            return Some(Fault::NoSuchSphere { id, spheres });
        }
    }
    if first == second {
        return Some(Fault::OneSphere { id: first });
    }
    let [x, y, z] = measured.vector.unwrap_or_default();
    [("force", measured.force), ("fx", x), ("fy", y), ("fz", z)]
        .into_iter()
        .find(|(_, value)| !value.is_finite())
        .map(|(column, value)| Fault::NotFinite { column, value })
}
