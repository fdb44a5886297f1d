//! The rows and steps of a file: which step is read.

use std::collections::BTreeSet;

use crate::contact::Contact;
use crate::counts::RowCounts;
use crate::error::{Error, Fault, shortened};
use crate::format::Format;
use crate::header::Row;
use crate::number::number;

/// The largest number of steps in a table. Each is kept, to refuse one that comes again.
const MOST_STEPS: usize = 1 << 20;

/// The rows and steps that were found so far.
pub(crate) struct Steps {
    pub(crate) rows: RowCounts,
    /// The step that the user asked for.
    wanted: Option<String>,
    /// The largest number of rows in a step.
    most_rows: Option<u64>,
    seen: BTreeSet<String>,
    current: Option<String>,
    has_begun: bool,
}

impl Steps {
    pub(crate) fn new(format: &Format) -> Self {
        Self {
            rows: RowCounts::default(),
            wanted: format.step.clone(),
            most_rows: format.most_rows,
            seen: BTreeSet::new(),
            current: None,
            has_begun: false,
        }
    }

    /// Returns whether the next row, which is of this step, is read. The last step is read, unless another is wanted. A
    /// later step discards the rows of the earlier ones.
    pub(crate) fn reads(&mut self, step: &str) -> Result<bool, Fault> {
        if self.current.as_deref() == Some(step) {
            return Ok(true);
        }
        if step.trim().is_empty() {
            return Err(Fault::new("this row has no step: give every row one"));
        }
        let is_new = !self.seen.contains(step);
        if is_new {
            if self.seen.len() >= MOST_STEPS {
                return Err(Fault::new(format!(
                    "more than {MOST_STEPS} steps: name the column of the steps with step=COLUMN"
                )));
            }
            self.seen.insert(step.to_owned());
        }
        if let Some(wanted) = &self.wanted {
            if !is_same_step(wanted, step) {
                return Ok(false);
            }
        } else if !is_new {
            return Err(Fault::new(format!(
                "step {} again, after another step: choose one of them as step",
                shortened(&[step])
            )));
        }
        let before = self.current.replace(step.to_owned());
        // Two spellings of the wanted step are one step.
        if self.wanted.is_none() || before.is_none() {
            self.has_begun = true;
            self.rows.begin_step();
        }
        Ok(true)
    }

    /// Counts a row, and returns it if it is a contact. A row beyond the largest number of rows is refused.
    pub(crate) fn count(&mut self, row: &Row<'_>, line: u64) -> Result<Option<Contact>, Error> {
        let contact = self.rows.count(row, line);
        match self.most_rows.filter(|most| *most < self.rows.used) {
            None => Ok(contact),
            Some(most) => Err(Fault::new(format!(
                "more than {most} rows, the most that are read: leave out pairs that do not touch, or name the column of \
                 the steps with step=COLUMN"
            ))
            .at(line)),
        }
    }

    /// Returns whether a step has begun since the last call, so that earlier rows are discarded.
    pub(crate) fn has_begun(&mut self) -> bool {
        core::mem::take(&mut self.has_begun)
    }

    /// Refuses a file without the wanted step.
    pub(crate) fn close(&self) -> Result<(), Error> {
        match (&self.wanted, &self.current) {
            (Some(wanted), None) => {
                let seen: Vec<&str> = self.seen.iter().map(String::as_str).collect();
                Err(Error::NoStep {
                    wanted: shortened(&[wanted]),
                    found: shortened(&seen),
                })
            }
            _ => Ok(()),
        }
    }

    /// Returns the number of steps, and the step that was read.
    pub(crate) fn found(&self) -> (u64, Option<&str>) {
        (self.seen.len() as u64, self.current.as_deref())
    }
}

/// Returns whether two steps are the same, as text or as numbers.
///
/// # Examples
/// ```
/// assert!(contact_tables::is_same_step("1e3", "1000"));
/// ```
#[must_use]
pub fn is_same_step(one: &str, other: &str) -> bool {
    let value = |text: &str| number(text, text.contains(','));
    one == other || value(one).is_some_and(|one| value(other) == Some(one))
}
