//! Measured forces from comma-separated values.

use std::borrow::Cow;
use std::io::BufRead;

use super::columns::Columns;
use super::lines::Lines;
use super::{Fault, Reading, Refusal};

/// A csv table: a line with the names of the columns, and a line a contact.
///
/// Columns are found by name, in any order: `id1`, `id2`, `force`, and `fx`, `fy`, `fz` if there are vectors; `patom1` and
/// `patom2`, or `natom1` and `natom2`, stand for `id1` and `id2`. Others are passed over. Fields may be quoted; blanks
/// around them and empty lines do not count. A force is any finite decimal, and read as the nearest `f64`. The last line
/// need not end: what is cut off a csv table cannot be told from it, and shows as missing contacts.
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
    read_rows(Lines::new(input))
}

pub(super) fn read_rows(mut lines: Lines<impl BufRead>) -> Result<Reading, Refusal> {
    let columns = loop {
        let Some(line) = lines.next()? else {
            return Err(Fault::Empty.at(lines.number()));
        };
        if !line.text.trim().is_empty() {
            let columns = fields(line.text).and_then(Columns::new);
            break columns.map_err(|fault| fault.at(line.number))?;
        }
    };
    let mut reading = Reading::default();
    while let Some(line) = lines.next()? {
        if line.text.trim().is_empty() {
            continue;
        }
        let measured = fields(line.text).and_then(|fields| columns.read(fields));
        let pushed = measured.and_then(|measured| reading.push(measured, line.number));
        pushed.map_err(|fault| fault.at(line.number))?;
    }
    Ok(reading)
}

/// The fields of a line, without quotes and without blanks around them.
fn fields(line: &str) -> Result<Vec<Cow<'_, str>>, Fault> {
    if !line.contains('"') {
        return Ok(line.split(',').map(|field| field.trim().into()).collect());
    }
    let mut fields = Vec::new();
    let mut rest = line;
    loop {
        let (field, after) = match rest.trim_start().strip_prefix('"') {
            Some(quoted) => unquoted(quoted)?,
            None => match rest.split_once(',') {
                Some((field, after)) => (field.trim().into(), Some(after)),
                None => (rest.trim().into(), None),
            },
        };
        fields.push(field);
        match after {
            Some(after) => rest = after,
            None => return Ok(fields),
        }
    }
}

/// What is within quotes, which stand doubled for themselves, and what follows the comma after it.
fn unquoted(text: &str) -> Result<(Cow<'_, str>, Option<&str>), Fault> {
    let mut field = String::new();
    let mut rest = text;
    loop {
        let (part, after) = rest.split_once('"').ok_or(Fault::Quote)?;
        field.push_str(part);
        if let Some(doubled) = after.strip_prefix('"') {
            field.push('"');
            rest = doubled;
            continue;
        }
        let field = Cow::Owned(field.trim().to_owned());
        return match after.trim_start() {
            "" => Ok((field, None)),
            after => match after.strip_prefix(',') {
                Some(after) => Ok((field, Some(after))),
                None => Err(Fault::Quote),
            },
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The csv crate as the judge, on lines made of a few pieces.
    #[test]
    fn fields_are_those_of_any_csv_reader() {
        let pieces = [
            "1",
            "2.5",
            "",
            "\"\"",
            "\"a\"",
            "\"a,b\"",
            "\"say \"\"a\"\"\"",
            "é",
        ];
        for first in pieces {
            for second in pieces {
                for third in pieces {
                    let line = [first, second, third].join(",");
                    let mut reader = ::csv::ReaderBuilder::new()
                        .has_headers(false)
                        .from_reader(line.as_bytes());
                    let want = reader.records().next().unwrap().unwrap();
                    let got = fields(&line).unwrap();
                    assert!(want.iter().eq(got.iter().map(|field| &**field)), "{line}");
                }
            }
        }
    }

    #[test]
    fn quotes_that_do_not_end_are_refused() {
        for line in ["\"1,2", "1,\"2", "\"1\"2,3", "1,\"\"\""] {
            assert_eq!(fields(line), Err(Fault::Quote), "{line}");
        }
    }
}
