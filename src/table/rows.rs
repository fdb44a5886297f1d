//! Columns, and rows made as they are asked for.

use std::io::Write;

use super::{Cell, FileFormat, NumberFormat, WriteError, json, text};
use crate::Error;

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its header in csv, and key in json.
    pub name: &'static str,
    /// Its unit, empty for none.
    pub unit: &'static str,
    /// Whether the text table shows its sum.
    pub summed: bool,
    /// Whether it holds quantities, shown in the number format asked for.
    pub quantity: bool,
}

impl Column {
    /// A column without a unit or a sum.
    pub(crate) fn plain(name: &'static str) -> Self {
        Self {
            name,
            unit: "",
            summed: false,
            quantity: false,
        }
    }

    /// A quantity in a unit.
    pub(crate) fn measured(name: &'static str, unit: &'static str) -> Self {
        Self {
            name,
            unit,
            summed: false,
            quantity: true,
        }
    }

    /// A quantity in a unit whose sum means something.
    pub(super) fn summed(name: &'static str, unit: &'static str) -> Self {
        Self {
            name,
            unit,
            summed: true,
            quantity: true,
        }
    }

    /// Its headers: two for the ends of intervals.
    pub(super) fn heads(&self, numbers: NumberFormat) -> Vec<String> {
        let name = self.name;
        if self.quantity && numbers == NumberFormat::Interval {
            vec![format!("{name}_lo"), format!("{name}_hi")]
        } else {
            vec![name.to_owned()]
        }
    }
}

/// A row, or why it could not be made.
pub(crate) type Row = Result<Vec<Cell>, Error>;

/// How a text table is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// A line a row; the plural noun says what the rows are.
    Rows(&'static str),
    /// A line a column, for a table of one row.
    Record,
}

/// A table: columns, and rows made as they are asked for. [`base`](super::base), [`contacts`](super::contacts) and others make them.
pub struct Table<'a> {
    pub(super) columns: Vec<Column>,
    pub(super) layout: Layout,
    /// The rows in which every column takes its extremes.
    pub(super) extremes: Vec<Row>,
    /// A row that no row exceeds, where the extremes are not known.
    pub(super) bounds: Vec<Cell>,
    pub(crate) rows: Box<dyn Iterator<Item = Row> + 'a>,
}

impl Table<'static> {
    /// A table of one row, shown a line a column.
    pub(crate) fn record(entries: Vec<(Column, Cell)>) -> Self {
        let (columns, row): (Vec<_>, Vec<_>) = entries.into_iter().unzip();
        Self {
            columns,
            layout: Layout::Record,
            extremes: vec![Ok(row.clone())],
            bounds: Vec::new(),
            rows: Box::new(core::iter::once(Ok(row))),
        }
    }
}

impl<'a> Table<'a> {
    /// Returns the table, whose rows are shown to `look` before they are written.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::export::{FileFormat, NumberFormat, Units, tables};
    /// use cannonpile::shape::Selection;
    ///
    /// let (pile, mut seen) = (Pile::triangular(10)?, 0);
    /// let table = tables::base(&Units::of_pile(&pile), Selection::Base)?.inspect(|_| seen += 1);
    /// table.write(FileFormat::Csv, NumberFormat::Exact, &mut Vec::new())?;
    /// assert_eq!(seen, 55);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn inspect<'b>(self, mut look: impl FnMut(&[Cell]) + 'b) -> Table<'b>
    where
        'a: 'b,
    {
        let rows = self.rows.inspect(move |row| {
            if let Ok(row) = row {
                look(row);
            }
        });
        Table {
            columns: self.columns,
            layout: self.layout,
            extremes: self.extremes,
            bounds: self.bounds,
            rows: Box::new(rows),
        }
    }
}

impl Table<'_> {
    /// A table of these rows, a line a row; `noun` says in the plural what they are.
    pub(crate) fn of_rows(columns: Vec<Column>, noun: &'static str, rows: Vec<Row>) -> Self {
        Self {
            columns,
            layout: Layout::Rows(noun),
            extremes: Vec::new(),
            bounds: Vec::new(),
            rows: Box::new(rows.into_iter()),
        }
    }

    /// The columns, in order.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::table::{self, Units};
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let table = table::base(&Units::of_pile(&pile), Selection::Base)?;
    /// let normal = &table.columns()[2];
    /// assert_eq!((normal.name, normal.unit, normal.summed), ("normal", "mg", true));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Writes the table. Memory does not grow with the number of rows.
    ///
    /// # Errors
    /// [`WriteError::Answer`] with [`Error::Overflow`] if a number does not fit the format: found before
    /// anything is written. [`WriteError::Io`] if the output refuses.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::table::{self, FileFormat, NumberFormat, Units};
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::discs(1)?;
    /// let table = table::base(&Units::of_pile(&pile), Selection::Base)?;
    /// let mut json = Vec::new();
    /// table.write(FileFormat::Json, NumberFormat::F64, &mut json)?;
    /// let json = String::from_utf8(json)?;
    /// assert_eq!(json.lines().nth(1), Some(r#"{"i":0,"normal":1.0,"shear_x":0.0}"#));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(
        self,
        format: FileFormat,
        numbers: NumberFormat,
        out: &mut dyn Write,
    ) -> Result<(), WriteError> {
        for row in &self.extremes {
            self.texts(row.as_ref().map_err(Clone::clone)?, numbers)?;
        }
        if self.extremes.is_empty() {
            self.texts(&self.bounds, numbers)?;
        }
        match format {
            FileFormat::Text => text::write(self, numbers, out),
            FileFormat::Csv => self.write_csv(numbers, out),
            FileFormat::Json => json::write(self, numbers, out),
        }
    }

    fn write_csv(self, numbers: NumberFormat, out: &mut dyn Write) -> Result<(), WriteError> {
        let mut csv = csv::Writer::from_writer(out);
        csv.write_record(self.columns.iter().flat_map(|column| column.heads(numbers)))?;
        let columns = self.columns;
        for row in self.rows {
            csv.write_record(texts(&columns, &row?, numbers)?)?;
        }
        Ok(csv.flush()?)
    }

    fn texts(&self, row: &[Cell], numbers: NumberFormat) -> Result<Vec<String>, Error> {
        texts(&self.columns, row, numbers)
    }
}

/// The texts of a row.
pub(super) fn texts(
    columns: &[Column],
    row: &[Cell],
    numbers: NumberFormat,
) -> Result<Vec<String>, Error> {
    let texts = columns
        .iter()
        .zip(row)
        .map(|(column, cell)| cell.texts(numbers, column));
    Ok(texts.collect::<Result<Vec<_>, _>>()?.concat())
}
