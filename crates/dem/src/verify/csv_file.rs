//! Measured forces in tables with separated values.

use std::io::{self, BufRead, Read};

use csv::{ErrorKind, ReaderBuilder, StringRecord, Trim};

use super::columns::Columns;
use super::entry::Sink;
use super::header::{Header, Identity};
use super::lines::Lines;
use super::reading::Reading;
use super::refusal::{Fault, Refusal};

/// Reads a csv table: one line with the names of the columns, then one line for each contact.
///
/// Columns are found by name, in any order: `id1`, `id2`, `force`, and `fx`, `fy`, `fz` for vectors. With vectors,
/// `force` may be omitted. The names `patom1` and `patom2`, or `natom1` and `natom2`, stand for `id1` and `id2`. Other
/// columns are ignored.
///
/// Fields may be quoted. Blanks around fields and empty lines are ignored. A force is any finite decimal number,
/// correctly rounded to `f64`. The last line may lack its end. A truncated table cannot be recognised: the lost
/// contacts count as missing.
///
/// # Errors
/// [`Refusal::Line`]; [`Refusal::Io`].
///
/// # Examples
/// ```
/// use cannonpile_dem::verify;
/// use cannonpile_dem::verify::Measured;
///
/// let csv = "force,\"id1\",note,id2\r\n0.5,1,,2\r\n2.5e-1,3,\"a, b\",1\r\n";
/// let reading = verify::read_csv(csv.as_bytes())?;
/// assert_eq!(reading.entries(), [Measured::new([1, 2], 0.5), Measured::new([3, 1], 0.25)]);
/// assert_eq!(reading.line(1), 3);
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
pub fn read_csv(input: impl BufRead) -> Result<Reading, Refusal> {
    let mut reading = Reading::default();
    read_rows(Lines::new(input), &Format::default(), &mut reading)?;
    Ok(reading)
}

/// Reads the rows of a table with commas, semicolons, tabs or spaces as separators.
pub(super) fn read_rows(
    mut lines: Lines<impl BufRead>,
    format: &Format,
    sink: &mut impl Sink,
) -> Result<(), Refusal> {
    let Some(head) = find_head(&mut lines, format)? else {
        return Err(Fault::Empty.at(lines.number()));
    };
    if head.separator == Separator::Spaces {
        while let Some(line) = lines.next()? {
            if !is_row(line.text) {
                continue;
            }
            let fields: Vec<&str> = line.text.split_whitespace().collect();
            take(&head.header, &fields, line.number, sink)?;
        }
        return Ok(());
    }
    let mut csv = records(LineByLine::new(lines), head.separator);
    let mut row = StringRecord::new();
    loop {
        let read = csv.read_record(&mut row);
        let source = csv.get_mut();
        if let Some(refusal) = source.refusal.take() {
            return Err(refusal);
        }
        // Each row is one line, and the reader has read no further.
        let line = source.lines.number();
        if !read.map_err(io_error)? {
            return Ok(());
        }
        unquote(&mut row);
        let fields: Vec<&str> = row.iter().collect();
        take(&head.header, &fields, line, sink)?;
    }
}

/// The format of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Format {
    pub(super) columns: Columns,
    pub(super) identity: Identity,
}

/// Reads one row and passes it to a sink.
pub(super) fn take(
    header: &Header,
    fields: &[&str],
    line: u64,
    sink: &mut impl Sink,
) -> Result<(), Refusal> {
    let Some(entry) = header.read(fields).map_err(|fault| fault.at(line))? else {
        sink.pass_over();
        return Ok(());
    };
    sink.take(&entry, line)
}

/// The header and the separator, found in the first lines of a table.
struct Head {
    header: Header,
    separator: Separator,
}

/// The separator between two fields.
#[derive(Clone, Copy, PartialEq)]
enum Separator {
    Byte(u8),
    Spaces,
}

impl Separator {
    /// Returns the separator of a line.
    fn of(line: &str) -> Self {
        let marks = [',', ';', '\t'];
        let mark = marks.into_iter().find(|mark| line.contains(*mark));
        match mark.and_then(|mark| u8::try_from(mark).ok()) {
            Some(byte) => Self::Byte(byte),
            None if line.trim().contains(char::is_whitespace) => Self::Spaces,
            None => Self::Byte(b','),
        }
    }
}

/// Finds the header of a table, and leaves the first row unread. Returns `None` for an empty table.
///
/// A header may be a comment after #. The last comment with the necessary names counts.
fn find_head(lines: &mut Lines<impl BufRead>, format: &Format) -> Result<Option<Head>, Refusal> {
    let Format { columns, identity } = format;
    let mut commented = None;
    loop {
        let Some(line) = lines.next()? else {
            return Ok(commented);
        };
        let (number, text) = (line.number, line.text.trim());
        if text.is_empty() {
            continue;
        }
        let (text, is_comment) = match text.strip_prefix('#') {
            Some(rest) => (rest.trim_start_matches('#').trim(), true),
            None => (text, false),
        };
        let separator = Separator::of(text);
        if columns.are_numbered() && !is_comment {
            lines.put_back();
            let header = Header::numbered(columns, *identity).map_err(|fault| fault.at(number))?;
            return Ok(Some(Head { header, separator }));
        }
        if commented.is_some() && !is_comment {
            lines.put_back();
            // The rows may use another separator than the comment with the names.
            return Ok(commented.map(|head| Head { separator, ..head }));
        }
        let header = names(text, separator, number).and_then(|names| {
            let names = names.iter().map(String::as_str);
            Header::find(names, columns, *identity).map_err(|fault| fault.at(number))
        });
        match header {
            Ok(header) if is_comment => commented = Some(Head { header, separator }),
            Ok(header) => return Ok(Some(Head { header, separator })),
            Err(_) if is_comment => {}
            Err(refusal) => return Err(refusal),
        }
    }
}

/// Returns the names in a header.
fn names(text: &str, separator: Separator, number: u64) -> Result<Vec<String>, Refusal> {
    if separator == Separator::Spaces {
        return Ok(text.split_whitespace().map(str::to_owned).collect());
    }
    if has_open_quote(text) {
        return Err(Fault::Quote.at(number));
    }
    let mut row = StringRecord::new();
    let mut csv = records(text.as_bytes(), separator);
    csv.read_record(&mut row).map_err(io_error)?;
    unquote(&mut row);
    Ok(row.iter().map(str::to_owned).collect())
}

fn records<R: Read>(source: R, separator: Separator) -> csv::Reader<R> {
    let mark = match separator {
        Separator::Byte(mark) => mark,
        Separator::Spaces => b' ',
    };
    ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(mark)
        .trim(Trim::All)
        .from_reader(source)
}

/// Returns whether a line is a row, which is neither empty nor a comment.
fn is_row(line: &str) -> bool {
    let line = line.trim_start();
    !line.is_empty() && !line.starts_with('#')
}

/// Returns whether the line ends inside a quoted field. Such a field would absorb the following lines.
fn has_open_quote(line: &str) -> bool {
    line.bytes().filter(|byte| *byte == b'"').count() % 2 == 1
}

/// Removes quotes from fields with blanks before the quote. The csv reader does not recognise those quotes.
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

/// A source that yields at most one line at a time, and rejects lines that cannot be rows.
struct LineByLine<R> {
    lines: Lines<R>,
    /// The current line with its end, and the number of bytes already read.
    line: Vec<u8>,
    given: usize,
    /// The reason why no further line is available.
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

    /// Moves to the next row. Returns false at the end of the table.
    fn advance(&mut self) -> Result<bool, Refusal> {
        while let Some(line) = self.lines.next()? {
            if !is_row(line.text) {
                continue;
            }
            if has_open_quote(line.text) {
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

/// Converts an error of the csv reader. Only input errors can occur, because the lines were already checked to be text.
fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        ErrorKind::Io(error) => error,
        kind => io::Error::other(format!("{kind:?}")),
    }
}
