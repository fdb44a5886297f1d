//! Rows with positions, stored until the frame of the table is known.

use std::io;

use num_traits::ToPrimitive;

use contact_tables::{Contact, Force, Place};

use super::frame::Frame;
use super::ledger::Ledger;
use super::measured::{MAX_ENTRIES, magnitude, opposite, whole};
use super::places::{Found, Places};
use super::refusal::{Fault, Refusal};
use super::registration;
use crate::Error;
use crate::error::bug;
use cannonpile::Interrupt;

/// The number of rows that suffices to decide that the table is in the frame of the scene, if all rows match contacts
/// of the scene.
const ENOUGH: usize = 1 << 17;

/// Stored rows, and the ledger that receives them.
pub(super) struct Gathering<'p> {
    ledger: Ledger<'p>,
    places: Places,
    radius: f64,
    within: f64,
    kept: Vec<Contact>,
    /// True if the frame of the table is that of the scene.
    is_own: bool,
}

impl<'p> Gathering<'p> {
    pub(super) fn new(ledger: Ledger<'p>, within: f64) -> Result<Self, Refusal> {
        let radius = ledger.numbered().packing().radius().to_f64();
        let radius = radius.filter(|radius| radius.is_normal());
        let radius = radius.ok_or(Refusal::OutOfRange)?;
        Ok(Self {
            places: Places::new(ledger.numbered(), radius)?,
            ledger,
            radius,
            within: within * radius,
            kept: Vec::new(),
            is_own: false,
        })
    }

    /// Finds the frame, and passes all rows to the ledger.
    pub(super) fn settle(mut self) -> Result<(Ledger<'p>, Frame), Refusal> {
        let kept = core::mem::take(&mut self.kept);
        if self.is_own || kept.is_empty() {
            return Ok((self.ledger, Frame::OWN));
        }
        let frame = self.frame(&kept)?;
        for row in &kept {
            Interrupt::check()?;
            self.give(row, &frame)?;
        }
        Ok((self.ledger, frame))
    }

    fn frame(&self, kept: &[Contact]) -> Result<Frame, Refusal> {
        let sizes = [self.radius, self.within];
        let fit = registration::find(kept, &self.ledger, &self.places, sizes)?;
        let (found, sample) = (fit.found, fit.sample);
        if 2 * found < sample {
            return Err(Refusal::Elsewhere { found, sample });
        }
        Ok(fit.frame)
    }

    fn give(&mut self, row: &Contact, frame: &Frame) -> Result<(), Refusal> {
        let place = place_of(row)?.map(|point| frame.place(point));
        let found = match self.places.find(&place, self.within) {
            Ok(found) => found,
            // A row that matches no contact is ignored if its force is 0.
            Err(_) if magnitude(row.force) == 0.0 => return Ok(()),
            Err(fault) => return Err(fault.at(row.line)),
        };
        let force = row.force.map(|vector| frame.turned(vector));
        let tangential = row.tangential.map(|vector| frame.turned(vector));
        self.ledger.count(row.line)?;
        let admitted = match found {
            Found::Floor { sphere, is_second } => {
                let force = whole(force, tangential);
                let on_sphere = match place {
                    Place::Centres(_) if is_second => force.map(opposite),
                    Place::Centres(_) => force,
                    Place::Point(_) => upwards(force),
                };
                self.ledger.admit_floor(sphere, on_sphere, row.line)
            }
            Found::Spheres([one, other]) if one == other && magnitude(row.force) == 0.0 => Ok(()),
            Found::Spheres(ids) => match place {
                Place::Centres(_) => {
                    let mut measured = self.places.on_first(force, ids)?;
                    measured.tangential = tangential;
                    self.ledger.admit(&measured, row.line)
                }
                // A contact point does not tell which sphere is the first.
                Place::Point(_) => {
                    let mut measured = self.places.on_either(force, ids)?;
                    // Both vectors act on one sphere. Without the normal one, it is not known which.
                    measured.tangential = tangential.filter(|_| measured.vector.is_some());
                    self.ledger.admit_unordered(&measured, row.line)
                }
            },
        };
        admitted.map_err(|fault| fault.at(row.line))
    }

    fn all_fit(&self) -> bool {
        self.kept.iter().all(|row| {
            let place = row.place();
            magnitude(row.force) == 0.0
                || place.is_some_and(|place| self.places.find(&place, self.within).is_ok())
        })
    }

    /// Stores a row with the positions of its spheres.
    pub(super) fn take(&mut self, row: &Contact) -> Result<(), Refusal> {
        if self.is_own {
            return self.give(row, &Frame::OWN);
        }
        if self.kept.len() as u64 >= MAX_ENTRIES {
            let limit = MAX_ENTRIES;
            return Err(Fault::TooMany { limit }.at(row.line));
        }
        self.kept.try_reserve(1).map_err(io::Error::from)?;
        self.kept.push(*row);
        if self.kept.len() == ENOUGH && self.all_fit() {
            self.is_own = true;
            for row in core::mem::take(&mut self.kept) {
                self.give(&row, &Frame::OWN)?;
            }
        }
        Ok(())
    }
}

/// Returns the position of a row.
fn place_of(row: &Contact) -> Result<Place, Error> {
    let place = row.place();
    place.ok_or_else(|| bug("a table is read by numbers, or by place"))
}

/// Returns the force on a bottom sphere at its contact with the floor. There, a vector may be the force on the floor.
fn upwards(force: Force) -> Force {
    let is_tensile = matches!(force, Force::Both(force, _) if force < 0.0);
    force.map(|vector| {
        let [_, _, z] = vector;
        let is_reversed = (z < 0.0) != is_tensile;
        if is_reversed {
            opposite(vector)
        } else {
            vector
        }
    })
}
