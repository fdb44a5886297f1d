//! The number of rows of a file that were compared, and of those that were left out.

use core::fmt;
use std::collections::BTreeSet;

use super::header::{Header, Row, shortened};
use crate::verify::entry::{Entry, Sink};
use crate::verify::refusal::Refusal;

/// The number of rows of a file that were read and left out.
///
/// # Examples
/// ```
/// use cannonpile::{Packing, Pile};
/// use cannonpile_dem::verify::Reader;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let table = "# a simulation\nid1,id2,force\n1,2,0.46\n1,3,0.46\n#1,4,0.46\nend\n";
/// let rows = Reader::new().compare(&packing, table.as_bytes())?.rows;
/// assert_eq!((rows.used, rows.commented), (2, 1));
/// assert_eq!(rows.to_string(), "1 comment that looks like a row, 1 line of text (line 6)");
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct RowCounts {
    /// The rows that were compared: contacts of spheres, with the floor and with walls.
    pub used: u64,
    /// The rows of another kind than those of `kind=`, and the ghosts in files of VTK.
    pub other_kinds: u64,
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
    /// Counts a row of another kind.
    pub(in crate::verify) fn leave_kind(&mut self, kind: &str) {
        self.other_kinds += 1;
        if self.kinds.len() < MAX_KINDS && !self.kinds.contains(kind) {
            self.kinds.insert(kind.chars().take(40).collect());
        }
    }

    /// Counts a line of text.
    pub(super) fn leave_text(&mut self, line: u64) {
        self.text += 1;
        self.first_text.get_or_insert(line);
    }

    /// Counts a line of numbers above the table.
    pub(super) fn leave_above(&mut self, line: u64) {
        self.above += 1;
        self.first_above.get_or_insert(line);
    }

    /// Forgets the rows of a step, when a later step begins.
    pub(super) fn begin_step(&mut self) {
        self.other_steps +=
            core::mem::take(&mut self.used) + core::mem::take(&mut self.other_kinds);
        self.kinds.clear();
    }

    /// Returns why no contact was matched, with the likeliest remedy.
    pub(in crate::verify) fn reason(&self, by_place: bool) -> String {
        if self.used > 0 {
            let remedy = if by_place {
                "is the table of this scene?"
            } else {
                "are the spheres numbered as in spheres.csv of the export? --first-id 0 counts from 0, and --match place \
                 finds contacts by position"
            };
            let rows = match self.used {
                1 => "1 row was read".to_owned(),
                rows => format!("{rows} rows were read"),
            };
            return format!("{rows}, but none is a contact of the scene: {remedy}");
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
                "no row was read, but {} lines are comments that look like rows: --comment none reads them",
                self.commented
            );
        }
        if self.other_steps > 0 {
            return format!(
                "the step has no rows, but other steps have {}: --step names one of them",
                self.other_steps
            );
        }
        if let Some(line) = self.first_text {
            return format!(
                "no row was read, only text from line {line} on: are the columns those of --columns?"
            );
        }
        "the file has no rows: did the simulation write any contact?".to_owned()
    }
}

impl fmt::Display for RowCounts {
    /// Writes what was left out.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let above = "of numbers above the table";
        let counts = [
            (
                self.other_kinds,
                None,
                "row",
                "of another kind",
                "of other kinds",
            ),
            (
                self.other_steps,
                None,
                "row",
                "of another step",
                "of other steps",
            ),
            (
                self.commented,
                None,
                "comment",
                "that looks like a row",
                "that look like rows",
            ),
            (self.text, self.first_text, "line", "of text", "of text"),
            (self.above, self.first_above, "line", above, above),
        ];
        let parts = counts.into_iter().filter(|(count, ..)| *count > 0);
        let parts = parts.map(|(count, line, what, of_one, of_many)| match (count, line) {
            (1, None) => format!("1 {what} {of_one}"),
            (1, Some(line)) => format!("1 {what} {of_one} (line {line})"),
            (_, None) => format!("{count} {what}s {of_many}"),
            (_, Some(line)) => format!("{count} {what}s {of_many} (from line {line} on)"),
        });
        let parts: Vec<String> = parts.collect();
        f.write_str(&parts.join(", "))
    }
}

/// A sink with the counts of its rows.
pub(in crate::verify) struct Counted<'s, S> {
    sink: &'s mut S,
    pub(in crate::verify) rows: RowCounts,
}

impl<'s, S: Sink> Counted<'s, S> {
    pub(in crate::verify) fn new(sink: &'s mut S) -> Self {
        Self {
            sink,
            rows: RowCounts::default(),
        }
    }
}

impl<S: Sink> Counted<'_, S> {
    /// Reads the cells of a line as a row.
    pub(in crate::verify) fn row(
        &mut self,
        header: &Header,
        cells: &[&str],
        line: u64,
    ) -> Result<(), Refusal> {
        let row = header.read(cells).map_err(|fault| fault.at(line))?;
        self.put(&row, line)
    }

    /// Counts a row, and passes it to the sink if it is a contact.
    pub(super) fn put(&mut self, row: &Row<'_>, line: u64) -> Result<(), Refusal> {
        match row {
            Row::Entry(entry) => self.take(entry, line)?,
            Row::OtherKind(kind) => {
                self.rows.leave_kind(kind);
                self.pass_over();
            }
            Row::Text => self.rows.leave_text(line),
        }
        Ok(())
    }
}

impl<S: Sink> Sink for Counted<'_, S> {
    fn begin_step(&mut self) {
        if self.rows.used + self.rows.other_kinds > 0 {
            self.rows.begin_step();
            self.sink.begin_step();
        }
    }

    fn take(&mut self, entry: &Entry, line: u64) -> Result<(), Refusal> {
        self.rows.used += 1;
        self.sink.take(entry, line)
    }

    fn pass_over(&mut self) {
        self.sink.pass_over();
    }
}
