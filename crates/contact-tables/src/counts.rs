//! The number of rows of a file that were compared, and of those that were left out.

use core::fmt;
use std::collections::BTreeSet;

use crate::contact::Contact;
use crate::error::shortened;
use crate::header::Row;

/// The number of rows of a file that were read and left out.
///
/// # Examples
/// ```
/// let table = "# a simulation\nid1,id2,force\n1,2,0.46\n1,3,0.46\n#1,4,0.46\nend\n";
/// let mut contacts = contact_tables::read(table.as_bytes(), &Default::default())?;
/// assert_eq!(contacts.by_ref().count(), 2);
/// let rows = contacts.rows();
/// assert_eq!((rows.used, rows.commented), (2, 1));
/// assert_eq!(rows.to_string(), "1 comment that looks like a row, 1 line of text (line 6)");
/// # Ok::<(), contact_tables::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct RowCounts {
    /// The rows that were read.
    pub used: u64,
    /// The rows of another kind than those of `kind=`, and the ghosts in files of VTK.
    pub other_kinds: u64,
    /// The ghosts among them.
    pub ghosts: u64,
    /// The rows of other steps.
    pub other_steps: u64,
    /// The comments that look like rows.
    pub commented: u64,
    /// The lines below the first row that have no number where a row has one.
    pub text: u64,
    /// The first such line.
    pub first_text: Option<u64>,
    /// The lines of numbers above the table that are not rows of it.
    pub above: u64,
    /// The first such line.
    pub first_above: Option<u64>,
    /// Some kinds of rows that were left out.
    pub kinds: BTreeSet<String>,
}

/// The largest number of kinds that are kept.
const MAX_KINDS: usize = 5;

impl RowCounts {
    /// Counts a row, and returns it if it is a contact.
    pub(crate) fn count(&mut self, row: &Row<'_>, line: u64) -> Option<Contact> {
        match row {
            Row::Contact(contact) => {
                self.used += 1;
                return Some(*contact);
            }
            Row::OtherKind(kind) => self.leave_kind(kind),
            Row::Text => self.leave_text(line),
        }
        None
    }

    /// Counts a ghost.
    pub(crate) fn leave_ghost(&mut self) {
        self.ghosts += 1;
        self.leave_kind("ghost");
    }

    /// Counts a row of another kind.
    fn leave_kind(&mut self, kind: &str) {
        self.other_kinds += 1;
        if self.kinds.len() < MAX_KINDS && !self.kinds.contains(kind) {
            self.kinds.insert(kind.chars().take(40).collect());
        }
    }

    /// Counts a line of text.
    fn leave_text(&mut self, line: u64) {
        self.text += 1;
        self.first_text.get_or_insert(line);
    }

    /// Counts a line of numbers above the table.
    pub(crate) fn leave_above(&mut self, line: u64) {
        self.above += 1;
        self.first_above.get_or_insert(line);
    }

    /// Forgets the rows of a step, when a later step begins.
    pub(crate) fn begin_step(&mut self) {
        self.other_steps +=
            core::mem::take(&mut self.used) + core::mem::take(&mut self.other_kinds);
        self.ghosts = 0;
        self.kinds.clear();
    }

    /// Returns why no row was read, with the likeliest remedy.
    ///
    /// # Examples
    /// ```
    /// let mut contacts = contact_tables::read(&b"id1,id2,force\n"[..], &Default::default())?;
    /// assert!(contacts.next().is_none());
    /// let reason = contacts.rows().why_none();
    /// assert_eq!(reason, "the file has no rows: did the simulation write any contact?");
    /// # Ok::<(), contact_tables::Error>(())
    /// ```
    #[must_use]
    pub fn why_none(&self) -> String {
        if self.ghosts > 0 && self.ghosts == self.other_kinds {
            return format!(
                "all {} rows are ghosts: give the piece that owns them",
                self.ghosts
            );
        }
        if self.other_kinds > 0 {
            let kinds: Vec<&str> = self.kinds.iter().map(String::as_str).collect();
            return format!(
                "no row has the kind that is asked for, but {} rows have others, such as {}: name these in kind=COLUMN:VALUE",
                self.other_kinds,
                shortened(&kinds)
            );
        }
        if self.commented > 0 {
            return format!(
                "no row was read, but {} lines are comments that look like rows: set comment to none to read them",
                self.commented
            );
        }
        if self.other_steps > 0 {
            return format!(
                "the step has no rows, but other steps have {}: choose one of them as step",
                self.other_steps
            );
        }
        if let Some(line) = self.first_text {
            return format!(
                "no row was read, only text from line {line} on: are these the columns of the table?"
            );
        }
        "the file has no rows: did the simulation write any contact?".to_owned()
    }
}

/// The names of the rows that are left out: of one, and of several.
const OTHER_KINDS: [&str; 2] = ["row of another kind", "rows of other kinds"];
const OTHER_STEPS: [&str; 2] = ["row of another step", "rows of other steps"];
const COMMENTED: [&str; 2] = [
    "comment that looks like a row",
    "comments that look like rows",
];
const TEXT: [&str; 2] = ["line of text", "lines of text"];
const ABOVE: [&str; 2] = [
    "line of numbers above the table",
    "lines of numbers above the table",
];

impl fmt::Display for RowCounts {
    /// Writes what was left out.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts = [
            (self.other_kinds, None, OTHER_KINDS),
            (self.other_steps, None, OTHER_STEPS),
            (self.commented, None, COMMENTED),
            (self.text, self.first_text, TEXT),
            (self.above, self.first_above, ABOVE),
        ];
        let parts = counts.into_iter().filter(|(count, ..)| *count > 0);
        let parts = parts.map(|(count, line, [one, many])| match (count, line) {
            (1, None) => format!("1 {one}"),
            (1, Some(line)) => format!("1 {one} (line {line})"),
            (_, None) => format!("{count} {many}"),
            (_, Some(line)) => format!("{count} {many} (from line {line} on)"),
        });
        let parts: Vec<String> = parts.collect();
        f.write_str(&parts.join(", "))
    }
}
