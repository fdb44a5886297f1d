//! The contacts of a file, row by row.

use std::fs::File;
use std::io::Read;

use crate::contact::{Contact, keep};
use crate::counts::RowCounts;
use crate::dialect::Dialect;
use crate::error::Error;
use crate::format::Format;
use crate::input::Input;
use crate::kind::FileKind;
use crate::steps::Steps;
use crate::text::Text;
use crate::{dump, vtk};

/// The contacts of a file, in its order. A fault of the file is the last item.
///
/// Of a file with several steps, only the rows of the chosen one are returned: the last, unless the [`Format`] names one.
pub struct Contacts<'r> {
    /// The kind of the file.
    pub kind: FileKind,
    /// The dialect, if the file is a text table.
    pub dialect: Option<Dialect>,
    steps: Steps,
    source: Source<'r>,
}

/// The source of the next row.
enum Source<'r> {
    Text(Box<Text<'r>>),
    /// Rows that were read before, and what ended them.
    Read(Box<dyn Iterator<Item = Result<Contact, Error>>>),
}

/// Reads the contacts of a file of any kind, which may be compressed by gzip.
///
/// A text is read line by line. The rows of a LAMMPS dump, of a VTK file and of the last of several steps are kept in memory: eight
/// bytes for each number that is read. Of a VTK file, the whole content is kept too. [`Format::most_rows`] limits both.
///
/// # Errors
/// * [`Error::Kind`] for a file of another kind, such as a spreadsheet.
/// * [`Error::NoColumn`] for a text without the necessary columns, and [`Error::Line`] if its dialect is not clear.
/// * [`Error::NoStep`] for a VTK file, if a step is asked for: these files have none.
/// * [`Error::Io`] for errors of the input.
///
/// All other faults are items of the iterator, such as [`Error::NoStep`] and [`Error::Vtk`].
///
/// # Examples
/// ```
/// use contact_tables::{Contact, Force, Format, Spheres};
///
/// let table = "step,id1,id2,force\n1,1,2,0.9\n2,1,2,0.5\n2,1,3,0.25\n";
/// let mut contacts = contact_tables::read(table.as_bytes(), &Format::default())?;
/// let [first, second] = contacts.by_ref().collect::<Result<Vec<Contact>, _>>()?[..] else { panic!() };
/// assert_eq!((first.spheres, first.force), (Spheres::Numbers([1, 2]), Force::Along(0.5)));
/// assert_eq!(second.line, 4);
/// assert_eq!((contacts.steps(), contacts.step()), (2, Some("2")));
/// # Ok::<(), contact_tables::Error>(())
/// ```
pub fn read<'r>(input: impl Read + 'r, format: &Format) -> Result<Contacts<'r>, Error> {
    let encoding = format.dialect.encoding;
    let most = format.most_bytes();
    let input = Input::open(input, encoding, most)?;
    let kind = FileKind::of(&input.sample);
    let mut contacts = Contacts {
        kind,
        dialect: None,
        steps: Steps::new(format),
        source: Source::Read(Box::new(None.into_iter())),
    };
    let mut rows = Vec::new();
    let steps = &mut contacts.steps;
    let outcome = match kind {
        FileKind::Table => {
            let text = Text::open(input, format)?;
            contacts.dialect = Some(text.dialect.clone());
            // Only the end of the file tells which step is the last.
            let is_kept = text.has_steps() && format.step.is_none();
            contacts.source = Source::Text(Box::new(text));
            if !is_kept {
                return Ok(contacts);
            }
            contacts.keep(&mut rows)
        }
        FileKind::Dump => {
            dump::read(input.all(), format, steps, &mut rows).and_then(|()| steps.close())
        }
        FileKind::VtkXml | FileKind::VtkLegacy => {
            let open = format.folder.as_deref().map(|folder| {
                move |name: &str| {
                    Input::open(File::open(folder.join(name))?, encoding, most)?.bytes()
                }
            });
            let open = open.as_ref().map(|open| open as vtk::Open<'_>);
            // These files have no steps.
            steps.close()?;
            vtk::read(&input.bytes()?, format, open, steps, &mut rows)
        }
        FileKind::Other { .. } => return Err(Error::Kind(kind)),
    };
    let rows = rows.into_iter().map(Ok);
    contacts.source = Source::Read(Box::new(rows.chain(outcome.err().map(Err))));
    Ok(contacts)
}

impl Contacts<'_> {
    /// Returns the number of rows so far, and of those that were left out.
    #[must_use]
    pub const fn rows(&self) -> &RowCounts {
        &self.steps.rows
    }

    /// Returns the number of steps so far; 0 if the file names none.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps.found().0
    }

    /// Returns the step that is read.
    #[must_use]
    pub fn step(&self) -> Option<&str> {
        self.steps.found().1
    }

    /// Reads all rows, and keeps those of the last step.
    fn keep(&mut self, rows: &mut Vec<Contact>) -> Result<(), Error> {
        let mut outcome = Ok(());
        while let Some(contact) = self.next() {
            if self.steps.has_begun() {
                rows.clear();
            }
            match contact {
                Ok(contact) => keep(rows, contact)?,
                Err(error) => outcome = Err(error),
            }
        }
        if self.steps.has_begun() {
            rows.clear();
        }
        outcome
    }
}

impl Iterator for Contacts<'_> {
    type Item = Result<Contact, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let next = match &mut self.source {
            Source::Read(rows) => return rows.next(),
            Source::Text(text) => text.next(&mut self.steps),
        };
        if let Ok(Some(contact)) = next {
            return Some(Ok(contact));
        }
        // Nothing follows the end or a fault.
        self.source = Source::Read(Box::new(None.into_iter()));
        next.and_then(|_| self.steps.close()).err().map(Err)
    }
}
