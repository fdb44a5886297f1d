//! Tables as aligned text, with units in the head and sums at the foot.

use std::io::Write;

use num_bigint::BigUint;
use num_traits::Zero;

use super::cell::{Cell, NumberFormat};
use super::error::WriteError;
use super::line::Line;
use super::rows::{Column, RowIter, Sums, show};
use crate::Error;
use crate::error::bug;
use cannonpile::scalar::Surd;

/// The number of rows that are aligned together. Only one page is in memory.
pub(super) const PAGE: usize = 4096;

/// The number of rows that are aligned together if the number of rows is unknown.
pub(super) const SHORT_PAGE: usize = 256;

/// Writes one line per column: name, value, unit.
pub(super) fn write_record(
    columns: &[Column],
    rows: RowIter<'_>,
    numbers: NumberFormat,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let [heads, units] = heads(columns, numbers);
    let width = heads.fields().map(str::len).fold(0, usize::max);
    let mut line = Line::default();
    for row in rows {
        show(columns, &row?, numbers, &mut line)?;
        for ((head, unit), text) in heads.fields().zip(units.fields()).zip(line.fields()) {
            let (text, unit) = if text.is_empty() {
                ("-", "")
            } else {
                (text, unit)
            };
            let line = format!("{head:width$}  {text} {unit}");
            writeln!(out, "{}", line.trim_end())?;
        }
    }
    Ok(())
}

/// Writes one line per row. Each column is as wide as its widest entry so far.
pub(super) fn write_rows(
    columns: &[Column],
    (mut rows, page_length): (RowIter<'_>, usize),
    mut sums: Option<Sums<'_>>,
    noun: &str,
    numbers: NumberFormat,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let [heads, units] = heads(columns, numbers);
    let mut bracketed = Line::default();
    for unit in units.fields() {
        match unit {
            "" => bracketed.push_str(""),
            unit => bracketed.push(format_args!("[{unit}]")),
        }
    }
    let mut page = vec![heads];
    page.extend(Some(bracketed).filter(|_| units.fields().any(|unit| !unit.is_empty())));
    let mut widths = vec![0; units.fields().count()];
    // Only the last page contains the word in its totals.
    if let (Some(first), true) = (widths.first_mut(), sums.is_some()) {
        *first = "total".len();
    }
    let mut count = BigUint::zero();
    let summed = columns.iter().filter(|column| column.summed);
    let mut of_rows: Vec<Surd> = summed.map(|_| Surd::zero()).collect();
    loop {
        let mut taken = 0;
        for row in rows.by_ref().take(page_length) {
            let row = row?;
            let mut line = Line::default();
            show(columns, &row, numbers, &mut line)?;
            if let Some(Sums::OfRows) = sums {
                add_row(&mut of_rows, columns, &row)?;
            }
            page.push(line);
            taken += 1;
        }
        count += taken;
        let last = taken < page_length;
        let totals = match sums.take_if(|_| last) {
            Some(Sums::Computed(sums)) => Some(totals(columns, sums()?, numbers)),
            Some(Sums::OfRows) => Some(totals(columns, core::mem::take(&mut of_rows), numbers)),
            None => None,
        };
        for line in page.iter().chain(&totals) {
            for (width, text) in widths.iter_mut().zip(line.fields()) {
                *width = text.chars().count().max(*width);
            }
        }
        for line in page.drain(..) {
            write_line(out, &line, &widths)?;
        }
        if !last {
            continue;
        }
        if let Some(totals) = totals {
            let gaps = 2 * widths.len().saturating_sub(1);
            writeln!(out, "{}", "-".repeat(widths.iter().sum::<usize>() + gaps))?;
            write_line(out, &totals, &widths)?;
        }
        let noun = if count == BigUint::from(1_u32) {
            noun.trim_end_matches('s')
        } else {
            noun
        };
        return Ok(writeln!(out, "{count} {noun}")?);
    }
}

/// Adds the exact cells of a row to the sums of the columns.
fn add_row(sums: &mut [Surd], columns: &[Column], row: &[Cell]) -> Result<(), Error> {
    let summed = columns.iter().zip(row).filter(|(column, _)| column.summed);
    for (sum, (_, cell)) in sums.iter_mut().zip(summed) {
        let added = match cell {
            Cell::Number(x) => sum.checked_add(x),
            _ => None,
        };
        *sum = added.ok_or_else(|| bug("the forces of a sphere in a column have one root"))?;
    }
    Ok(())
}

/// Returns the headers and the units.
fn heads(columns: &[Column], numbers: NumberFormat) -> [Line; 2] {
    let mut lines = [Line::default(), Line::default()];
    let [heads, units] = &mut lines;
    for column in columns {
        for head in column.heads(numbers) {
            heads.push_str(&head);
            units.push_str(column.unit);
        }
    }
    lines
}

/// Returns the sums, after the word `total`.
fn totals(columns: &[Column], sums: Vec<Surd>, numbers: NumberFormat) -> Line {
    let mut sums = sums.into_iter();
    let mut line = Line::default();
    for (n, column) in columns.iter().enumerate() {
        let places = column.places(numbers);
        let word = if n == 0 { "total" } else { "" };
        let sum = if column.summed { sums.next() } else { None };
        let cell = match sum {
            // The rows are already written, so a sum outside the range of the float type is shown exactly.
            Some(sum) if !fits(&sum, numbers) => Cell::Word(sum.to_string().into()),
            Some(sum) => sum.into(),
            None => word.into(),
        };
        // The arm above handles a sum that does not fit, so this call does not fail.
        let _ = cell.show(numbers, column.name, places, &mut line);
    }
    line
}

fn fits(sum: &Surd, numbers: NumberFormat) -> bool {
    let shown: Result<_, Error> = numbers.show(sum, "sum");
    shown.is_ok()
}

fn write_line(out: &mut dyn Write, line: &Line, widths: &[usize]) -> Result<(), WriteError> {
    let mut padded = String::new();
    for (text, width) in line.fields().zip(widths) {
        let gap = width.saturating_sub(text.chars().count());
        padded.extend(core::iter::repeat_n(' ', gap));
        padded.push_str(text);
        padded.push_str("  ");
    }
    Ok(writeln!(out, "{}", padded.trim_end())?)
}
