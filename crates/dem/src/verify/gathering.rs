//! Rows with positions, stored until the frame of the table is known.

use num_traits::ToPrimitive;

use super::entry::{Entry, Force, Place, Sink};
use super::frame::Frame;
use super::ledger::Ledger;
use super::places::{Places, loaded_points};
use super::refusal::Refusal;
use super::registration::{self, Exact, moved};
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
    kept: Vec<Row>,
    /// True if the frame of the table is that of the scene.
    is_own: bool,
}

struct Row {
    place: Place,
    force: Force,
    line: u64,
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

    fn frame(&self, kept: &[Row]) -> Result<Frame, Refusal> {
        let table: Vec<_> = kept
            .iter()
            .map(|row| (row.place, row.force.magnitude()))
            .collect();
        let (points, forces) = loaded_points(self.ledger.numbered())?;
        let exact = Exact {
            points: &points,
            places: &self.places,
            force: &|ids| {
                let slot = self.ledger.slot(ids);
                let force = slot.and_then(|slot| forces.get(slot));
                // Not a default: spheres without a contact have no force.
                force.copied().unwrap_or(0.0)
            },
        };
        let fit = registration::find(&table, &exact, self.radius, self.within);
        if 2 * fit.found < fit.sample {
            let (found, sample) = (fit.found, fit.sample);
            return Err(Refusal::Elsewhere { found, sample });
        }
        Ok(fit.frame)
    }

    fn give(&mut self, row: &Row, frame: &Frame) -> Result<(), Refusal> {
        let ids = match self.places.find(&moved(&row.place, frame), self.within) {
            Ok([one, other]) if one != other => [one, other],
            // A row that matches no contact is ignored if its force is 0.
            _ if row.force.magnitude() == 0.0 => return Ok(()),
            Ok(ids) => ids,
            Err(fault) => return Err(fault.at(row.line)),
        };
        let force = row.force.map(|vector| frame.turned(vector));
        let measured = match row.place {
            Place::Centres(_) => self.places.on_first(force, ids)?,
            Place::Point(_) => self.places.on_either(force, ids)?,
        };
        let admitted = self.ledger.admit(&measured, row.line);
        admitted.map_err(|fault| fault.at(row.line))
    }

    fn all_fit(&self) -> bool {
        let mut kept = self.kept.iter();
        kept.all(|row| self.places.find(&row.place, self.within).is_ok())
    }
}

impl Sink for Gathering<'_> {
    fn begin_snapshot(&mut self, timestep: Option<i64>) {
        self.kept.clear();
        self.is_own = false;
        self.ledger.begin_snapshot(timestep);
    }

    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal> {
        let row = Row {
            place: entry.place()?,
            force: entry.force,
            line,
        };
        if self.is_own {
            return self.give(&row, &Frame::OWN);
        }
        self.kept.push(row);
        if self.kept.len() == ENOUGH && self.all_fit() {
            self.is_own = true;
            for row in core::mem::take(&mut self.kept) {
                self.give(&row, &Frame::OWN)?;
            }
        }
        Ok(())
    }

    fn pass_over(&mut self) {
        self.ledger.pass_over();
    }
}
