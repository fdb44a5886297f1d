//! The contacts of a pile that carry a force.

use contact_tables::Place;

use super::ledger::Ledger;
use super::places::Places;
use super::refusal::Refusal;
use crate::Error;
use crate::vector::minus;

/// The contacts of a pile, with the magnitudes of their forces.
pub(super) struct LoadedContacts<'l, 'p> {
    ledger: &'l Ledger<'p>,
    places: &'l Places,
    radius: f64,
    forces: Vec<f64>,
    greatest: f64,
}

impl<'l, 'p> LoadedContacts<'l, 'p> {
    pub(super) fn new(
        ledger: &'l Ledger<'p>,
        places: &'l Places,
        radius: f64,
    ) -> Result<Self, Refusal> {
        let mut forces = Vec::new();
        for contact in ledger.numbered().contacts().map_err(Refusal::of_forces)? {
            forces.push(contact.map_err(Refusal::of_forces)?.force.abs());
        }
        Ok(Self {
            ledger,
            places,
            radius,
            greatest: forces.iter().copied().fold(0.0, f64::max),
            forces,
        })
    }

    pub(super) fn places(&self) -> &'l Places {
        self.places
    }

    /// Returns the magnitude of the force between two spheres.
    pub(super) fn force(&self, ids: [u64; 2]) -> f64 {
        let slot = self.ledger.slot(ids);
        let force = slot.and_then(|slot| self.forces.get(slot));
        // Spheres without a contact have no force.
        force.copied().unwrap_or(0.0)
    }

    /// Calls a function with the centres of the two spheres of each contact with a force.
    ///
    /// With the floor, this includes each bottom sphere and its mirror image in the floor.
    pub(super) fn each(&self, with_floor: bool, mut visit: impl FnMut(Place)) -> Result<(), Error> {
        for (touch, force) in self.ledger.numbered().touches()?.zip(&self.forces) {
            let (_, ids) = touch?;
            if is_loaded(*force, self.greatest) {
                visit(Place::Centres(self.places.centres_of(ids)?));
            }
        }
        for id in self.places.on_floor().filter(|_| with_floor) {
            let centre = self.places.centre(id)?;
            let image = minus(centre, [0.0, 0.0, 2.0 * self.radius]);
            visit(Place::Centres([centre, image]));
        }
        Ok(())
    }
}

/// Returns whether a force is large enough to mark the position of a contact. If the greatest force is 0, every contact
/// counts.
pub(super) fn is_loaded(force: f64, greatest: f64) -> bool {
    force >= greatest * 1e-9
}
