//! The measured forces in a file, without a pile.

use contact_tables::{Contact, Spheres};

use super::measured::{MAX_ENTRIES, Measured};
use super::refusal::{Fault, Refusal};
use crate::Each;
use crate::error::bug;

/// Measured forces read from a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    entries: Vec<Measured>,
}

impl Reading {
    /// Returns the measured forces, in the order of the file.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify;
    /// use cannonpile_dem::verify::Measured;
    ///
    /// let reading = verify::read(&b"id1,id2,force\n3,1,0.25\n1,2,0.5\n"[..])?;
    /// assert_eq!(reading.entries(), [Measured::new([3, 1], 0.25), Measured::new([1, 2], 0.5)]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn entries(&self) -> &[Measured] {
        &self.entries
    }

    /// Appends a row.
    pub(super) fn take(&mut self, row: &Contact) -> Result<(), Refusal> {
        if self.entries.len() as u64 >= MAX_ENTRIES {
            let limit = MAX_ENTRIES;
            return Err(Fault::TooMany { limit }.at(row.line));
        }
        let measured = Measured::of(numbers(row)?, row);
        // The length of a vector may overflow.
        if !measured.force.is_finite() {
            let (column, value) = ("force", measured.force);
            return Err(Fault::NotFinite { column, value }.at(row.line));
        }
        self.entries.push(measured);
        Ok(())
    }
}

/// Returns the numbers of the two spheres of a row, if none is negative.
fn numbers(row: &Contact) -> Result<[u64; 2], Refusal> {
    let Spheres::Numbers(ids) = row.spheres else {
        return Err(bug("a table is read by numbers").into());
    };
    match ids.each(u64::try_from) {
        [Ok(one), Ok(other)] => Ok([one, other]),
        [first, _] => {
            let (column, id) = match (first, ids) {
                (Err(_), [id, _]) => ("id1", id),
                (Ok(_), [_, id]) => ("id2", id),
            };
            let (line, reason) = (
                row.line,
                format!("{column} '{id}' is not a number of at least 0"),
            );
            Err(contact_tables::Error::Line { line, reason }.into())
        }
    }
}
