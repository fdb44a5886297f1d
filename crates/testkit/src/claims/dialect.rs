//! A table of exact forces is accepted whole in any dialect, or refused for a stated reason. A planted fault is found.
//!
//! The oracle is the list of rows that was written, and the fault.

use arbitrary::Unstructured;
use cannonpile::geometry::Spacing;
use cannonpile::{Packing, Pile};
use cannonpile_dem::verify::{Compared, DialectOptions, Measured, Reader, Refusal};

use super::measured::{perfect, shuffle};
use super::{Checked, Failure, demand, one_line};
use crate::generators::number::ratio;
use crate::generators::rarely;

/// The exact forces are accepted with all their rows, or the table is refused.
pub fn exact_table(u: &mut Unstructured<'_>) -> Checked {
    let rows = rows(u)?;
    match read(u, &rows)? {
        (Ok(read), file) => whole(&read, rows.len(), &file),
        (Err(refusal), _) => one_line(&refusal),
    }
}

/// A planted fault is found: the table is refused, or the comparison does not accept it.
pub fn planted_fault(u: &mut Unstructured<'_>) -> Checked {
    let mut rows = rows(u)?;
    let fault = fault(u, &mut rows)?;
    match read(u, &rows)? {
        (Ok(read), file) => demand(!read.comparison.accepted(1e-6), || {
            let file = String::from_utf8_lossy(&file);
            format!("{fault} was accepted: {}, {file:?}", read.comparison)
        }),
        (Err(refusal), _) => one_line(&refusal),
    }
}

/// The outcome of an exact table, in one word.
///
/// # Errors
/// Those of the generator.
pub fn outcome(u: &mut Unstructured<'_>) -> Result<String, Failure> {
    let rows = rows(u)?;
    Ok(match read(u, &rows)?.0 {
        Ok(_) => "accepted".into(),
        Err(_) => "refused".into(),
    })
}

fn whole(read: &Compared, rows: usize, file: &[u8]) -> Checked {
    demand(
        read.comparison.accepted(0.0) && read.rows.used == rows as u64,
        || {
            let file = String::from_utf8_lossy(file);
            format!(
                "{rows} rows, {:?}: {}, {file:?}",
                read.rows, read.comparison
            )
        },
    )
}

/// The exact forces of three layers, in any order. Some pairs may be in two rows.
fn rows(u: &mut Unstructured<'_>) -> Result<Vec<Measured>, Failure> {
    let pile = Pile::triangular(3)?;
    let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5))?)?;
    let mut rows = perfect(&packing).unwrap_or_default();
    if rarely(u, 3)? {
        let twice: Vec<_> = rows.iter().map(|row| row.reversed()).collect();
        rows.extend(twice);
    }
    shuffle(u, &mut rows)?;
    Ok(rows)
}

/// Plants a fault, and returns its name.
fn fault(u: &mut Unstructured<'_>, rows: &mut Vec<Measured>) -> Result<&'static str, Failure> {
    let place = u.choose_index(rows.len())?;
    let row = &mut rows[place];
    Ok(match u.int_in_range(0..=4)? {
        0 => {
            row.force *= 1.001;
            "a wrong force"
        }
        1 => {
            row.vector = row.vector.map(|[x, y, z]| [y, x, z * 1.001]);
            row.force *= 1.001;
            "a wrong vector"
        }
        2 => {
            *row = Measured::new(row.ids, 0.0).with_vector([0.0; 3]);
            "a zero"
        }
        3 => {
            // The top sphere touches the spheres 2, 3 and 4.
            row.ids = [1, 5];
            "a wrong id"
        }
        _ => {
            let ids = row.ids;
            let is_same = |one: &Measured| one.ids == ids || one.reversed().ids == ids;
            rows.retain(|one| !is_same(one));
            "a lost pair"
        }
    })
}

/// Writes the rows in some dialect, and reads them.
fn read(
    u: &mut Unstructured<'_>,
    rows: &[Measured],
) -> Result<(Result<Compared, Refusal>, Vec<u8>), Failure> {
    let style = Style::new(u)?;
    let file = style.file(u, rows)?;
    let mut reader = Reader::new();
    let columns = style.columns();
    if !columns.is_empty() {
        let columns = columns
            .parse()
            .map_err(|error| Failure::Refuted(format!("{error}")))?;
        reader = reader.with_columns(columns);
    }
    if style.comment_none {
        let comment = Some(
            "none"
                .parse()
                .map_err(|error| Failure::Refuted(format!("{error}")))?,
        );
        reader = reader.with_dialect(DialectOptions {
            comment,
            ..DialectOptions::default()
        });
    }
    let pile = Pile::triangular(3)?;
    let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5))?)?;
    Ok((reader.compare(&packing, &*file), file))
}

/// How a table is written.
#[expect(clippy::struct_excessive_bools, reason = "each is a habit of its own")]
struct Style {
    separator: char,
    /// Blanks around separators.
    padded: bool,
    quote: char,
    decimal_comma: bool,
    exponent: u8,
    line_end: &'static str,
    header: HeaderStyle,
    /// For each column its content.
    columns: Vec<Content>,
    open_rows: bool,
    comment_none: bool,
    utf_16: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum HeaderStyle {
    Names,
    Comment,
    None,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Content {
    Id(usize),
    Number(usize),
    /// A column that is not needed.
    Other(&'static str),
}

const NAMES: [&str; 4] = ["force", "fx", "fy", "fz"];

/// Cells of columns that are not needed.
const OTHERS: [&str; 12] = [
    "",
    "n/a",
    "a b",
    "-nan(ind)",
    "x,y",
    "7",
    "SS",
    "3;4",
    "µm",
    "# 1",
    "'",
    "(1, 2)",
];

/// Lines above and below a table.
const TEXTS: [&str; 6] = [
    "contacts of a simulation",
    "time 0.5, step 100",
    "# a comment",
    "",
    "% 12 contacts",
    "written by: a code; 2026-11-25",
];

impl Style {
    fn new(u: &mut Unstructured<'_>) -> Result<Self, Failure> {
        let with_vectors = u.arbitrary()?;
        let mut columns = vec![Content::Id(0), Content::Id(1), Content::Number(0)];
        if with_vectors {
            columns.extend([1, 2, 3].map(Content::Number));
        }
        for _ in 0..u.int_in_range(0..=3)? {
            columns.push(Content::Other(u.choose(&OTHERS)?));
        }
        for place in (1..columns.len()).rev() {
            columns.swap(place, u.int_in_range(0..=place)?);
        }
        Ok(Self {
            separator: *u.choose(&[',', ';', '\t', '|', ' '])?,
            padded: u.arbitrary()?,
            quote: *u.choose(&['"', '"', '\''])?,
            decimal_comma: rarely(u, 4)?,
            exponent: u.int_in_range(0..=4)?,
            line_end: u.choose(&["\n", "\r\n", "\r"])?,
            header: *u.choose(&[
                HeaderStyle::Names,
                HeaderStyle::Names,
                HeaderStyle::Comment,
                HeaderStyle::None,
            ])?,
            columns,
            open_rows: rarely(u, 6)?,
            comment_none: rarely(u, 8)?,
            utf_16: rarely(u, 8)?,
        })
    }

    /// Returns the value of `--columns`. It is empty for a table with the usual names.
    fn columns(&self) -> String {
        if self.header != HeaderStyle::None {
            return String::new();
        }
        let named = (1..)
            .zip(&self.columns)
            .filter_map(|(n, content)| match content {
                Content::Id(id) => Some(format!("id{}=#{n}", id + 1)),
                Content::Number(number) => Some(format!("{}=#{n}", NAMES[*number])),
                Content::Other(_) => None,
            });
        named.collect::<Vec<_>>().join(",")
    }

    fn number(&self, x: f64) -> String {
        let text = match self.exponent {
            0 | 1 => format!("{x:?}"),
            2 => format!("{x:e}"),
            3 => format!("{x:E}"),
            _ => format!("{x:e}").replace('e', "D"),
        };
        if self.decimal_comma {
            text.replace('.', ",")
        } else {
            text
        }
    }

    /// Returns a cell, in quotes if it needs them, or by chance.
    fn cell(&self, u: &mut Unstructured<'_>, text: &str) -> Result<String, Failure> {
        let is_blank = self.separator == ' ';
        let needs = text.contains(self.separator)
            || text.starts_with(['"', '\'', '#', '%'])
            || is_blank && (text.is_empty() || text.contains(char::is_whitespace));
        Ok(if needs || rarely(u, 6)? {
            let doubled = text.replace(
                self.quote,
                &[self.quote, self.quote].iter().collect::<String>(),
            );
            format!("{0}{doubled}{0}", self.quote)
        } else {
            text.to_owned()
        })
    }

    fn line(&self, u: &mut Unstructured<'_>, cells: &[String]) -> Result<String, Failure> {
        let mut line = String::new();
        for (n, cell) in cells.iter().enumerate() {
            if n > 0 {
                line.push(self.separator);
                if self.padded && self.separator != '\t' {
                    line.push_str([" ", "  "][u.choose_index(2)?]);
                }
            }
            line.push_str(&self.cell(u, cell)?);
        }
        if self.open_rows {
            line.push(self.separator);
        }
        Ok(line)
    }

    fn file(&self, u: &mut Unstructured<'_>, rows: &[Measured]) -> Result<Vec<u8>, Failure> {
        let mut lines: Vec<String> = Vec::new();
        let text = |u: &mut Unstructured<'_>| u.choose(&TEXTS).map(|text| (*text).to_owned());
        if self.header != HeaderStyle::None || rarely(u, 2)? {
            for _ in 0..u.int_in_range(0..=2)? {
                lines.push(text(u)?);
            }
        }
        let names: Vec<String> = (1..)
            .zip(&self.columns)
            .map(|(n, content)| match content {
                Content::Id(id) => format!("id{}", id + 1),
                Content::Number(number) => NAMES[*number].to_owned(),
                Content::Other(_) => format!("other {n}"),
            })
            .collect();
        match self.header {
            HeaderStyle::Names => lines.push(self.line(u, &names)?),
            HeaderStyle::Comment => lines.push(format!("# {}", self.line(u, &names)?)),
            HeaderStyle::None => {}
        }
        if self.header == HeaderStyle::Names && rarely(u, 4)? {
            let units: Vec<String> = names.iter().map(|_| "N".to_owned()).collect();
            lines.push(self.line(u, &units)?);
        }
        for row in rows {
            if rarely(u, 20)? {
                lines.push(["", "# a comment"][u.choose_index(2)?].to_owned());
            }
            let [x, y, z] = row.vector.unwrap_or_default();
            let numbers = [row.force, x, y, z];
            let mut cells = Vec::new();
            for content in &self.columns {
                cells.push(match content {
                    Content::Id(id) => row.ids[*id].to_string(),
                    Content::Number(number) => self.number(numbers[*number]),
                    Content::Other(text) => (*text).to_owned(),
                });
            }
            lines.push(self.line(u, &cells)?);
        }
        for _ in 0..u.int_in_range(0..=1)? {
            lines.push(text(u)?);
        }
        let mut file = lines.join(self.line_end);
        if u.arbitrary()? {
            file.push_str(self.line_end);
        }
        Ok(if self.utf_16 {
            let units = core::iter::once(0xfeff).chain(file.encode_utf16());
            units.flat_map(u16::to_le_bytes).collect()
        } else {
            file.into_bytes()
        })
    }
}
