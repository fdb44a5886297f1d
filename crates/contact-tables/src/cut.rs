//! Lines cut into cells, the header and the rows in the same way.

use core::fmt;
use core::str::FromStr;

use crate::error::Syntax;

/// The separator between the cells of a line.
///
/// # Examples
/// ```
/// use contact_tables::Separator;
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
    type Err = Syntax;

    fn from_str(text: &str) -> Result<Self, Syntax> {
        match text {
            "blanks" => Ok(Self::Blanks),
            "tab" => Ok(Self::Char('\t')),
            _ => text
                .parse()
                .map(Self::Char)
                .map_err(|_| Syntax::new(text, "a separator: one character, tab or blanks")),
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

/// Cuts a line into its cells. Blanks around a cell and its quotes are removed. Also returns the position of the first cell
/// whose quote does not end on the line.
///
/// A quote counts at the beginning of a cell. A quote within the cell is doubled, and stays so here. A quote that does not
/// end is part of its cell.
pub(crate) fn cut(
    line: &str,
    separator: Separator,
    quote: Option<char>,
) -> (Vec<&str>, Option<usize>) {
    let (mut cells, mut open) = (Vec::new(), None);
    let mut next = Some(line);
    while let Some(rest) = next {
        let rest = skip_blanks(rest, separator);
        if rest.is_empty() && separator == Separator::Blanks {
            break;
        }
        let quoted = quote.and_then(|quote| Some((quote, rest.strip_prefix(quote)?)));
        let whole = quoted.and_then(|(quote, inside)| unquoted(inside, quote));
        if quoted.is_some() && whole.is_none() {
            open = open.or(Some(cells.len()));
        }
        let parts = whole.map(|(cell, after)| (cell, separator.split(after)));
        let (cell, after) = match parts {
            Some((cell, (between, after))) if between.trim().is_empty() => (cell, after),
            // A quote with text behind it is part of the cell, too.
            _ => separator.split(rest),
        };
        cells.push(cell.trim());
        next = after;
    }
    (cells, open)
}

/// Returns the text before the closing quote, and the text after it.
fn unquoted(text: &str, quote: char) -> Option<(&str, &str)> {
    let mut from = 0;
    loop {
        let end = from + text.get(from..)?.find(quote)?;
        let after = text.get(end + quote.len_utf8()..)?;
        if !after.starts_with(quote) {
            return Some((text.get(..end)?, after));
        }
        from = end + 2 * quote.len_utf8();
    }
}

/// Removes blanks at the beginning that separate no cells.
fn skip_blanks(text: &str, separator: Separator) -> &str {
    match separator {
        Separator::Blanks => text.trim_start(),
        Separator::Char(mark) => text.trim_start_matches(|c: char| c.is_whitespace() && c != mark),
    }
}

impl Separator {
    /// Returns the text before the first separator, and the text after it.
    fn split(self, text: &str) -> (&str, Option<&str>) {
        let parts = match self {
            Self::Char(mark) => text.split_once(mark),
            Self::Blanks => text.split_once(char::is_whitespace),
        };
        match parts {
            Some((cell, after)) => (cell, Some(after)),
            None => (text, None),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(line: &str, separator: Separator) -> Option<Vec<&str>> {
        let (cells, open) = cut(line, separator, Some('"'));
        open.is_none().then_some(cells)
    }

    #[test]
    fn cells_and_quotes() {
        let comma = Separator::Char(',');
        for (line, want) in [
            ("1, 2 ,0.5", vec!["1", "2", "0.5"]),
            ("\"a, b\",2,", vec!["a, b", "2", ""]),
            (" \"1\" ,\"say \"\"b\"\"\"", vec!["1", "say \"\"b\"\""]),
            ("5\" disc,\"a\" b,1", vec!["5\" disc", "\"a\" b", "1"]),
            ("", vec![""]),
        ] {
            assert_eq!(cells(line, comma), Some(want), "{line}");
        }
        assert_eq!(cut("1,\"2", comma, Some('"')), (vec!["1", "\"2"], Some(1)));
        assert_eq!(cut("1,\"2", comma, None), (vec!["1", "\"2"], None));
        for (line, want) in [
            ("  1 \t2  \"a b\" 0.5 ", vec!["1", "2", "a b", "0.5"]),
            ("", vec![]),
        ] {
            assert_eq!(cells(line, Separator::Blanks), Some(want), "{line}");
        }
        assert_eq!(
            cells("1\t\t 2", Separator::Char('\t')),
            Some(vec!["1", "", "2"])
        );
    }
}
