//! The steps of a file: which one is read.

use std::collections::BTreeSet;

use super::counts::Counted;
use super::header::shortened;
use super::number::number;
use crate::verify::entry::Sink;
use crate::verify::refusal::{Fault, Refusal};

/// The steps that were found so far.
pub(in crate::verify) struct Steps<'o> {
    /// The step that the user asked for.
    wanted: Option<&'o str>,
    seen: BTreeSet<String>,
    current: Option<String>,
}

impl<'o> Steps<'o> {
    pub(in crate::verify) fn new(wanted: Option<&'o str>) -> Self {
        Self {
            wanted,
            seen: BTreeSet::new(),
            current: None,
        }
    }

    /// Returns whether the next row, which is of this step, is read. The last step is read, unless another is wanted. A
    /// later step discards the rows of the earlier ones.
    pub(in crate::verify) fn reads(
        &mut self,
        step: &str,
        sink: &mut Counted<'_, impl Sink>,
    ) -> Result<bool, Fault> {
        if self.current.as_deref() == Some(step) {
            return Ok(true);
        }
        let is_new = !self.seen.contains(step);
        if is_new {
            self.seen.insert(step.to_owned());
        }
        if let Some(wanted) = self.wanted {
            if !is_same_step(wanted, step) {
                return Ok(false);
            }
        } else if !is_new {
            return Err(Fault::StepAgain {
                step: shortened(&[step]),
            });
        }
        let before = self.current.replace(step.to_owned());
        // Two spellings of the wanted step are one step.
        if self.wanted.is_none() || before.is_none() {
            sink.begin_step();
        }
        Ok(true)
    }

    /// Returns the number of steps of the file, and the step that was read.
    ///
    /// # Errors
    /// The wanted step was not found.
    pub(in crate::verify) fn close(self) -> Result<(u64, Option<String>), Refusal> {
        match (self.wanted, &self.current) {
            (Some(wanted), None) => {
                let seen: Vec<&str> = self.seen.iter().map(String::as_str).collect();
                Err(Refusal::NoStep {
                    wanted: shortened(&[wanted]),
                    found: shortened(&seen),
                })
            }
            _ => Ok((self.seen.len() as u64, self.current)),
        }
    }
}

/// Returns whether a step is the wanted one, as text or as a number.
pub(in crate::verify) fn is_same_step(wanted: &str, step: &str) -> bool {
    let value = |text: &str| number(text, text.contains(','));
    wanted == step || value(wanted).is_some_and(|wanted| value(step) == Some(wanted))
}
