//! Values of a report, as cells of a table and in json.

use serde_json::{Map, Value, json};

use crate::table::{Cell, Column, Table};

/// A value of a report. Only json shows one without a cell.
pub(super) struct Shown {
    cell: Option<Cell>,
    json: Value,
}

/// The values of a row, with the names of their columns.
pub(super) type Entries = Vec<(&'static str, Shown)>;

impl Shown {
    pub(super) fn new(cell: impl Into<Option<Cell>>, json: Value) -> Self {
        let cell = cell.into();
        Self { cell, json }
    }

    pub(super) fn count(count: impl Into<Option<u64>>) -> Self {
        let count = count.into();
        let cell = count.map_or(Cell::Missing, |count| Cell::Integer(count.into()));
        Self::new(cell, json!(count))
    }

    /// An infinite number is `inf`, in json `null`.
    pub(super) fn number(number: impl Into<Option<f64>>) -> Self {
        let number = number.into();
        Self::new(number.map_or(Cell::Missing, Cell::F64), json!(number))
    }

    pub(super) fn text(text: impl Into<Option<String>>) -> Self {
        let text = text.into();
        let json = json!(text);
        Self::new(
            text.map_or(Cell::Missing, |text| Cell::Word(text.into())),
            json,
        )
    }
}

pub(super) fn object(row: Entries) -> Map<String, Value> {
    let entries = row.into_iter();
    entries
        .map(|(name, shown)| (name.to_owned(), shown.json))
        .collect()
}

/// Returns the cells of a row with their columns.
pub(super) fn cells(row: Entries) -> impl Iterator<Item = (Column, Cell)> {
    let cells = row.into_iter();
    cells.filter_map(|(name, shown)| Some((Column::plain(name), shown.cell?)))
}

/// Returns a table of rows with the same columns.
pub(super) fn table(noun: &'static str, rows: Vec<Entries>) -> Table<'static> {
    let rows: Vec<(Vec<Column>, Vec<Cell>)> =
        rows.into_iter().map(|row| cells(row).unzip()).collect();
    let columns = rows
        .first()
        .map_or(Vec::new(), |(columns, _)| columns.clone());
    Table::of_rows(columns, noun, rows.into_iter().map(|(_, cells)| Ok(cells)))
}
