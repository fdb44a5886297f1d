//! Lines cut into cells, the header and the rows in the same way.

use crate::verify::refusal::Fault;

use super::dialect::Separator;

/// Cuts a line into its cells. Blanks around a cell and its quotes are removed.
///
/// A quote counts at the beginning of a cell. A quote within the cell is doubled, and stays so here.
pub(super) fn cut<'l>(
    line: &'l str,
    separator: Separator,
    quote: Option<char>,
    cells: &mut Vec<&'l str>,
) -> Result<(), Fault> {
    cells.clear();
    let mut rest = skip_blanks(line, separator);
    if rest.is_empty() && separator == Separator::Blanks {
        return Ok(());
    }
    loop {
        let quoted = quote.and_then(|quote| rest.strip_prefix(quote).map(|rest| (quote, rest)));
        let (cell, after) = match quoted {
            None => separator.split(rest),
            Some((quote, inside)) => {
                let (cell, after) = unquoted(inside, quote).ok_or(Fault::Quote)?;
                match separator.split(after) {
                    (rest, after) if rest.trim().is_empty() => (cell, after),
                    // Text after the quote: the quote is part of the cell.
                    _ => separator.split(rest),
                }
            }
        };
        cells.push(cell.trim());
        match after {
            None => return Ok(()),
            Some(after) => rest = skip_blanks(after, separator),
        }
        if rest.is_empty() && separator == Separator::Blanks {
            return Ok(());
        }
    }
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
        let mut cells = Vec::new();
        cut(line, separator, Some('"'), &mut cells).ok()?;
        Some(cells)
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
        assert_eq!(cells("1,\"2", comma), None);
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
