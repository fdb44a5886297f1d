//! Columns found by their names, and the fields in them read.

use core::fmt::Write;

use super::measured::Measured;
use super::refusal::Fault;
use crate::Error;

/// What is read, in order, with LAMMPS' own names for it.
const NAMES: [&[&str]; 6] = [
    &["id1", "patom1", "natom1"],
    &["id2", "patom2", "natom2"],
    &["force"],
    &["fx"],
    &["fy"],
    &["fz"],
];

/// Where the columns are that are read.
pub(super) struct Columns {
    /// For each column of the file its place in [`NAMES`], if it is read.
    places: Vec<Option<usize>>,
    with_force: bool,
    with_vector: bool,
}

impl Columns {
    /// Finds the columns of a header; what is not known is passed over.
    pub(super) fn new<'n>(names: impl IntoIterator<Item = &'n str>) -> Result<Self, Fault> {
        let names: Vec<&str> = names.into_iter().collect();
        let place = |name: &&str| NAMES.iter().position(|known| known.contains(name));
        let places: Vec<Option<usize>> = names.iter().map(place).collect();
        let mut found: [Option<&str>; 6] = [None; 6];
        for (name, place) in names.iter().zip(&places) {
            let Some(seen) = place.and_then(|place| found.get_mut(place)) else {
                continue;
            };
            if let Some(first) = seen.replace(name) {
                return Err(Fault::TwoColumns {
                    column: place_name(*place),
                    first: shortened(&[first]),
                    second: shortened(&[name]),
                });
            }
        }
        let [id1, id2, force, vector @ ..] = found.map(|name| name.is_some());
        let with_vector = vector.contains(&true);
        // A vector has a magnitude.
        let needed = [id1, id2, force || with_vector];
        let components = vector.map(|component| component || !with_vector);
        let missing = needed
            .into_iter()
            .chain(components)
            .position(|there| !there);
        match missing {
            None => Ok(Self {
                places,
                with_force: force,
                with_vector,
            }),
            Some(_) => Err(Fault::NoColumn {
                column: place_name(missing),
                found: shortened(&names),
            }),
        }
    }

    /// Reads the entry in the fields of a line.
    pub(super) fn read<'f>(
        &self,
        fields: impl IntoIterator<Item = &'f str>,
    ) -> Result<Measured, Fault> {
        let mut texts = [""; 6];
        let mut count = 0;
        for field in fields {
            let place = self.places.get(count).copied().flatten();
            if let Some(text) = place.and_then(|place| texts.get_mut(place)) {
                *text = field;
            }
            count += 1;
        }
        if count != self.places.len() {
            return Err(Fault::Fields {
                columns: self.places.len(),
                fields: count,
            });
        }
        let [id1, id2, force, x, y, z] = texts;
        let ids = [id("id1", id1)?, id("id2", id2)?];
        if !self.with_vector {
            return Ok(Measured::new(ids, number("force", force)?));
        }
        let force = self
            .with_force
            .then(|| number("force", force))
            .transpose()?;
        let vector = [number("fx", x)?, number("fy", y)?, number("fz", z)?];
        Ok(match force {
            Some(force) => Measured::new(ids, force).with_vector(vector),
            None => Measured::of_vector(ids, vector),
        })
    }
}

/// The name that this crate writes.
fn place_name(place: Option<usize>) -> &'static str {
    let names = place.and_then(|place| NAMES.get(place));
    names.and_then(|names| names.first()).copied().unwrap_or("")
}

/// Names in a message: quoted, and cut where they get many.
fn shortened(names: &[&str]) -> String {
    const LONGEST: usize = 120;
    let mut list = String::new();
    for name in names {
        let gap = if list.is_empty() { "" } else { ", " };
        // Writing to a String does not fail.
        let _ = write!(list, "{gap}'{}'", name.escape_debug());
        if list.len() > LONGEST {
            let short: String = list.chars().take(LONGEST).collect();
            return short + "…";
        }
    }
    list
}

/// The number of a sphere: all its digits, with a fraction of zeros at most.
///
/// With an exponent, as `numpy.savetxt` writes it, every digit must be there all the same: others may have been rounded
/// off. By default LAMMPS writes sphere 1234567 as 1.23457e+06.
fn id(column: &'static str, text: &str) -> Result<u64, Fault> {
    let expected = "the number of a sphere, such as 17, counted from 1 (LAMMPS writes all digits with dump_modify \
                    format float %.17g)";
    whole(text).ok_or_else(|| Fault::Field {
        column,
        error: Box::new(Error::syntax(text, expected)),
    })
}

fn whole(text: &str) -> Option<u64> {
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let (moved, zeros) = fraction.split_at_checked(exponent.parse().ok()?)?;
    let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let fits = !whole.is_empty() && is_number(whole) && is_number(moved);
    let id = [whole, moved].concat().parse().ok()?;
    (fits && id > 0 && zeros.bytes().all(|byte| byte == b'0')).then_some(id)
}

/// A force, rounded to the nearest `f64`.
fn number(column: &'static str, text: &str) -> Result<f64, Fault> {
    let value = text.parse::<f64>().map_err(|_| Fault::Field {
        column,
        error: Box::new(Error::syntax(text, "a number such as 0.46 or 1e-3")),
    })?;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Fault::NotFinite { column, value })
    }
}
