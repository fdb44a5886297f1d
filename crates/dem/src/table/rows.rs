//! Columns, and rows made as they are asked for.

use num_bigint::BigUint;

use super::cell::{Cell, NumberFormat};
use super::line::Line;
use super::progress::Progress;
use crate::Error;
use cannonpile::scalar::Surd;

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
    #[doc(hidden)]
    #[must_use]
    pub fn plain(name: &'static str) -> Self {
        Self {
            name,
            unit: "",
            summed: false,
            quantity: false,
        }
    }

    /// A quantity in a unit.
    #[doc(hidden)]
    #[must_use]
    pub fn measured(name: &'static str, unit: &'static str) -> Self {
        Self {
            unit,
            quantity: true,
            ..Self::plain(name)
        }
    }

    /// A quantity in a unit whose sum means something.
    #[doc(hidden)]
    #[must_use]
    pub fn summed(name: &'static str, unit: &'static str) -> Self {
        Self {
            summed: true,
            ..Self::measured(name, unit)
        }
    }

    /// How many headers it has: two for the ends of intervals.
    pub(super) fn places(&self, numbers: NumberFormat) -> usize {
        1 + usize::from(self.quantity && numbers == NumberFormat::Interval)
    }

    /// Its headers.
    pub(super) fn heads(&self, numbers: NumberFormat) -> Vec<String> {
        let name = self.name;
        match self.places(numbers) {
            1 => vec![name.to_owned()],
            _ => vec![format!("{name}_lo"), format!("{name}_hi")],
        }
    }
}

/// A row, or why it could not be made.
pub type Row = Result<Vec<Cell>, Error>;

/// Writes the texts of a row over a line.
pub(super) fn show(
    columns: &[Column],
    row: &[Cell],
    numbers: NumberFormat,
    line: &mut Line,
) -> Result<(), Error> {
    line.clear();
    for (column, cell) in columns.iter().zip(row) {
        cell.show(numbers, column.name, column.places(numbers), line)?;
    }
    Ok(())
}

/// Rows, one after the other.
pub(crate) type RowIter<'a> = Box<dyn Iterator<Item = Row> + 'a>;

/// Where the sums of the columns that are summed up come from, in their order.
pub(super) enum Sums<'a> {
    /// Without the rows, of which there may be many.
    LayerGap(Box<dyn FnOnce() -> Result<Vec<Surd>, Error> + 'a>),
    /// From the exact cells of the rows, which are few, and as long to make as their sums.
    OfRows,
}

/// How a text table is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// A line a row; the plural noun says what the rows are.
    Rows(&'static str),
    /// A line a column, for a table of one row.
    Record,
}

/// A table: columns, and rows made as they are asked for. [`base`](super::base), [`contacts`](super::contacts) and
/// others make them.
pub struct Table<'a> {
    pub(super) columns: Vec<Column>,
    pub(super) layout: Layout,
    /// A row that no row exceeds, as far as quantities may leave the floats.
    pub(super) bounds: Vec<Cell>,
    /// How many rows there are, if that is known.
    count: Option<BigUint>,
    /// The rows, made for one number format.
    pub(super) rows: Box<dyn FnOnce(NumberFormat) -> Result<RowIter<'a>, Error> + 'a>,
    pub(super) sums: Option<Sums<'a>>,
}

impl Table<'static> {
    /// A table of one row, shown a line a column.
    #[doc(hidden)]
    #[must_use]
    pub fn record(entries: Vec<(Column, Cell)>) -> Self {
        let (columns, row): (Vec<_>, Vec<_>) = entries.into_iter().unzip();
        Self {
            layout: Layout::Record,
            bounds: row.clone(),
            ..Self::of_rows(columns, "rows", core::iter::once(Ok(row)))
        }
    }
}

impl<'a> Table<'a> {
    /// Returns the table, whose rows are shown to `look` before they are written.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use cannonpile_dem::table;
    /// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
    ///
    /// let (pile, mut seen) = (Pile::triangular(10)?, 0);
    /// let table = table::base(&Units::of_pile(&pile), Selection::Base)?.inspect(|_| seen += 1);
    /// table.write(FileFormat::Csv, NumberFormat::Exact, &mut Vec::new())?;
    /// assert_eq!(seen, 55);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn inspect<'b>(self, mut look: impl FnMut(&[Cell]) + 'b) -> Table<'b>
    where
        'a: 'b,
    {
        let rows = self.rows;
        Table {
            columns: self.columns,
            layout: self.layout,
            bounds: self.bounds,
            count: self.count,
            sums: self.sums,
            rows: Box::new(move |numbers| {
                let rows = rows(numbers)?;
                Ok(Box::new(rows.inspect(move |row| {
                    if let Ok(row) = row {
                        look(row);
                    }
                })))
            }),
        }
    }

    /// A table of these rows, a line a row; `noun` says in the plural what they are.
    #[doc(hidden)]
    pub fn of_rows(
        columns: Vec<Column>,
        noun: &'static str,
        rows: impl Iterator<Item = Row> + 'a,
    ) -> Self {
        Self::made_for(columns, noun, |_| Ok(Box::new(rows)))
    }

    /// A table whose rows are made for the number format in which they are shown.
    pub(super) fn made_for(
        columns: Vec<Column>,
        noun: &'static str,
        rows: impl FnOnce(NumberFormat) -> Result<RowIter<'a>, Error> + 'a,
    ) -> Self {
        Self {
            columns,
            layout: Layout::Rows(noun),
            bounds: Vec::new(),
            count: None,
            sums: None,
            rows: Box::new(rows),
        }
    }

    /// Returns the table with what makes the sums of its columns.
    pub(super) fn summed(self, sums: impl FnOnce() -> Result<Vec<Surd>, Error> + 'a) -> Self {
        Self {
            sums: Some(Sums::LayerGap(Box::new(sums))),
            ..self
        }
    }

    /// Returns the table, whose columns are summed up from its rows.
    #[doc(hidden)]
    #[must_use]
    pub fn summed_by_rows(self) -> Self {
        Self {
            sums: Some(Sums::OfRows),
            ..self
        }
    }

    /// With so many rows, none of which exceeds `bounds`.
    #[doc(hidden)]
    #[must_use]
    pub fn bounded(self, count: BigUint, bounds: Vec<Cell>) -> Self {
        Self {
            bounds,
            count: Some(count),
            ..self
        }
    }

    /// The columns, in order.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use cannonpile_dem::table;
    /// use cannonpile_dem::table::Units;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let table = table::base(&Units::of_pile(&pile), Selection::Base)?;
    /// let normal = &table.columns()[2];
    /// assert_eq!((normal.name, normal.unit, normal.summed), ("normal", "mg", true));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// How many rows the table has; `None` where that is known only when all are made, as in a census.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use cannonpile_dem::table;
    /// use cannonpile_dem::table::Units;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let table = table::contacts(&Units::of_pile(&pile), Selection::All)?;
    /// assert_eq!(table.row_count(), Some(495_u32.into()));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn row_count(&self) -> Option<BigUint> {
        self.count.clone()
    }

    /// The table with an observer, which is called from time to time with how many more rows have been made, the last
    /// of them included.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use cannonpile_dem::table;
    /// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut rows = 0;
    /// table::contacts(&Units::of_pile(&pile), Selection::All)?
    ///     .observed(|more| rows += more)
    ///     .write(FileFormat::Csv, NumberFormat::Exact, &mut std::io::sink())?;
    /// assert_eq!(rows, 495);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn observed(self, observer: impl FnMut(u64) + 'a) -> Self {
        let rows = self.rows;
        let observed = move |numbers| -> Result<RowIter<'a>, Error> {
            let mut progress = Progress::new(observer);
            Ok(Box::new(rows(numbers)?.inspect(move |_| progress.row())))
        };
        Self {
            rows: Box::new(observed),
            ..self
        }
    }
}
