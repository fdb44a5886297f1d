//! The detection of the dialect and the header of a text table.
//!
//! The dialect is decided by what cuts all rows alike. Each separator and quote is tried on the first lines. The choice
//! is the one that makes most of the text numbers in rows of equal length.

use core::cmp::Reverse;

use crate::cut::{Separator, cut};
use crate::dialect::{Dialect, DialectOptions, bare, behind_row, comment, uncommented};
use crate::error::{Error, Fault, shortened};
use crate::format::Format;
use crate::header::Header;
use crate::lines::Lines;
use crate::number::{is_number, may_have_thousands, number};

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
    fn new(bytes: &[u8], is_whole: bool, options: &DialectOptions) -> Result<Self, Error> {
        let comments = match &options.comment {
            None => COMMENTS.map(str::to_owned).to_vec(),
            Some(mark) => mark.get().cloned().into_iter().collect(),
        };
        let mut lines = Lines::new(bytes);
        let mut kept = Vec::new();
        loop {
            let line = match lines.next() {
                Ok(Some(line)) => line,
                Err(error) if kept.is_empty() => return Err(error),
                // The rows before an error are read first.
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

    /// Returns the lines other than comments.
    fn texts(&self) -> impl Iterator<Item = (u64, &str)> {
        let texts = self.all().filter(|(.., is_comment)| !is_comment);
        texts.map(|(number, text, _)| (number, text))
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

/// The characters that separate and quote the cells of a line.
#[derive(Clone, Copy)]
struct Marks(Separator, Option<char>);

impl Marks {
    fn cut(self, line: &str) -> Vec<&str> {
        cut(line, self.0, self.1).0
    }
}

/// A separator and a quote, with the rows that they make.
#[derive(Clone, Copy)]
struct Cutting {
    marks: Marks,
    /// The number of cells in a row.
    width: usize,
    first_row: u64,
    /// The share of cells that are numbers in such rows.
    share: f64,
    /// True if the line above the first row has the same number of cells.
    has_header: bool,
    /// The number of cells that are still in quotes.
    quoted: usize,
    /// True if the last cell of all rows is empty.
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
    fn of(sample: &Sample, marks: Marks) -> Option<Self> {
        let (mut rows, mut all) = (Vec::new(), 0_usize);
        let numbers_of = |text| count_numbers(&marks.cut(text));
        for (line, text) in sample.texts() {
            let text = match behind_row(text, &sample.comments) {
                Some((row, comment))
                    if numbers_of(comment) == 0 && numbers_of(row) >= numbers_of(text) =>
                {
                    row
                }
                _ => text,
            };
            let cells = marks.cut(text);
            all += cells.iter().filter(|cell| !cell.is_empty()).count();
            let row = Counts {
                line,
                cells: cells.len(),
                numbers: count_numbers(&cells),
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
        let cells = sample.all().flat_map(|(_, text, _)| marks.cut(text));
        let quoted = cells.filter(|cell| is_quoted(cell)).count();
        let above = sample.above(first_row).next();
        let header = above.map(|(_, text, _)| marks.cut(text).len());
        Some(Self {
            marks,
            width,
            first_row,
            share: sum(|row| row.numbers) as f64 / all as f64,
            has_header: header == Some(width),
            quoted,
            is_open: rows.iter().all(|row| row.is_open),
        })
    }

    /// Returns the rows from a line on, as far as they have enough numbers.
    fn rows<'s>(&self, sample: &'s Sample, from: u64) -> impl Iterator<Item = (u64, Vec<&'s str>)> {
        let (marks, width) = (self.marks, self.width);
        let texts = sample.texts().filter(move |(line, _)| *line >= from);
        texts.filter_map(move |(line, text)| {
            let cells = marks.cut(text);
            let is_row = cells.len() == width && count_numbers(&cells) >= LEAST_NUMBERS;
            is_row.then_some((line, cells))
        })
    }

    /// Returns whether the numbers of the columns that are read have decimal commas, and none has a point.
    ///
    /// # Errors
    /// All commas may separate thousands.
    fn has_decimal_commas(&self, sample: &Sample, header: &Header) -> Result<bool, Error> {
        let (mut are_certain, mut unclear) = (false, None);
        for (line, cells) in self.rows(sample, self.first_row) {
            for cell in header.numbers(&cells).filter(|cell| is_number(cell)) {
                if cell.contains('.') && number(cell, false).is_some() {
                    return Ok(false);
                }
                if may_have_thousands(cell) {
                    unclear.get_or_insert((line, cell));
                } else {
                    are_certain |= cell.contains(',');
                }
            }
        }
        match unclear {
            Some((line, number)) if !are_certain => Err(Fault::new(format!(
                "the comma of {} is a decimal sign or separates thousands: set decimal to comma, or leave out such commas",
                shortened(&[number])
            ))
            .at(line)),
            _ => Ok(are_certain),
        }
    }

    /// Refuses rows without a header whose numbers may be cut at decimal commas.
    fn refuse_cut_numbers(&self, sample: &Sample, header: &Header) -> Result<(), Error> {
        let rows = self.rows(sample, self.first_row);
        let mut rows = rows.map(|(line, cells)| Some((line, header.cut_number(&cells)?)));
        match rows.next().flatten() {
            Some((line, number)) if rows.all(|row| row.is_some()) => {
                let number = shortened(&[&number]);
                Err(Fault::new(format!(
                    "{number} is two cells or one number with a decimal comma: set decimal to point, or separate cells by \
                     semicolons"
                ))
                .at(line))
            }
            _ => Ok(()),
        }
    }
}

/// Returns whether most cells of a line are numbers.
pub(crate) fn is_of_numbers(cells: &[&str]) -> bool {
    2 * count_numbers(cells) > cells.len()
}

fn count_numbers(cells: &[&str]) -> usize {
    cells.iter().filter(|cell| is_number(cell)).count()
}

/// Returns whether a cell is still in quotes.
fn is_quoted(cell: &str) -> bool {
    let is_between = |quote| cell.len() > 1 && cell.starts_with(quote) && cell.ends_with(quote);
    is_between('"') || is_between('\'')
}

fn most_common(values: impl Iterator<Item = usize>) -> Option<usize> {
    let mut values: Vec<usize> = values.collect();
    values.sort_unstable();
    // Of equal numbers of rows, the greatest value remains.
    let most = values
        .chunk_by(|a, b| a == b)
        .max_by_key(|alike| alike.len())?;
    most.first().copied()
}

/// Finds the dialect and the header of a table that begins with these bytes.
pub(crate) fn find(
    sample: &[u8],
    is_whole: bool,
    format: &Format,
) -> Result<(Dialect, Header), Error> {
    let options = &format.dialect;
    let sample = Sample::new(sample, is_whole, options)?;
    let candidates = candidates(&sample, options);
    let merit = |one: &Cutting| (one.share, one.has_header, Reverse(one.quoted));
    let cuttings = candidates
        .iter()
        .filter_map(|marks| Cutting::of(&sample, *marks));
    // Of equals, the first remains.
    let best = cuttings.reduce(|best, one| {
        if merit(&best) < merit(&one) {
            one
        } else {
            best
        }
    });
    let table = Table {
        sample: &sample,
        candidates: &candidates,
        format,
    };
    let (cutting, line, mut header) = match best {
        Some(cutting) => table.header(cutting)?,
        None => table.without_rows()?,
    };
    let Marks(separator, quote) = cutting.marks;
    if separator == Separator::Char(',') && options.decimal_comma != Some(false) {
        cutting.refuse_cut_numbers(&sample, &header)?;
    }
    let decimal_comma = match options.decimal_comma {
        Some(decimal_comma) => decimal_comma,
        None => cutting.has_decimal_commas(&sample, &header)?,
    };
    header.set_decimal_comma(decimal_comma);
    let dialect = Dialect {
        separator,
        quote,
        comments: sample.comments,
        decimal_comma,
        header: line,
        first_row: cutting.first_row,
    };
    Ok((dialect, header))
}

fn candidates(sample: &Sample, options: &DialectOptions) -> Vec<Marks> {
    let has = |mark: char| sample.lines.iter().any(|(_, line)| line.contains(mark));
    let quotes: Vec<Option<char>> = match &options.quote {
        Some(mark) => vec![mark.get().copied()],
        None if has('\'') => vec![Some('"'), Some('\'')],
        None => vec![Some('"')],
    };
    let separators = match options.separator {
        Some(separator) => vec![separator],
        None => SEPARATORS.to_vec(),
    };
    let all = separators
        .iter()
        .map(|separator| quotes.iter().map(|quote| Marks(*separator, *quote)));
    all.flatten().collect()
}

/// The rows of a table, and its header with its line, if it has one.
type Found = (Cutting, Option<u64>, Header);

/// A table whose header is to be found.
struct Table<'t> {
    sample: &'t Sample,
    candidates: &'t [Marks],
    format: &'t Format,
}

impl Table<'_> {
    /// Finds the header above the rows: the nearest line with the necessary names.
    fn header(&self, cutting: Cutting) -> Result<Found, Error> {
        let Cutting {
            marks,
            width,
            first_row,
            is_open,
            ..
        } = cutting;
        if self.are_numbered() {
            let header = Header::find(None, width, self.format);
            return Ok((cutting, None, header.map_err(|fault| fault.at(first_row))?));
        }
        for (line, text, is_comment) in self.sample.above(first_row) {
            // The names may be separated in another way than the rows.
            for (n, marks) in [marks].iter().chain(self.candidates).enumerate() {
                let Ok(header) = self.names(text, *marks) else {
                    continue;
                };
                match header.matched_to(width, is_open) {
                    Ok(header) => return Ok((cutting, Some(line), header)),
                    Err(fault) if n == 0 || is_comment => return Err(fault.at(first_row)),
                    Err(_) => {}
                }
            }
        }
        // The lines above the header may have numbers, too.
        for (line, text, _) in self.sample.all().filter(|(line, ..)| *line > first_row) {
            let names = self.names(text, marks);
            if let Ok(header) = names.and_then(|names| names.matched_to(width, is_open))
                && let Some((first_row, _)) = cutting.rows(self.sample, line).next()
            {
                let cutting = Cutting {
                    first_row,
                    ..cutting
                };
                return Ok((cutting, Some(line), header));
            }
        }
        let Some((line, text, _)) = likeliest(self.sample.above(first_row)) else {
            return Err(Fault::new(format!(
                "there is no header above the {width} columns: name them by number, such as id1=#1,id2=#2,force=#3"
            ))
            .at(first_row));
        };
        let header = self.names(text, marks).map_err(|fault| fault.at(line))?;
        Ok((cutting, Some(line), header))
    }

    /// Finds the header of a table without rows of numbers.
    fn without_rows(&self) -> Result<Found, Error> {
        let Some((line, text, _)) = likeliest(self.sample.all()) else {
            return Err(Fault::empty().at(1));
        };
        let cutting = |marks: Marks, text, first_row| Cutting {
            marks,
            width: marks.cut(text).len(),
            first_row,
            share: 0.0,
            has_header: true,
            quoted: 0,
            is_open: false,
        };
        let is_numbered = self.are_numbered();
        for (line, text, _) in self.sample.all().filter(|_| !is_numbered) {
            for marks in self.candidates {
                if let Ok(header) = self.names(text, *marks) {
                    return Ok((cutting(*marks, text, line + 1), Some(line), header));
                }
            }
        }
        let cuttings = self.candidates.iter();
        let cuttings = cuttings.map(|marks| cutting(*marks, text, line));
        // Of equals, the last counts as the greatest.
        let Some(widest) = cuttings.rev().max_by_key(|cutting| cutting.width) else {
            return Err(Fault::empty().at(line));
        };
        let header = if is_numbered {
            Header::find(None, widest.width, self.format)
        } else {
            self.names(text, widest.marks)
        };
        Ok((widest, None, header.map_err(|fault| fault.at(line))?))
    }

    fn are_numbered(&self) -> bool {
        self.format.columns.are_numbered(self.format.identity)
    }

    /// Reads a line as the names of the columns.
    fn names(&self, text: &str, marks: Marks) -> Result<Header, Fault> {
        // Without comments, a header may still begin with their sign.
        let names = marks.cut(bare(text)).into_iter();
        let names: Vec<String> = names.map(|name| name.replace("\"\"", "\"")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        Header::find(Some(&names), names.len(), self.format)
    }
}

/// Returns the first line that is no comment, or the first one if all are.
fn likeliest<'s>(
    lines: impl Iterator<Item = (u64, &'s str, bool)>,
) -> Option<(u64, &'s str, bool)> {
    lines.min_by_key(|(.., is_comment)| *is_comment)
}
