//! A table written as csv, json or aligned text.

use std::io::Write;

use super::cell::NumberFormat;
use super::error::WriteError;
use super::line::Line;
use super::rows::{Layout, RowIter, Table, show};
use super::{json, text};

/// The file format of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FileFormat {
    /// Aligned text with units and totals, for readers.
    Text,
    /// Comma-separated values with one line of headers.
    Csv,
    /// An array of objects, one per row.
    Json,
}

/// The number of rows that are checked before the header is written: the contacts of one sphere.
const FIRST: usize = 3;

impl Table<'_> {
    /// Writes the table. Memory does not grow with the number of rows.
    ///
    /// # Errors
    /// [`WriteError::Answer`] with [`Error::Overflow`](cannonpile::Error::Overflow) if a number does not fit the
    /// format. This error precedes all output: a bound of all numbers is checked first, and then all rows, if the bound
    /// does not fit. [`WriteError::Io`] if writing to the output fails.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use cannonpile_dem::table;
    /// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
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
        let mut line = Line::default();
        let is_counted = self.row_count().is_some();
        if let Err(refused) = show(&self.columns, &self.bounds, numbers, &mut line) {
            // The bounds are wider than the rows, so the rows decide. The error of the bounds names the column.
            let rows = self.again.and_then(|again| again(numbers).ok());
            let fits = rows.is_some_and(|mut rows| {
                rows.all(|row| {
                    row.is_ok_and(|row| show(&self.columns, &row, numbers, &mut line).is_ok())
                })
            });
            if !fits {
                return Err(refused.into());
            }
        }
        let mut rows = (self.rows)(numbers)?;
        // Errors of the first rows precede all output. One sphere has no further rows.
        let mut first = Vec::new();
        for row in rows.by_ref().take(FIRST) {
            let row = row?;
            show(&self.columns, &row, numbers, &mut line)?;
            first.push(Ok(row));
        }
        let rows: RowIter<'_> = Box::new(first.into_iter().chain(rows));
        let columns = &self.columns;
        match (format, self.layout) {
            (FileFormat::Json, _) => json::write(columns, rows, numbers, out),
            (FileFormat::Text, Layout::Record) => text::write_record(columns, rows, numbers, out),
            (FileFormat::Text, Layout::Rows(noun)) => {
                // If the number of rows is unknown, each row may take long to compute, so pages are short.
                let page = if is_counted {
                    text::PAGE
                } else {
                    text::SHORT_PAGE
                };
                text::write_rows(columns, (rows, page), self.sums, noun, numbers, out)
            }
            (FileFormat::Csv, _) => {
                let mut csv = csv::Writer::from_writer(out);
                csv.write_record(columns.iter().flat_map(|column| column.keys(numbers)))?;
                for row in rows {
                    show(columns, &row?, numbers, &mut line)?;
                    csv.write_record(line.fields())?;
                }
                Ok(csv.flush()?)
            }
        }
    }
}
