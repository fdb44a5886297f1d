//! A table as a json array of objects.

use std::io::Write;
use std::str::FromStr;

use serde_json::{Map, Number, Value};

use super::{Cell, NumberFormat, Table, WriteError};

/// Writes `[`, an object a line, `]`.
pub(super) fn write(
    table: Table<'_>,
    numbers: NumberFormat,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let mut separator = "[\n";
    for row in table.rows {
        let mut object = Map::new();
        for (column, cell) in table.columns.iter().zip(row?) {
            let texts = cell.texts(numbers, column)?;
            for (head, text) in column.heads(numbers).into_iter().zip(texts) {
                object.insert(head, value(&cell, numbers, text));
            }
        }
        out.write_all(separator.as_bytes())?;
        serde_json::to_writer(&mut *out, &object)?;
        separator = ",\n";
    }
    let end = if separator == "[\n" { "[]\n" } else { "\n]\n" };
    Ok(out.write_all(end.as_bytes())?)
}

/// Integers and floats are numbers, of any size; exact quantities are strings, which lose nothing.
fn value(cell: &Cell, numbers: NumberFormat, text: String) -> Value {
    match cell {
        Cell::Missing => Value::Null,
        Cell::Flag(flag) => Value::Bool(*flag),
        Cell::Word(_) => Value::String(text),
        Cell::Number(_) if numbers == NumberFormat::Exact => Value::String(text),
        Cell::Integer(_) | Cell::Number(_) => match Number::from_str(&text) {
            Ok(number) => Value::Number(number),
            // Every integer and finite float is a json number.
            Err(_) => Value::String(text),
        },
    }
}
