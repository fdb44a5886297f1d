//! Columns, and rows generated on request.

use num_bigint::BigUint;

use super::cell::{Cell, NumberFormat};
use super::line::Line;
use super::progress::Progress;
use crate::Error;
use cannonpile::scalar::Surd;

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// The header in csv, and the key in json.
    pub name: &'static str,
    /// The unit; empty for a column without a unit.
    pub unit: &'static str,
    /// Whether the text table shows the sum of the column.
    pub summed: bool,
    /// Whether the column contains quantities in the requested number format.
    pub quantity: bool,
}

impl Column {
    /// Returns a column without a unit or a sum.
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

    /// Returns a column of quantities with a unit.
    #[doc(hidden)]
    #[must_use]
    pub fn measured(name: &'static str, unit: &'static str) -> Self {
        Self {
            unit,
            quantity: true,
            ..Self::plain(name)
        }
    }

    /// Returns a column of quantities with a unit and a sum.
    #[doc(hidden)]
    #[must_use]
    pub fn summed(name: &'static str, unit: &'static str) -> Self {
        Self {
            summed: true,
            ..Self::measured(name, unit)
        }
    }

    /// Returns the number of headers: two for intervals, otherwise one.
    pub(super) fn places(&self, numbers: NumberFormat) -> usize {
        1 + usize::from(self.quantity && numbers == NumberFormat::Interval)
    }

    /// Returns the names in csv and json, which show no units. A ratio in a unit that contains θ has the unit in its name.
    pub(super) fn keys(&self, numbers: NumberFormat) -> Vec<String> {
        let unit = match self.unit {
            "tan²θ" => "tan2_theta",
            "tanθ" => "tan_theta",
            "tan(θ/2)" => "tan_half_theta",
            "√3·tanθ" => "sqrt3_tan_theta",
            "2cosφ·tanθ" => "2cos_phi_tan_theta",
            _ => return self.heads(numbers),
        };
        self.named(&format!("{}_over_{unit}", self.name), numbers)
    }

    /// Returns the headers.
    pub(super) fn heads(&self, numbers: NumberFormat) -> Vec<String> {
        self.named(self.name, numbers)
    }

    fn named(&self, name: &str, numbers: NumberFormat) -> Vec<String> {
        match self.places(numbers) {
            1 => vec![name.to_owned()],
            _ => vec![format!("{name}_lo"), format!("{name}_hi")],
        }
    }
}

/// A row, or the error that prevented it.
pub type Row = Result<Vec<Cell>, Error>;

/// Replaces the texts of a line by those of a row.
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

/// An iterator over rows.
pub(crate) type RowIter<'a> = Box<dyn Iterator<Item = Row> + 'a>;

/// Boxes rows. The vtable of another iterator would contain more than `next`.
pub(super) fn boxed<'a>(mut rows: impl Iterator<Item = Row> + 'a) -> RowIter<'a> {
    Box::new(core::iter::from_fn(move || rows.next()))
}

/// Generates the rows for a format of numbers.
pub(super) type MakeRows<'a> = Box<dyn FnOnce(NumberFormat) -> Result<RowIter<'a>, Error> + 'a>;

/// The source of the sums of columns. Sums are in the order of the columns.
pub(super) enum Sums<'a> {
    /// A function that computes the sums without the rows, for tables that may be long.
    Computed(Box<dyn FnOnce() -> Result<Vec<Surd>, Error> + 'a>),
    /// The exact cells of the rows, for tables of few rows.
    OfRows,
}

/// The layout of a text table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// One line per row. The plural noun names the rows.
    Rows(&'static str),
    /// One line per column, for a table of one row.
    Record,
}

/// A table: columns, and rows generated on request. [`base`](super::base), [`contacts`](super::contacts) and other
/// functions return tables.
pub struct Table<'a> {
    pub(super) columns: Vec<Column>,
    pub(super) layout: Layout,
    /// A row that no other row exceeds, for quantities that may overflow.
    pub(super) bounds: Vec<Cell>,
    /// The number of rows, if it is known.
    count: Option<BigUint>,
    /// The generator of the rows for a number format.
    pub(super) rows: MakeRows<'a>,
    /// A second generator of the rows, to check all of them before the first is written.
    pub(super) again: Option<MakeRows<'a>>,
    pub(super) sums: Option<Sums<'a>>,
}

impl Table<'static> {
    /// Returns a table of one row, shown with one line per column.
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
    /// Returns the table with a function `look` that is called with each row before the row is written.
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
                Ok(boxed(rows.inspect(move |row| {
                    if let Ok(row) = row {
                        look(row);
                    }
                })))
            }),
            again: self.again.map(|again| -> MakeRows<'b> {
                Box::new(|numbers| {
                    let rows: RowIter<'b> = again(numbers)?;
                    Ok(rows)
                })
            }),
        }
    }

    /// Returns a table of these rows, shown with one line per row. The plural `noun` names the rows.
    #[doc(hidden)]
    pub fn of_rows(
        columns: Vec<Column>,
        noun: &'static str,
        rows: impl Iterator<Item = Row> + 'a,
    ) -> Self {
        Self::of(columns, noun, Box::new(|_| Ok(boxed(rows))))
    }

    /// Returns a table whose rows are generated for the requested number format.
    pub(super) fn made_for(
        columns: Vec<Column>,
        noun: &'static str,
        rows: impl FnOnce(NumberFormat) -> Result<RowIter<'a>, Error> + Clone + 'a,
    ) -> Self {
        Self {
            again: Some(Box::new(rows.clone())),
            ..Self::of(columns, noun, Box::new(rows))
        }
    }

    fn of(columns: Vec<Column>, noun: &'static str, rows: MakeRows<'a>) -> Self {
        Self {
            columns,
            layout: Layout::Rows(noun),
            bounds: Vec::new(),
            count: None,
            sums: None,
            rows,
            again: None,
        }
    }

    /// Returns the table with a function that computes the sums of its columns.
    pub(super) fn summed(self, sums: impl FnOnce() -> Result<Vec<Surd>, Error> + 'a) -> Self {
        Self {
            sums: Some(Sums::Computed(Box::new(sums))),
            ..self
        }
    }

    /// Returns the table with sums computed from its rows.
    #[doc(hidden)]
    #[must_use]
    pub fn summed_by_rows(self) -> Self {
        Self {
            sums: Some(Sums::OfRows),
            ..self
        }
    }

    /// Returns the table with the number of its rows, and a row of bounds that no row exceeds. The bounds may be wide: rows
    /// that fit a format count, even if the bounds do not fit.
    #[doc(hidden)]
    #[must_use]
    pub fn bounded(self, count: BigUint, bounds: Vec<Cell>) -> Self {
        Self {
            bounds,
            count: Some(count),
            ..self
        }
    }

    /// Returns the columns, in order.
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

    /// Returns the number of rows; `None` if the number is unknown before all rows are generated, as in a census.
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

    /// Returns the table with an observer. The observer is called from time to time with the number of further rows,
    /// including the last ones.
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
            Ok(boxed(rows(numbers)?.inspect(move |_| progress.row())))
        };
        Self {
            rows: Box::new(observed),
            ..self
        }
    }
}
