//! Tables as text, with one contact on each line.

use crate::contact::Contact;
use crate::detect::{self, is_of_numbers};
use crate::dialect::Dialect;
use crate::error::{Error, Fault};
use crate::format::Format;
use crate::header::{Header, Row};
use crate::input::{Bytes, Input};
use crate::lines::Lines;
use crate::steps::Steps;

/// A text table, read line by line.
pub(crate) struct Text<'r> {
    pub(crate) dialect: Dialect,
    header: Header,
    lines: Lines<Bytes<'r>>,
    skipped: u64,
    /// True if the next line below the header is one of units.
    is_unit_row: bool,
    /// False if a text below the header is a row.
    may_have_units: bool,
    quote: OpenQuote,
}

impl<'r> Text<'r> {
    pub(crate) fn open(input: Input<'r>, format: &Format) -> Result<Self, Error> {
        let (dialect, header) = detect::find(&input.sample, input.is_whole, format)?;
        let options = &format.dialect;
        Ok(Self {
            dialect,
            header,
            lines: Lines::new(input.all()),
            skipped: options.skip.unwrap_or(0),
            is_unit_row: options.unit_row == Some(true),
            may_have_units: options.unit_row != Some(false),
            quote: OpenQuote(None),
        })
    }

    /// Returns whether the table has a column of steps.
    pub(crate) fn has_steps(&self) -> bool {
        self.header.has_steps()
    }

    /// Returns the next contact, or `None` at the end.
    pub(crate) fn next(&mut self, steps: &mut Steps) -> Result<Option<Contact>, Error> {
        let (dialect, header) = (&self.dialect, &self.header);
        // Lines are counted from 1, so without a header the rows may begin at once.
        let begin = dialect.header.unwrap_or(self.skipped);
        while let Some(line) = self.lines.next()? {
            let (number, text) = (line.number, line.text);
            if number <= self.skipped || text.trim().is_empty() {
                continue;
            }
            if let Some(text) = dialect.comment(text) {
                let is_row = number > begin
                    && text.starts_with(|c: char| c.is_ascii_digit() || "+-.\"".contains(c))
                    && matches!(
                        header.read(&dialect.cut(text).0, number),
                        Ok(Row::Contact(_))
                    );
                steps.rows.commented += u64::from(is_row);
                continue;
            }
            let before = dialect
                .before_comment(text)
                .filter(|_| header.ends_with_word());
            let before = before.map(|row| dialect.cut(row));
            let is_whole = |(cells, _): &(Vec<_>, _)| cells.len() == header.width();
            let (cells, open) = before.filter(is_whole).unwrap_or_else(|| dialect.cut(text));
            // Without a header, a text may precede the rows.
            let is_above = number < dialect.first_row
                && dialect.header.is_none()
                && cells.len() != header.width();
            if number <= begin || is_above || core::mem::take(&mut self.is_unit_row) {
                if is_of_numbers(&cells) {
                    steps.rows.leave_above(number);
                }
                continue;
            }
            self.quote
                .follow(dialect, header, (number, text), (&cells, open))?;
            let step = header.step(&cells).filter(|_| !header.is_text(&cells));
            let is_read = step.map_or(Ok(true), |step| steps.reads(step));
            if !is_read.map_err(|fault| fault.at(number))? {
                steps.rows.other_steps += 1;
                continue;
            }
            let row = header.read(&cells, number).or_else(|fault| {
                let before = dialect.before_comment(text);
                let before = before.map(|text| header.read(&dialect.cut(text).0, number));
                match before {
                    Some(Ok(Row::Contact(contact))) => Ok(Row::Contact(contact)),
                    _ if open.is_some() => Err(Fault::new(QUOTE)),
                    _ => Err(fault),
                }
            });
            match row.map_err(|fault| fault.at(number))? {
                // A text above the first row is one of units.
                Row::Text if number < dialect.first_row && self.may_have_units => {}
                row => {
                    if let Some(contact) = steps.count(&row, number)? {
                        return Ok(Some(contact));
                    }
                }
            }
        }
        Ok(None)
    }
}

const QUOTE: &str = "a quote does not end on its line: close it, set quote to none, or begin the line with # if it is not a row";

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
    ) -> Result<(), Error> {
        let Some(first) = self.0.map_or(open, |_| Some(0)) else {
            return Ok(());
        };
        let begin = self.0.unwrap_or(number);
        let mut behind = cells.to_vec();
        behind.iter_mut().take(first).for_each(|cell| *cell = "");
        if !header.is_text(&behind) {
            return Err(Fault::new(QUOTE).at(begin));
        }
        // In a quoted cell, other quotes are doubled.
        let quotes = text.chars().filter(|c| Some(*c) == dialect.quote).count();
        let is_closed = self.0.is_some() && quotes % 2 == 1;
        self.0 = (!is_closed).then_some(begin);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::{Contact, Error, Force, Format, Spheres, read};

    fn contacts(table: &str, columns: &str) -> Result<Vec<Contact>, Error> {
        let format = Format::of(columns.parse().unwrap());
        read(table.as_bytes(), &format)?.collect()
    }
    fn refusal(table: &str, columns: &str) -> String {
        contacts(table, columns).unwrap_err().to_string()
    }

    #[test]
    fn a_comment_behind_a_row_is_not_part_of_its_step_or_kind() {
        let table = "id1,id2,force,step\n1,2,0.5,3\n1,3,0.5,3 # last\n1,4,0.5,3\n";
        let read = contacts(table, "force=force").unwrap();
        assert_eq!(read.len(), 3);
        let table = "id1,id2,force,kind\n1,2,0.5,SS\n1,3,0.5,SS # last\n1,0,0.5,SW # floor\n";
        assert_eq!(contacts(table, "kind=kind:SS").unwrap().len(), 2);
        let table = "id1,id2,force,step\n1,2,0.5,3\n1,3,0.5,\n";
        assert!(refusal(table, "force=force").contains("line 3: this row has no step"));
    }

    #[test]
    fn only_sums_are_split_at_a_minus() {
        let table = "i,j,f\n1,2,0.5\n1,3,0.25\n";
        let forces = contacts(table, "id1=i,id2=j,force=f-i").unwrap();
        assert!(matches!(forces[0].force, Force::Along(-0.5)));
        assert_eq!(forces[1].spheres, Spheres::Numbers([1, 3]));
        for columns in ["id1=i-j,id2=j,force=f", "id1=i,id2=j,force=f,step=i-j"] {
            assert!(refusal(table, columns).contains("no column 'i-j'"));
        }
    }

    #[test]
    fn infinite_sums_are_refused() {
        let table = "i,j,f,g\n1,2,1e300,1e308\n1,3,1,1\n";
        for sum in ["1e300*f", "1e300*f-g"] {
            let refusal = refusal(table, &format!("id1=i,id2=j,force={sum}"));
            assert!(refusal.contains("line 2: force is inf"), "{refusal}");
        }
    }
}
