//! Measured forces from comma-separated values.

use std::io::{self, BufRead, Read};

use csv::{ErrorKind, ReaderBuilder, StringRecord, Trim};

use super::columns::Columns;
use super::lines::Lines;
use super::reading::Reading;
use super::refusal::{Fault, Refusal};

/// Reads a csv table: a line with the names of the columns, and a line a contact.
///
/// Columns are found by name, in any order: `id1`, `id2`, `force`, and `fx`, `fy`, `fz` if there are vectors, where `force`
/// may be left out; `patom1` and `patom2`, or `natom1` and `natom2`, stand for `id1` and `id2`. Others are passed over. Fields may be quoted; blanks
/// around them and empty lines do not count. A force is any finite decimal, and read as the nearest `f64`. The last line
/// need not end: what is cut off a csv table cannot be seen, and shows as missing contacts.
///
/// # Errors
/// [`Refusal::Line`]; [`Refusal::Io`].
///
/// # Examples
/// ```
/// use cannonpile::verify::{self, Measured};
///
/// let csv = "force,\"id1\",note,id2\r\n0.5,1,,2\r\n2.5e-1,3,\"a, b\",1\r\n";
/// let reading = verify::read_csv(csv.as_bytes())?;
/// assert_eq!(reading.entries(), [Measured::new([1, 2], 0.5), Measured::new([3, 1], 0.25)]);
/// assert_eq!(reading.line(1), 3);
/// # Ok::<(), cannonpile::verify::Refusal>(())
/// ```
pub fn read_csv(input: impl BufRead) -> Result<Reading, Refusal> {
    read_rows(Lines::new(input), Reading::default())
}

pub(super) fn read_rows(
    lines: Lines<impl BufRead>,
    mut reading: Reading,
) -> Result<Reading, Refusal> {
    let mut csv = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(LineByLine::new(lines));
    let mut row = StringRecord::new();
    let mut columns = None;
    loop {
        let read = csv.read_record(&mut row);
        let source = csv.get_mut();
        if let Some(refusal) = source.refusal.take() {
            return Err(refusal);
        }
        // A row is a line: it has been read whole, and no more.
        let line = source.lines.number();
        if !read.map_err(io_error)? {
            break;
        }
        unquote(&mut row);
        let Some(columns) = &columns else {
            let header = Columns::new(&row).map_err(|fault| fault.at(line))?;
            columns = Some(header);
            continue;
        };
        let pushed = columns
            .read(&row)
            .and_then(|measured| reading.push(measured, line));
        pushed.map_err(|fault| fault.at(line))?;
    }
    match columns {
        Some(_) => Ok(reading),
        None => Err(Fault::Empty.at(csv.get_ref().lines.number())),
    }
}

/// Takes the quotes off fields that have blanks before them, where a reader sees no quote.
fn unquote(row: &mut StringRecord) {
    if !row.iter().any(|field| field.starts_with('"')) {
        return;
    }
    let bare = |field: &str| {
        let inside = field
            .strip_prefix('"')
            .and_then(|rest| rest.strip_suffix('"'));
        inside.unwrap_or(field).trim().to_owned()
    };
    *row = row.iter().map(bare).collect();
}

/// A source that gives no more than a line at a time, and refuses those that are no rows of a table.
struct LineByLine<R> {
    lines: Lines<R>,
    /// The line that is being given, with its end, and how much of it has been.
    line: Vec<u8>,
    given: usize,
    /// Why there are no more.
    refusal: Option<Refusal>,
}

impl<R: BufRead> LineByLine<R> {
    fn new(lines: Lines<R>) -> Self {
        Self {
            lines,
            line: Vec::new(),
            given: 0,
            refusal: None,
        }
    }

    /// Goes to the next line that is not blank; false at the end.
    fn advance(&mut self) -> Result<bool, Refusal> {
        while let Some(line) = self.lines.next()? {
            if line.text.trim().is_empty() {
                continue;
            }
            // A quoted field that ends on another line would take what follows with it.
            if line.text.bytes().filter(|byte| *byte == b'"').count() % 2 == 1 {
                return Err(Fault::Quote.at(line.number));
            }
            self.line.clear();
            self.line.extend_from_slice(line.text.as_bytes());
            self.line.push(b'\n');
            self.given = 0;
            return Ok(true);
        }
        Ok(false)
    }
}

impl<R: BufRead> Read for LineByLine<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.given == self.line.len() {
            match self.advance() {
                Ok(true) => {}
                Ok(false) => return Ok(0),
                Err(refusal) => {
                    self.refusal = Some(refusal);
                    return Err(io::ErrorKind::InvalidData.into());
                }
            }
        }
        let mut rest = self.line.get(self.given..).unwrap_or(&[]);
        let read = rest.read(buffer)?;
        self.given += read;
        Ok(read)
    }
}

/// What the reader of csv cannot read is not text, or not there; text has been checked.
fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        ErrorKind::Io(error) => error,
        kind => io::Error::other(format!("{kind:?}")),
    }
}
