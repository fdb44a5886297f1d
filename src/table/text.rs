//! A table for people: aligned, units in the head, sums below.

use std::io::Write;

use num_bigint::BigUint;
use num_traits::Zero;

use super::rows::{Column, Layout, Row, texts};
use super::{Cell, NumberFormat, Table, WriteError};
use crate::scalar::Surd;

/// How many rows are aligned together: a page is all that is held in memory.
const PAGE: usize = 4096;

/// The same of a table of which nothing is known before its rows are made: each of them may take long.
const SHORT_PAGE: usize = 256;

pub(super) fn write(
    table: Table<'_>,
    numbers: NumberFormat,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    match table.layout {
        Layout::Record => write_record(table, numbers, out),
        Layout::Rows(noun) => write_rows(table, noun, numbers, out),
    }
}

/// A line a column: name, value, unit.
fn write_record(
    table: Table<'_>,
    numbers: NumberFormat,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let heads = heads(&table.columns, numbers);
    let width = heads.iter().map(|(head, _)| head.len()).max().unwrap_or(0);
    for row in table.rows {
        let texts = texts(&table.columns, &row?, numbers)?;
        for ((head, unit), text) in heads.iter().zip(texts) {
            let (text, unit) = if text.is_empty() {
                ("-", "")
            } else {
                (&*text, *unit)
            };
            let line = format!("{head:width$}  {text} {unit}");
            writeln!(out, "{}", line.trim_end())?;
        }
    }
    Ok(())
}

/// A line a row, in columns as wide as the extremes of the table and their widest entry so far.
fn write_rows(
    mut table: Table<'_>,
    noun: &str,
    numbers: NumberFormat,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let columns = table.columns;
    let mut sums: Vec<Sum> = columns.iter().map(|_| Sum::default()).collect();
    let (heads, units) = heads(&columns, numbers)
        .into_iter()
        .map(|(head, unit)| (head, bracketed(unit)))
        .unzip();
    let mut page = vec![heads, units];
    let mut widths = first_widths(&columns, &table.extremes, numbers)?;
    let mut count = BigUint::zero();
    let unknown = table.extremes.is_empty() && table.bounds.is_empty();
    let page_length = if unknown { SHORT_PAGE } else { PAGE };
    loop {
        let rows: Vec<Row> = table.rows.by_ref().take(page_length).collect();
        let last = rows.len() < page_length;
        for row in rows {
            let row = row?;
            for (sum, cell) in sums.iter_mut().zip(&row) {
                sum.add(cell);
            }
            page.push(texts(&columns, &row, numbers)?);
            count += 1_u32;
        }
        let totals = if last {
            total_row(&columns, &sums, numbers)
        } else {
            None
        };
        for line in page.iter().chain(&totals) {
            for (width, text) in widths.iter_mut().zip(line) {
                *width = text.chars().count().max(*width);
            }
        }
        for line in &page {
            write_line(out, line, &widths)?;
        }
        page.clear();
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

/// Headers and units.
fn heads(columns: &[Column], numbers: NumberFormat) -> Vec<(String, &'static str)> {
    let heads = |column: &Column| {
        let unit = column.unit;
        column
            .heads(numbers)
            .into_iter()
            .map(move |head| (head, unit))
    };
    columns.iter().flat_map(heads).collect()
}

/// Widths that the extremes of the table and the word `total` fit in, so that pages rarely differ.
fn first_widths(
    columns: &[Column],
    extremes: &[Row],
    numbers: NumberFormat,
) -> Result<Vec<usize>, WriteError> {
    let mut widths = vec![0; heads(columns, numbers).len()];
    if let (Some(first), true) = (widths.first_mut(), columns.iter().any(|c| c.summed)) {
        *first = "total".len();
    }
    for row in extremes {
        let texts = texts(columns, row.as_ref().map_err(Clone::clone)?, numbers)?;
        for (width, text) in widths.iter_mut().zip(texts) {
            *width = text.chars().count().max(*width);
        }
    }
    Ok(widths)
}

/// The sums below, under the word `total`; none if no column has one.
fn total_row(columns: &[Column], sums: &[Sum], numbers: NumberFormat) -> Option<Vec<String>> {
    if !columns.iter().any(|column| column.summed) {
        return None;
    }
    let mut texts = Vec::with_capacity(columns.len());
    for (n, (column, sum)) in columns.iter().zip(sums).enumerate() {
        let places = column.heads(numbers).len();
        texts.extend(match &sum.0 {
            // A sum beyond the floats is shown exactly: its rows are out already, and right.
            Some(value) if column.summed => Cell::Number(value.clone())
                .texts(numbers, column)
                .unwrap_or_else(|_| vec![value.to_string(); places]),
            _ if n == 0 => vec!["total".to_owned(); places],
            _ => vec![String::new(); places],
        });
    }
    Some(texts)
}

fn bracketed(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!("[{unit}]")
    }
}

fn write_line(out: &mut dyn Write, texts: &[String], widths: &[usize]) -> Result<(), WriteError> {
    let mut line = String::new();
    for (text, width) in texts.iter().zip(widths) {
        let gap = width.saturating_sub(text.chars().count());
        line.extend(core::iter::repeat_n(' ', gap));
        line.push_str(text);
        line.push_str("  ");
    }
    Ok(writeln!(out, "{}", line.trim_end())?)
}

/// The exact sum of a column whose numbers are multiples of one root; none once two roots have met.
struct Sum(Option<Surd>);

impl Default for Sum {
    fn default() -> Self {
        Self(Some(Surd::zero()))
    }
}

impl Sum {
    fn add(&mut self, cell: &Cell) {
        if let Cell::Number(number) = cell {
            self.0 = self.0.take().and_then(|sum| sum.checked_add(number));
        }
    }
}
