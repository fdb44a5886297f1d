//! Tables as text, with one contact on each line.

use super::Format;
use super::counts::Counted;
use super::detect::{self, is_of_numbers};
use super::dialect::Dialect;
use super::header::Row;
use super::lines::Lines;
use super::source::Source;
use super::steps::{Steps, Use};
use crate::verify::entry::Sink;
use crate::verify::refusal::Refusal;

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
        format.identity,
    )?;
    let mut unit_row = format.dialect.unit_row == Some(true);
    // Lines are counted from 1, so without a header the rows may begin at once.
    let begin = dialect.header.or(format.dialect.skip).unwrap_or(0);
    let mut lines = Lines::new(source.all());
    while let Some(line) = lines.next()? {
        let (number, text) = (line.number, line.text);
        let mut cells = Vec::new();
        if number <= begin || text.trim().is_empty() {
            let is_skipped = format.dialect.skip.is_some_and(|skip| number <= skip);
            let is_left = !is_skipped
                && dialect.comment(text).is_none()
                && dialect.cut(text, &mut cells).is_ok()
                && is_of_numbers(&cells);
            if is_left {
                sink.rows.leave_above(number);
            }
            continue;
        }
        if let Some(text) = dialect.comment(text) {
            let is_row = text.starts_with(|c: char| c.is_ascii_digit() || "+-.\"".contains(c))
                && dialect.cut(text, &mut cells).is_ok()
                && matches!(header.read(&cells), Ok(Row::Entry(_)));
            sink.rows.commented += u64::from(is_row);
            continue;
        }
        if core::mem::take(&mut unit_row) {
            if dialect.cut(text, &mut cells).is_ok() && is_of_numbers(&cells) {
                sink.rows.leave_above(number);
            }
            continue;
        }
        dialect
            .cut(text, &mut cells)
            .map_err(|fault| fault.at(number))?;
        if number < dialect.first_row {
            // Below a header, a line with a number is a row.
            let is_row = dialect.header.is_some() && !header.is_text(&cells);
            let is_other = cells.len() != header.width();
            if is_other && is_row {
                return Err(header.row_of(cells.len()).at(number));
            }
            if is_other && (is_of_numbers(&cells) || !header.is_text(&cells)) {
                sink.rows.leave_above(number);
            }
            let has_units = format.dialect.unit_row != Some(false);
            if is_other || (has_units && header.is_text(&cells)) {
                continue;
            }
        }
        let step = header.step(&cells).filter(|_| !header.is_text(&cells));
        match step.map_or(Ok(Use::Same), |step| steps.next(step)) {
            Err(fault) => return Err(fault.at(number)),
            Ok(Use::Other) => {
                sink.rows.other_steps += 1;
                continue;
            }
            Ok(Use::New) => sink.begin_step(),
            Ok(Use::Same) => {}
        }
        let mut row = header.read(&cells);
        if row.is_err()
            && let Some(before) = dialect.before_comment(text)
            && dialect.cut(before, &mut cells).is_ok()
            && let Ok(Row::Entry(entry)) = header.read(&cells)
        {
            row = Ok(Row::Entry(entry));
        }
        let row = row.map_err(|fault| fault.at(number))?;
        sink.put(&row, number)?;
    }
    Ok(dialect)
}
