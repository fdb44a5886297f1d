//! Measured forces in the `dump local` files of LAMMPS.
//!
//! ```text
//! compute      ids all property/local patom1 patom2
//! compute      f all pair/local force fx fy fz
//! dump         d all local 1000 contacts.dump c_ids[1] c_ids[2] c_f[1] c_f[2] c_f[3] c_f[4]
//! dump_modify  d format float %.17g colname c_ids[1] id1 colname c_ids[2] id2 colname c_f[1] force &
//!              colname c_f[2] fx colname c_f[3] fy colname c_f[4] fz
//! ```
//! Names such as `c_ids[1]` do not tell the quantity: they are named by `colname` here, or by `--columns`. Without the
//! `format` option LAMMPS writes six digits: forces then have an error of up to 5e-6, and large ids lose digits.
//!
//! The header may use another label than `ENTRIES`, lines with the units and the time, and any kind of box. Blanks
//! separate the cells. Snapshots of one time step belong together, as when each process writes its own.

use std::io::BufRead;

use crate::contact::{Contact, keep};
use crate::error::{Error, Fault, Syntax};
use crate::format::Format;
use crate::header::Header;
use crate::lines::{Line, Lines};
use crate::steps::Steps;

/// The prefix of a header line.
const ITEM: &str = "ITEM:";

/// Reads the snapshots of the chosen step of a dump.
pub(crate) fn read(
    input: impl BufRead,
    format: &Format,
    steps: &mut Steps,
    rows: &mut Vec<Contact>,
) -> Result<(), Error> {
    let mut lines = Lines::new(input);
    let mut snapshots = 0_u64;
    let mut header = Snapshot::default();
    while let Some((number, item)) = next_item(&mut lines, &header)? {
        match &*item {
            "TIMESTEP" => {
                let step: i64 = integer(&mut lines, "a time step such as 500")?;
                header.timestep = Some(step.to_string());
            }
            "UNITS" | "TIME" => _ = whole_line(&mut lines)?,
            _ if item.starts_with("BOX BOUNDS") => {
                for _ in 0..3 {
                    whole_line(&mut lines)?;
                }
            }
            _ => match (item.strip_prefix("NUMBER OF "), header.columns(&item)) {
                (Some(label), None) => {
                    header.label = Some(label.to_owned());
                    header.entries = integer(&mut lines, "a number of entries such as 495")?;
                }
                (_, Some(names)) => {
                    let names: Vec<&str> = names.split_whitespace().collect();
                    let columns = Header::find(Some(&names), names.len(), format);
                    let columns = columns.map_err(|fault| fault.at(number))?;
                    let step = header.timestep.as_deref().unwrap_or("without a number");
                    let is_read = steps.reads(step);
                    let is_read = is_read.map_err(|fault| fault.at(number))?;
                    if steps.has_begun() {
                        rows.clear();
                    }
                    let rows = is_read.then_some(&mut *rows);
                    entries(&mut lines, &columns, header.entries, steps, rows)?;
                    snapshots += 1;
                    header = Snapshot::default();
                }
                (None, None) => {
                    let expected = "an item of a LAMMPS dump local file: TIMESTEP, NUMBER OF ENTRIES, BOX BOUNDS, ENTRIES";
                    return Err(unexpected(&item, expected).at(number));
                }
            },
        }
    }
    if snapshots == 0 {
        return Err(Fault::empty().at(lines.number()));
    }
    Ok(())
}

/// The header of a snapshot, as read so far.
#[derive(Default)]
struct Snapshot {
    timestep: Option<String>,
    /// The label of the entries: `ENTRIES`, unless the user chose another word.
    label: Option<String>,
    entries: u64,
}

impl Snapshot {
    /// Returns the names of the columns, if this item contains them.
    fn columns<'i>(&self, item: &'i str) -> Option<&'i str> {
        let names = item.strip_prefix(self.label.as_deref()?)?;
        (names.is_empty() || names.starts_with(' ')).then_some(names)
    }

    fn is_begun(&self) -> bool {
        self.timestep.is_some() || self.label.is_some()
    }
}

/// Returns the next item with its line number, or `None` at the end of a complete snapshot.
fn next_item(
    lines: &mut Lines<impl BufRead>,
    header: &Snapshot,
) -> Result<Option<(u64, String)>, Error> {
    let (number, text, ended) = loop {
        match lines.next()? {
            Some(line) if line.text.trim().is_empty() => {}
            Some(line) => break (line.number, line.text.to_owned(), line.ended),
            None if header.is_begun() => return Err(cut(lines.number())),
            None => return Ok(None),
        }
    };
    match text.strip_prefix(ITEM) {
        Some(item) if ended => Ok(Some((number, item.trim().to_owned()))),
        Some(_) => Err(cut(number)),
        None => {
            let expected = "a line that begins with ITEM: (are there more entries than announced?)";
            Err(unexpected(&text, expected).at(number))
        }
    }
}

/// Returns the next line, which must have an end.
fn whole_line(lines: &mut Lines<impl BufRead>) -> Result<Line<'_>, Error> {
    let last = lines.number();
    match lines.next()? {
        Some(line) if line.ended => Ok(line),
        Some(line) => Err(cut(line.number)),
        None => Err(cut(last)),
    }
}

fn integer<T: core::str::FromStr>(
    lines: &mut Lines<impl BufRead>,
    expected: &'static str,
) -> Result<T, Error> {
    let line = whole_line(lines)?;
    let integer = line.text.trim().parse();
    integer.map_err(|_| unexpected(line.text, expected).at(line.number))
}

/// Reads the entries of a snapshot, which are left out if there are no rows for them.
fn entries(
    lines: &mut Lines<impl BufRead>,
    columns: &Header,
    announced: u64,
    steps: &mut Steps,
    mut rows: Option<&mut Vec<Contact>>,
) -> Result<(), Error> {
    for found in 0..announced {
        let last = lines.number();
        let truncated = |line| {
            Fault::new(format!(
                "the snapshot ends after {found} of {announced} entries: it is not complete"
            ))
            .at(line)
        };
        let Some(line) = lines.next()? else {
            return Err(truncated(last));
        };
        if line.text.starts_with(ITEM) {
            return Err(truncated(line.number));
        }
        if !line.ended {
            return Err(cut(line.number));
        }
        let Some(rows) = &mut rows else {
            steps.rows.other_steps += 1;
            continue;
        };
        let cells: Vec<&str> = line.text.split_whitespace().collect();
        let row = columns.read(&cells, line.number);
        let row = row.map_err(|fault| fault.at(line.number))?;
        if let Some(contact) = steps.count(&row, line.number)? {
            keep(rows, contact)?;
        }
    }
    Ok(())
}

fn unexpected(text: &str, expected: &'static str) -> Fault {
    Fault::new(Syntax::new(text, expected).to_string())
}

/// Returns the error of a dump that is not complete.
fn cut(line: u64) -> Error {
    Fault::new("the dump ends here, within a line or a header: it is not complete").at(line)
}
