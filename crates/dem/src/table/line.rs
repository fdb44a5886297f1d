//! The texts of one row.

use core::fmt::{Display, Write};

/// The texts of a row in one buffer, which the next row reuses.
#[derive(Clone, Debug, Default)]
pub(super) struct Line {
    text: String,
    /// The end of each text in the buffer.
    ends: Vec<usize>,
}

impl Line {
    pub(super) fn clear(&mut self) {
        self.text.clear();
        self.ends.clear();
    }

    pub(super) fn push(&mut self, text: impl Display) {
        // Writing to a String does not fail.
        let _ = write!(self.text, "{text}");
        self.ends.push(self.text.len());
    }

    /// Adds a text without formatting, which is faster than `push`.
    pub(super) fn push_str(&mut self, text: &str) {
        self.text.push_str(text);
        self.ends.push(self.text.len());
    }

    pub(super) fn fields(&self) -> impl Iterator<Item = &str> {
        let begins = core::iter::once(0).chain(self.ends.iter().copied());
        let ranges = begins.zip(self.ends.iter().copied());
        // Each range is within the text, and its ends are character boundaries.
        ranges.filter_map(|(begin, end)| self.text.get(begin..end))
    }
}
