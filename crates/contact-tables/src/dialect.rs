//! The dialect of a text table: how it separates cells, writes numbers and marks comments.

use core::fmt;
use core::str::FromStr;

use crate::cut::{Separator, cut};
use crate::encoding::TextEncoding;
use crate::error::Syntax;

/// The parts of the dialect of a text table that the user gives. The first lines of the table decide the others.
///
/// # Examples
/// ```
/// use contact_tables::{DialectOptions, Format, Separator};
///
/// let dialect = DialectOptions { separator: Some(Separator::Char('+')), ..DialectOptions::default() };
/// let format = Format { dialect, ..Format::default() };
/// assert_eq!(contact_tables::read(&b"id1+id2+force\n1+2+0.5\n"[..], &format)?.count(), 1);
/// # Ok::<(), contact_tables::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DialectOptions {
    /// The encoding. A text that is not in UTF-8 is converted in memory.
    pub encoding: Option<TextEncoding>,
    /// The separator of cells.
    pub separator: Option<Separator>,
    /// The quote around a cell that contains separators, or none.
    pub quote: Option<Mark<char>>,
    /// The beginning of a line that is a comment, or none.
    pub comment: Option<Mark<String>>,
    /// True for decimal commas, false for decimal points.
    pub decimal_comma: Option<bool>,
    /// The number of lines before the table.
    pub skip: Option<u64>,
    /// True if the row below the header has units instead of numbers.
    pub unit_row: Option<bool>,
}

/// A sign with a meaning, such as a quote, or the word `none`.
///
/// # Examples
/// ```
/// use contact_tables::Mark;
///
/// assert_eq!("//".parse::<Mark<String>>()?.get(), Some(&"//".to_owned()));
/// assert_eq!("none".parse::<Mark<char>>()?.get(), None);
/// // A quote is one character.
/// assert!("ab".parse::<Mark<char>>().is_err());
/// # Ok::<(), contact_tables::Syntax>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark<T>(Option<T>);

impl<T> Mark<T> {
    /// Returns the sign.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::Mark;
    ///
    /// assert_eq!("'".parse::<Mark<char>>()?.get(), Some(&'\''));
    /// # Ok::<(), contact_tables::Syntax>(())
    /// ```
    #[must_use]
    pub const fn get(&self) -> Option<&T> {
        self.0.as_ref()
    }
}

impl<T: FromStr> FromStr for Mark<T> {
    type Err = Syntax;

    fn from_str(text: &str) -> Result<Self, Syntax> {
        let refused = || Syntax::new(text, "a sign such as # or \", or none");
        match text {
            "" => Err(refused()),
            "none" => Ok(Self(None)),
            sign => Ok(Self(Some(sign.parse().map_err(|_| refused())?))),
        }
    }
}

/// The dialect of a text table.
///
/// # Examples
/// ```
/// let table = "measured\nid1;id2;force\n-;-;N\n1;2;0,4622\n1;3;0,4622\n";
/// let contacts = contact_tables::read(table.as_bytes(), &Default::default())?;
/// assert_eq!(
///     contacts.dialect.unwrap().to_string(),
///     "cells between semicolons, decimal commas, header on line 2, rows from line 4",
/// );
/// # Ok::<(), contact_tables::Error>(())
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
    /// True if decimal fractions begin with a comma.
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
    /// Returns the text after the sign of a comment, if the line begins with one.
    pub(crate) fn comment<'l>(&self, line: &'l str) -> Option<&'l str> {
        comment(line, &self.comments)
    }

    /// Cuts a line into its cells, and returns the position of the first cell whose quote does not end on the line.
    pub(crate) fn cut<'l>(&self, line: &'l str) -> (Vec<&'l str>, Option<usize>) {
        let line = uncommented(line, &self.comments);
        cut(line, self.separator, self.quote)
    }

    /// Returns the text of a row before a comment on the same line.
    pub(crate) fn before_comment<'l>(&self, line: &'l str) -> Option<&'l str> {
        Some(behind_row(line, &self.comments)?.0)
    }
}

/// Splits a line at a comment behind a row, which begins after a blank.
pub(crate) fn behind_row<'l>(line: &'l str, signs: &[String]) -> Option<(&'l str, &'l str)> {
    // Most rows have no blank. This test of all bytes is fast.
    let may_be_blank = |byte: u8| !(b'!'..0x80).contains(&byte);
    let bytes = line.bytes();
    let has_blank = bytes.fold(false, |any, byte| any | may_be_blank(byte));
    if !has_blank {
        return None;
    }
    let blanks = line.char_indices().filter(|(_, c)| c.is_whitespace());
    let parts = blanks.map(|(place, blank)| line.split_at(place + blank.len_utf8()));
    let is_comment = |text: &str| signs.iter().any(|sign| text.starts_with(sign.as_str()));
    let mut comments = parts.filter(|(_, text)| is_comment(text));
    comments.find(|(row, _)| !row.trim().is_empty())
}

/// Returns a line to be read. If no line is a comment, rows may still begin with the sign of one.
pub(crate) fn uncommented<'l>(line: &'l str, comments: &[String]) -> &'l str {
    if comments.is_empty() {
        bare(line)
    } else {
        line
    }
}

/// Returns the text after the sign of a comment, if the line begins with one.
pub(crate) fn comment<'l>(line: &'l str, signs: &[String]) -> Option<&'l str> {
    let line = line.trim_start();
    let sign = signs.iter().find(|sign| line.starts_with(*sign))?;
    Some(line.trim_start_matches(sign.as_str()).trim())
}

/// Returns a line without the sign of a comment. An empty first cell remains.
pub(crate) fn bare(line: &str) -> &str {
    let text = line.trim_start();
    if text.starts_with('#') {
        text.trim_start_matches('#')
    } else {
        line
    }
}
