//! A row of a table: two spheres, known by their numbers or by where they are, and the force between them.

use super::measured::Measured;
use super::refusal::{Fault, Refusal};

/// A row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) ids: Option<[u64; 2]>,
    pub(super) place: Option<Place>,
    pub(super) force: Option<f64>,
    pub(super) vector: Option<[f64; 3]>,
}

/// Where a contact is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// The centres of both spheres.
    Centres([[f64; 3]; 2]),
    /// The point where they touch.
    Point([f64; 3]),
}

impl Entry {
    /// Returns the force between two spheres.
    pub(super) fn between(&self, ids: [u64; 2]) -> Measured {
        match (self.force, self.vector) {
            (Some(force), Some(vector)) => Measured::new(ids, force).with_vector(vector),
            (None, Some(vector)) => Measured::of_vector(ids, vector),
            // A row has one of the two.
            (force, None) => Measured::new(ids, force.unwrap_or(f64::NAN)),
        }
    }

    /// Returns the force between the two spheres that it names.
    pub(super) fn named(&self) -> Result<Measured, Fault> {
        let ids = self.ids.ok_or(Fault::NoColumn {
            column: "id1",
            found: String::new(),
        })?;
        Ok(self.between(ids))
    }
}

/// What takes the rows of a file.
pub(super) trait Sink {
    /// Forgets what there was: another snapshot follows.
    fn begin_snapshot(&mut self, timestep: Option<i64>);

    /// Takes a row of a line.
    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal>;

    /// Takes note of a contact with a wall.
    fn pass_over(&mut self);
}
