//! Tables as text, with one contact on each line.

use super::Format;
use super::counts::Counted;
use super::detect::{self, is_of_numbers};
use super::dialect::Dialect;
use super::header::{Header, Row};
use super::lines::Lines;
use super::source::Source;
use super::steps::Steps;
use crate::verify::entry::Sink;
use crate::verify::refusal::{Fault, Refusal};

/// Reads the rows of a table.
pub(in crate::verify) fn read(
    source: Source<'_>,
    format: &Format,
    steps: &mut Steps<'_>,
    sink: &mut Counted<'_, impl Sink>,
) -> Result<Dialect, Refusal> {
    let (dialect, header) = detect::find(
        &source.sample,
        source.is_whole,
        &format.dialect,
        &format.columns,
        format.needs,
    )?;
    let options = &format.dialect;
    let skipped = options.skip.unwrap_or(0);
    // Lines are counted from 1, so without a header the rows may begin at once.
    let begin = dialect.header.unwrap_or(skipped);
    let mut is_unit_row = options.unit_row == Some(true);
    let mut quote = OpenQuote(None);
    let mut lines = Lines::new(source.all());
    while let Some(line) = lines.next()? {
        let (number, text) = (line.number, line.text);
        if number <= skipped || text.trim().is_empty() {
            continue;
        }
        if let Some(text) = dialect.comment(text) {
            let is_row = number > begin
                && text.starts_with(|c: char| c.is_ascii_digit() || "+-.\"".contains(c))
                && matches!(header.read(&dialect.cut(text).0), Ok(Row::Entry(_)));
            sink.rows.commented += u64::from(is_row);
            continue;
        }
        let (cells, open) = dialect.cut(text);
        // Without a header, a text may precede the rows.
        let is_above =
            number < dialect.first_row && dialect.header.is_none() && cells.len() != header.width();
        if number <= begin || is_above || core::mem::take(&mut is_unit_row) {
            if is_of_numbers(&cells) {
                sink.rows.leave_above(number);
            }
            continue;
        }
        quote.follow(&dialect, &header, (number, text), (&cells, open))?;
        let step = header.step(&cells).filter(|_| !header.is_text(&cells));
        let is_read = step.map_or(Ok(true), |step| steps.reads(step, sink));
        if !is_read.map_err(|fault| fault.at(number))? {
            sink.rows.other_steps += 1;
            continue;
        }
        let row = header.read(&cells).or_else(|fault| {
            let before = dialect.before_comment(text);
            let before = before.map(|text| header.read(&dialect.cut(text).0));
            match before {
                Some(Ok(Row::Entry(entry))) => Ok(Row::Entry(entry)),
                _ if open.is_some() => Err(Fault::Quote),
                _ => Err(fault),
            }
        });
        match row.map_err(|fault| fault.at(number))? {
            // A text above the first row is one of units.
            Row::Text if number < dialect.first_row && options.unit_row != Some(false) => {}
            row => sink.put(&row, number)?,
        }
    }
    Ok(dialect)
}

/// The line of a quote that is still open.
struct OpenQuote(Option<u64>);

impl OpenQuote {
    /// Follows a quoted cell that continues on the next lines. Refuses numbers behind its quote, because they may be part
    /// of the cell.
    fn follow(
        &mut self,
        dialect: &Dialect,
        header: &Header,
        (number, text): (u64, &str),
        (cells, open): (&[&str], Option<usize>),
    ) -> Result<(), Refusal> {
        let Some(first) = self.0.map_or(open, |_| Some(0)) else {
            return Ok(());
        };
        let begin = self.0.unwrap_or(number);
        let mut behind = cells.to_vec();
        behind.iter_mut().take(first).for_each(|cell| *cell = "");
        if !header.is_text(&behind) {
            return Err(Fault::Quote.at(begin));
        }
        // In a quoted cell, other quotes are doubled.
        let quotes = text.chars().filter(|c| Some(*c) == dialect.quote).count();
        let is_closed = self.0.is_some() && quotes % 2 == 1;
        self.0 = (!is_closed).then_some(begin);
        Ok(())
    }
}
