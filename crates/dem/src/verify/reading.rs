//! The measured forces in a file, without a pile.

use super::entry::{Entry, Sink};
use super::measured::{MAX_ENTRIES, Measured};
use super::refusal::{Fault, Refusal};

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
}

impl Sink for Reading {
    fn begin_step(&mut self) {
        self.entries.clear();
    }

    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal> {
        if self.entries.len() as u64 >= MAX_ENTRIES {
            let limit = MAX_ENTRIES;
            return Err(Fault::TooMany { limit }.at(line));
        }
        let measured = entry.named().map_err(|fault| fault.at(line))?;
        // The length of a vector may overflow.
        if !measured.force.is_finite() {
            let (column, value) = ("force", measured.force);
            return Err(Fault::NotFinite { column, value }.at(line));
        }
        self.entries.push(measured);
        Ok(())
    }

    fn pass_over(&mut self) {}
}
