//! The dialect of a text table: how it separates cells, writes numbers and marks comments.
//!
//! The dialect is decided by what cuts all rows alike. Each separator and quote is tried on the first lines. The choice
//! is the one that makes most of the text numbers in rows of equal length.

use core::cmp::Reverse;
use core::fmt;
use core::str::FromStr;

use encoding_rs::Encoding;

use super::columns::Columns;
use super::cut::cut;
use super::header::{Header, Identity};
use super::lines::Lines;
use super::number::{is_number, number};
use crate::Error;
use crate::verify::refusal::{Fault, Refusal};

/// The separator between the cells of a line.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::Separator;
///
/// assert_eq!("tab".parse(), Ok(Separator::Char('\t')));
/// assert_eq!("blanks".parse(), Ok(Separator::Blanks));
/// assert!("ab".parse::<Separator>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// One character, such as a comma.
    Char(char),
    /// Any number of blanks and tabs.
    Blanks,
}

impl FromStr for Separator {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match text {
            "blanks" => Ok(Self::Blanks),
            "tab" => Ok(Self::Char('\t')),
            _ => one_char(text, "a separator: one character, tab or blanks").map(Self::Char),
        }
    }
}

impl fmt::Display for Separator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Blanks => f.write_str("blanks"),
            Self::Char(',') => f.write_str("commas"),
            Self::Char(';') => f.write_str("semicolons"),
            Self::Char('\t') => f.write_str("tabs"),
            Self::Char(mark) => write!(f, "{mark:?}"),
        }
    }
}

fn one_char(text: &str, expected: &'static str) -> Result<char, Error> {
    let mut chars = text.chars();
    match (chars.next(), chars.next()) {
        (Some(char), None) => Ok(char),
        _ => Err(Error::syntax(text, expected)),
    }
}

/// What the user says about the dialect of a text table. The first lines of the table decide what is `None`.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::{DialectOptions, Reader, Separator};
///
/// let options = DialectOptions { separator: Some(Separator::Blanks), ..DialectOptions::default() };
/// assert_ne!(Reader::new().with_dialect(options), Reader::new());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DialectOptions {
    /// The encoding, by its name of the web, such as `utf-16le` or `shift_jis`.
    pub encoding: Option<TextEncoding>,
    /// The separator of cells.
    pub separator: Option<Separator>,
    /// The quote around a cell that contains separators, or none.
    pub quote: Option<Mark>,
    /// The beginning of a line that is a comment, or none.
    pub comment: Option<Mark>,
    /// True for decimal commas, false for decimal points.
    pub decimal_comma: Option<bool>,
    /// The number of lines before the table.
    pub skip: Option<u64>,
    /// Whether the row below the header has units instead of numbers.
    pub unit_row: Option<bool>,
}

/// A sign with a meaning, or none.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::Mark;
///
/// assert_eq!("none".parse::<Mark>()?.get(), None);
/// assert_eq!("//".parse::<Mark>()?.get(), Some("//"));
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark(Option<String>);

impl Mark {
    /// Returns the sign.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Mark;
    ///
    /// assert_eq!("#".parse::<Mark>()?.get(), Some("#"));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn get(&self) -> Option<&str> {
        self.0.as_deref()
    }
}

impl FromStr for Mark {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match text {
            "" => Err(Error::syntax(text, "a sign such as #, or none")),
            "none" => Ok(Self(None)),
            mark => Ok(Self(Some(mark.to_owned()))),
        }
    }
}

/// The encoding of a text.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::TextEncoding;
///
/// assert_eq!("latin1".parse::<TextEncoding>()?.name(), "windows-1252");
/// assert!("utf-12".parse::<TextEncoding>().is_err());
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextEncoding(&'static Encoding);

impl TextEncoding {
    /// Returns the name of the encoding.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::TextEncoding;
    ///
    /// assert_eq!("UTF8".parse::<TextEncoding>()?.name(), "UTF-8");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn name(self) -> &'static str {
        self.0.name()
    }

    pub(in crate::verify) fn get(self) -> &'static Encoding {
        self.0
    }
}

impl FromStr for TextEncoding {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let found = Encoding::for_label(text.as_bytes()).map(Self);
        found.ok_or_else(|| {
            Error::syntax(text, "an encoding such as utf-8, utf-16le or windows-1252")
        })
    }
}

/// The dialect of a text table.
///
/// # Examples
/// ```
/// use cannonpile::{Packing, Pile};
/// use cannonpile_dem::verify::Reader;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let table = "measured\nid1;id2;force\n-;-;N\n1;2;0,4622\n1;3;0,4622\n1;4;0,4622\n";
/// let read = Reader::new().compare(&packing, table.as_bytes())?;
/// assert_eq!(
///     read.dialect.unwrap().to_string(),
///     "cells between semicolons, decimal commas, header on line 2, rows from line 4",
/// );
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Dialect {
    /// The separator of cells.
    pub separator: Separator,
    /// The quote around a cell that contains separators.
    pub quote: Option<char>,
    /// The signs at the beginning of a comment.
    pub comments: Vec<String>,
    /// Whether decimal fractions begin with a comma.
    pub decimal_comma: bool,
    /// The line of the header, if there is one.
    pub header: Option<u64>,
    /// The line of the first row.
    pub first_row: u64,
}

impl fmt::Display for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cells between {}", self.separator)?;
        if self.decimal_comma {
            f.write_str(", decimal commas")?;
        }
        match self.header {
            Some(line) => write!(f, ", header on line {line}")?,
            None => f.write_str(", no header")?,
        }
        write!(f, ", rows from line {}", self.first_row)
    }
}

impl Dialect {
    /// Returns the text after the sign of a comment, or `None` for a line that is no comment.
    pub(super) fn comment<'l>(&self, line: &'l str) -> Option<&'l str> {
        comment(line, &self.comments)
    }

    pub(super) fn cut<'l>(&self, line: &'l str, cells: &mut Vec<&'l str>) -> Result<(), Fault> {
        let line = uncommented(line, &self.comments);
        cut(line, self.separator, self.quote, cells)
    }

    /// Returns the text of a row before a comment on the same line.
    pub(super) fn before_comment<'l>(&self, line: &'l str) -> Option<&'l str> {
        Some(behind_row(line, &self.comments)?.0)
    }
}

/// Splits a line at a comment behind a row, which begins after a blank.
fn behind_row<'l>(line: &'l str, signs: &[String]) -> Option<(&'l str, &'l str)> {
    let starts = signs
        .iter()
        .flat_map(|sign| line.match_indices(sign.as_str()));
    let is_behind = |place: &usize| {
        let before = line.get(..*place).unwrap_or_default();
        before.ends_with(char::is_whitespace) && !before.trim().is_empty()
    };
    let start = starts.map(|(place, _)| place).filter(is_behind).min()?;
    line.split_at_checked(start)
}

/// Returns a line to be read. If no line is a comment, rows may still begin with the sign of one.
fn uncommented<'l>(line: &'l str, comments: &[String]) -> &'l str {
    if comments.is_empty() {
        bare(line)
    } else {
        line
    }
}

fn comment<'l>(line: &'l str, signs: &[String]) -> Option<&'l str> {
    let line = line.trim_start();
    let sign = signs.iter().find(|sign| line.starts_with(*sign))?;
    Some(line.trim_start_matches(sign.as_str()).trim())
}

/// Returns a line without the sign of a comment. An empty first cell remains.
fn bare(line: &str) -> &str {
    let text = line.trim_start();
    if text.starts_with('#') {
        text.trim_start_matches('#')
    } else {
        line
    }
}

/// The signs of comments in the tables of common programs.
const COMMENTS: [&str; 4] = ["#", "%", "//", "!"];

/// The separators that are tried. Of equals the first is chosen.
const SEPARATORS: [Separator; 5] = [
    Separator::Char('\t'),
    Separator::Char(';'),
    Separator::Char(','),
    Separator::Char('|'),
    Separator::Blanks,
];

/// The smallest number of numbers in a row: two ids or coordinates, and a force.
const LEAST_NUMBERS: usize = 3;

/// The numbered lines at the beginning of a table.
struct Sample {
    lines: Vec<(u64, String)>,
    comments: Vec<String>,
}

impl Sample {
    fn new(bytes: &[u8], is_whole: bool, options: &DialectOptions) -> Result<Self, Refusal> {
        let comments = match &options.comment {
            None => COMMENTS.map(str::to_owned).to_vec(),
            Some(mark) => mark.get().map(str::to_owned).into_iter().collect(),
        };
        let mut lines = Lines::new(bytes);
        let mut kept = Vec::new();
        loop {
            let line = match lines.next() {
                Ok(Some(line)) => line,
                Err(refusal) if kept.is_empty() => return Err(refusal),
                // The rows before a refusal are read first.
                Ok(None) | Err(_) => break,
            };
            let is_complete = line.ended || is_whole;
            let is_skipped = options.skip.is_some_and(|skip| line.number <= skip);
            if is_complete && !is_skipped && !line.text.trim().is_empty() {
                let text = uncommented(line.text, &comments);
                kept.push((line.number, text.to_owned()));
            }
        }
        Ok(Self {
            lines: kept,
            comments,
        })
    }

    /// Returns the lines that are no comments.
    fn texts(&self) -> impl Iterator<Item = (u64, &str)> {
        let lines = self.lines.iter();
        lines
            .filter(|(_, line)| comment(line, &self.comments).is_none())
            .map(|(number, line)| (*number, line.as_str()))
    }

    /// Returns all lines, comments without their signs, and whether each is a comment.
    fn all(&self) -> impl DoubleEndedIterator<Item = (u64, &str, bool)> {
        let lines = self.lines.iter();
        lines.map(|(number, text)| match comment(text, &self.comments) {
            Some(text) => (*number, text, true),
            None => (*number, text.as_str(), false),
        })
    }

    /// Returns the lines above a line, the nearest first.
    fn above(&self, line: u64) -> impl Iterator<Item = (u64, &str, bool)> {
        self.all().rev().filter(move |(number, ..)| *number < line)
    }
}

/// A separator and a quote, with the rows that they make.
#[derive(Clone, Copy)]
struct Cutting {
    separator: Separator,
    quote: Option<char>,
    /// The number of cells in a row.
    width: usize,
    first_row: u64,
    /// The share of cells that are numbers in such rows.
    share: f64,
    /// Whether the line above the first row has the same number of cells.
    has_header: bool,
    /// The number of cells that are still in quotes.
    quoted: usize,
    /// Whether the last cell of all rows is empty.
    is_open: bool,
}

/// The cells of a row of a sample.
struct Counts {
    line: u64,
    cells: usize,
    numbers: usize,
    is_open: bool,
}

impl Cutting {
    /// Cuts a sample, and returns `None` if it has no rows.
    #[expect(clippy::cast_precision_loss, reason = "counts of a sample")]
    fn of(sample: &Sample, separator: Separator, quote: Option<char>) -> Option<Self> {
        let (mut rows, mut all, mut cells) = (Vec::new(), 0_usize, Vec::new());
        let numbers_of = |text: &str| {
            let mut cells = Vec::new();
            let cut = cut(text, separator, quote, &mut cells);
            cut.map_or(0, |()| cells.iter().filter(|cell| is_number(cell)).count())
        };
        for (line, text) in sample.texts() {
            let text = match behind_row(text, &sample.comments) {
                Some((row, comment))
                    if numbers_of(comment) == 0 && numbers_of(row) >= numbers_of(text) =>
                {
                    row
                }
                _ => text,
            };
            if cut(text, separator, quote, &mut cells).is_err() {
                continue;
            }
            all += cells.iter().filter(|cell| !cell.is_empty()).count();
            let numbers = cells.iter().filter(|cell| is_number(cell));
            let row = Counts {
                line,
                cells: cells.len(),
                numbers: numbers.count(),
                is_open: cells.last().is_some_and(|cell| cell.is_empty()),
            };
            if row.numbers >= LEAST_NUMBERS {
                rows.push(row);
            }
        }
        let width = most_common(rows.iter().map(|row| row.cells))?;
        rows.retain(|row| row.cells == width);
        let first_row = rows.first()?.line;
        let sum = |count: fn(&Counts) -> usize| rows.iter().map(count).sum::<usize>();
        let mut quoted = 0;
        for (_, text, _) in sample.all() {
            if cut(text, separator, quote, &mut cells).is_ok() {
                quoted += cells.iter().filter(|cell| is_quoted(cell)).count();
            }
        }
        let above = sample.above(first_row).next();
        let header = above.map(|(_, text, _)| {
            let cut = cut(text, separator, quote, &mut cells);
            cut.map_or(0, |()| cells.len())
        });
        Some(Self {
            separator,
            quote,
            width,
            first_row,
            share: sum(|row| row.numbers) as f64 / all as f64,
            has_header: header == Some(width),
            quoted,
            is_open: rows.iter().all(|row| row.is_open),
        })
    }
}

/// Returns whether a line has enough numbers for a row, and little else.
pub(super) fn is_of_numbers(cells: &[&str]) -> bool {
    let numbers = cells.iter().filter(|cell| is_number(cell)).count();
    numbers >= LEAST_NUMBERS && 2 * numbers > cells.len()
}

fn is_quoted(cell: &str) -> bool {
    let is_between = |quote| cell.len() > 1 && cell.starts_with(quote) && cell.ends_with(quote);
    is_between('"') || is_between('\'')
}

impl Cutting {
    /// Returns the rows from a line on, as far as they have enough numbers.
    fn rows<'s>(&self, sample: &'s Sample, from: u64) -> impl Iterator<Item = (u64, Vec<&'s str>)> {
        let (separator, quote, width) = (self.separator, self.quote, self.width);
        let texts = sample.texts().filter(move |(line, _)| *line >= from);
        texts.filter_map(move |(line, text)| {
            let mut cells = Vec::new();
            cut(text, separator, quote, &mut cells).ok()?;
            let numbers = cells.iter().filter(|cell| is_number(cell)).count();
            (cells.len() == width && numbers >= LEAST_NUMBERS).then_some((line, cells))
        })
    }

    /// Returns whether the numbers of the columns that are read have decimal commas, and none has a point.
    fn has_decimal_commas(&self, sample: &Sample, header: &Header) -> bool {
        let mut has_commas = false;
        for (_, cells) in self.rows(sample, self.first_row) {
            for cell in header.numbers(&cells).filter(|cell| is_number(cell)) {
                if cell.contains('.') && number(cell, false).is_some() {
                    return false;
                }
                has_commas |= cell.contains(',');
            }
        }
        has_commas
    }
}

fn most_common(values: impl Iterator<Item = usize>) -> Option<usize> {
    let mut counts = std::collections::BTreeMap::new();
    for value in values {
        *counts.entry(value).or_insert(0_usize) += 1;
    }
    counts
        .into_iter()
        .max_by_key(|(_, count)| *count)
        .map(|(value, _)| value)
}

/// Finds the dialect and the header of a table that begins with these bytes.
pub(super) fn find(
    sample: &[u8],
    is_whole: bool,
    options: &DialectOptions,
    columns: &Columns,
    identity: Identity,
) -> Result<(Dialect, Header), Refusal> {
    let sample = Sample::new(sample, is_whole, options)?;
    let candidates = candidates(&sample, options);
    let mut best: Option<Cutting> = None;
    for (separator, quote) in candidates.iter().copied() {
        if let Some(cutting) = Cutting::of(&sample, separator, quote) {
            let merit = |cutting: &Cutting| {
                let Cutting {
                    share,
                    has_header,
                    quoted,
                    ..
                } = cutting;
                (*share, *has_header, Reverse(*quoted))
            };
            if best.is_none_or(|best| merit(&best) < merit(&cutting)) {
                best = Some(cutting);
            }
        }
    }
    let table = Table {
        sample: &sample,
        candidates: &candidates,
        columns,
        identity,
    };
    let (cutting, header) = match best {
        Some(cutting) => table.header(cutting)?,
        None => table.without_rows()?,
    };
    let (line, mut header) = header;
    let decimal_comma = options
        .decimal_comma
        .unwrap_or_else(|| cutting.has_decimal_commas(&sample, &header));
    header.set_decimal_comma(decimal_comma);
    let dialect = Dialect {
        separator: cutting.separator,
        quote: cutting.quote,
        comments: sample.comments,
        decimal_comma,
        header: line,
        first_row: cutting.first_row,
    };
    Ok((dialect, header))
}

fn candidates(sample: &Sample, options: &DialectOptions) -> Vec<(Separator, Option<char>)> {
    let has = |mark: char| sample.lines.iter().any(|(_, line)| line.contains(mark));
    let quotes: Vec<Option<char>> = match &options.quote {
        Some(mark) => vec![mark.get().and_then(|mark| mark.chars().next())],
        None if has('\'') => vec![Some('"'), Some('\'')],
        None => vec![Some('"')],
    };
    let separators = match options.separator {
        Some(separator) => vec![separator],
        None => SEPARATORS.to_vec(),
    };
    let all = separators
        .iter()
        .map(|separator| quotes.iter().map(|quote| (*separator, *quote)));
    all.flatten().collect()
}

/// A header with its line, if it has one.
type Found = (Option<u64>, Header);

/// A table whose header is to be found.
struct Table<'t> {
    sample: &'t Sample,
    candidates: &'t [(Separator, Option<char>)],
    columns: &'t Columns,
    identity: Identity,
}

impl Table<'_> {
    /// Finds the header above the rows: the nearest line with the necessary names.
    fn header(&self, cutting: Cutting) -> Result<(Cutting, Found), Refusal> {
        let Cutting {
            width, first_row, ..
        } = cutting;
        if self.columns.are_numbered(self.identity) {
            let header = Header::find(None, width, self.columns, self.identity);
            return Ok((
                cutting,
                (None, header.map_err(|fault| fault.at(first_row))?),
            ));
        }
        let own = [(cutting.separator, cutting.quote)];
        for (line, text, is_comment) in self.sample.above(first_row) {
            // The names may be separated in another way than the rows.
            for (n, (separator, quote)) in own.iter().chain(self.candidates).enumerate() {
                let Ok(header) = self.names(text, *separator, *quote) else {
                    continue;
                };
                match header.matched_to(width, cutting.is_open) {
                    Ok(header) => return Ok((cutting, (Some(line), header))),
                    Err(fault) if n == 0 || is_comment => return Err(fault.at(first_row)),
                    Err(_) => {}
                }
            }
        }
        // The lines above the header may have numbers, too.
        for (line, text, _) in self.sample.all().filter(|(line, ..)| *line > first_row) {
            let names = self.names(text, cutting.separator, cutting.quote);
            let header = names.and_then(|names| names.matched_to(width, cutting.is_open));
            if let Ok(header) = header
                && let Some((first_row, _)) = cutting.rows(self.sample, line).next()
            {
                let cutting = Cutting {
                    first_row,
                    ..cutting
                };
                return Ok((cutting, (Some(line), header)));
            }
        }
        let above = || self.sample.above(first_row);
        let likeliest = above()
            .find(|(.., is_comment)| !is_comment)
            .or_else(|| above().next());
        let Some((line, text, _)) = likeliest else {
            return Err(Fault::NoHeader { columns: width }.at(first_row));
        };
        match self.names(text, cutting.separator, cutting.quote) {
            Err(fault) => Err(fault.at(line)),
            Ok(header) => Ok((cutting, (Some(line), header))),
        }
    }

    /// Finds the header of a table without rows of numbers.
    fn without_rows(&self) -> Result<(Cutting, Found), Refusal> {
        let lines = || self.sample.all();
        let first = lines()
            .find(|(.., is_comment)| !is_comment)
            .or_else(|| lines().next());
        let Some((line, text, _)) = first else {
            return Err(Fault::Empty.at(1));
        };
        let cutting = |(separator, quote): &(Separator, Option<char>), text: &str, first_row| {
            let mut cells = Vec::new();
            let cut = cut(text, *separator, *quote, &mut cells);
            cut.map(|()| Cutting {
                separator: *separator,
                quote: *quote,
                width: cells.len(),
                first_row,
                share: 0.0,
                has_header: true,
                quoted: 0,
                is_open: false,
            })
        };
        let is_numbered = self.columns.are_numbered(self.identity);
        for (line, text, _) in lines().filter(|_| !is_numbered) {
            for candidate in self.candidates {
                if let Ok(header) = self.names(text, candidate.0, candidate.1) {
                    let cutting =
                        cutting(candidate, text, line + 1).map_err(|fault| fault.at(line))?;
                    return Ok((cutting, (Some(line), header)));
                }
            }
        }
        let cuttings = self
            .candidates
            .iter()
            .filter_map(|candidate| cutting(candidate, text, line).ok());
        // Of equals, the last counts as the greatest.
        let Some(widest) = cuttings.rev().max_by_key(|cutting| cutting.width) else {
            return Err(Fault::Quote.at(line));
        };
        let header = if is_numbered {
            Header::find(None, widest.width, self.columns, self.identity)
        } else {
            self.names(text, widest.separator, widest.quote)
        };
        Ok((widest, (None, header.map_err(|fault| fault.at(line))?)))
    }

    /// Reads a line as the names of the columns.
    fn names(
        &self,
        text: &str,
        separator: Separator,
        quote: Option<char>,
    ) -> Result<Header, Fault> {
        let mut cells = Vec::new();
        // Without comments, a header may still begin with their sign.
        let text = bare(text);
        cut(text, separator, quote, &mut cells)?;
        let names: Vec<String> = cells
            .iter()
            .map(|name| name.replace("\"\"", "\""))
            .collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        Header::find(Some(&names), names.len(), self.columns, self.identity)
    }
}
