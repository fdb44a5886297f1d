//! A table as a json array of objects.

use std::io::Write;

use super::cell::{Cell, NumberFormat};
use super::error::WriteError;
use super::line::Line;
use super::rows::{Column, RowIter, show};

/// Writes `[`, one object per line, and `]`.
pub(super) fn write(
    columns: &[Column],
    rows: RowIter<'_>,
    numbers: NumberFormat,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let keys: Vec<Vec<String>> = columns.iter().map(|column| column.keys(numbers)).collect();
    let mut line = Line::default();
    let mut separator = "[\n";
    for row in rows {
        let row = row?;
        show(columns, &row, numbers, &mut line)?;
        out.write_all(separator.as_bytes())?;
        let mut texts = line.fields();
        let mut before = '{';
        for (keys, cell) in keys.iter().zip(&row) {
            for (key, text) in keys.iter().zip(texts.by_ref()) {
                write!(out, "{before}\"{key}\":")?;
                write_value(cell, numbers, text, out)?;
                before = ',';
            }
        }
        out.write_all(b"}")?;
        separator = ",\n";
    }
    let end = if separator == "[\n" { "[]\n" } else { "\n]\n" };
    Ok(out.write_all(end.as_bytes())?)
}

/// Writes floats and integers within 2^53 as numbers, and larger integers and exact quantities as strings. Many JSON
/// readers store numbers as floats.
fn write_value(
    cell: &Cell,
    numbers: NumberFormat,
    text: &str,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let quoted = match cell {
        Cell::Missing => return Ok(out.write_all(b"null")?),
        Cell::Flag(flag) => return Ok(write!(out, "{flag}")?),
        Cell::Word(_) => true,
        Cell::Number(_) | Cell::Sum(_) => numbers == NumberFormat::Exact,
        Cell::Integer(n) => n.bits() > 53,
        Cell::Index(n) => n.unsigned_abs() >> 53 > 0,
        Cell::F64(_) | Cell::F32(_) => false,
    };
    if quoted {
        Ok(serde_json::to_writer(out, text)?)
    } else {
        Ok(out.write_all(text.as_bytes())?)
    }
}
