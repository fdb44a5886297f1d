//! Tables as text, with one contact on each line.

use super::Format;
use super::dialect::{self, Dialect};
use super::header::Row;
use super::lines::Lines;
use super::rows::Counted;
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
    let (dialect, header) = dialect::find(
        &source.sample,
        source.is_whole,
        &format.dialect,
        &format.columns,
        format.identity,
    )?;
    let mut unit_row = format.dialect.unit_row == Some(true);
    let begin = dialect.header.or(format.dialect.skip).unwrap_or(0);
    let mut lines = Lines::new(source.all());
    while let Some(line) = lines.next()? {
        let (number, text) = (line.number, line.text);
        if number <= begin || text.trim().is_empty() {
            continue;
        }
        let mut cells = Vec::new();
        if let Some(text) = dialect.comment(text) {
            let is_row = text.starts_with(|c: char| c.is_ascii_digit() || "+-.\"".contains(c))
                && dialect.cut(text, &mut cells).is_ok()
                && matches!(header.read(&cells), Ok(Row::Entry(_)));
            sink.rows.commented += u64::from(is_row);
            continue;
        }
        if core::mem::take(&mut unit_row) {
            continue;
        }
        dialect
            .cut(text, &mut cells)
            .map_err(|fault| fault.at(number))?;
        if number < dialect.first_row && cells.len() != header.width() {
            continue;
        }
        if number < dialect.first_row && header.is_text(&cells) {
            continue;
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
        sink.row(&header, &cells, number)?;
    }
    Ok(dialect)
}
