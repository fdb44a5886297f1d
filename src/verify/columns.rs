//! Columns found by their names, and the fields in them read.

use core::fmt::Write;
use std::borrow::Cow;

use super::{Fault, Measured};
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

/// The first that need not be there.
const VECTOR: usize = 3;

/// Where the columns are that are read.
pub(super) struct Columns {
    /// For each column of the file its place in [`NAMES`], if it is read.
    places: Vec<Option<usize>>,
    with_vector: bool,
}

impl Columns {
    /// The columns of a header; what is not known is passed over.
    pub(super) fn new<'n>(names: impl IntoIterator<Item = Cow<'n, str>>) -> Result<Self, Fault> {
        let names: Vec<Cow<'n, str>> = names.into_iter().collect();
        let place = |name: &Cow<'n, str>| NAMES.iter().position(|known| known.contains(&&**name));
        let places: Vec<Option<usize>> = names.iter().map(place).collect();
        let mut found: [Option<&Cow<'n, str>>; 6] = [None; 6];
        for (name, place) in names.iter().zip(&places) {
            let Some(seen) = place.and_then(|place| found.get_mut(place)) else {
                continue;
            };
            if let Some(first) = seen.replace(name) {
                return Err(Fault::TwoColumns {
                    column: place_name(*place),
                    first: shortened([first]),
                    second: shortened([name]),
                });
            }
        }
        let with_vector = found.iter().skip(VECTOR).any(Option::is_some);
        let needed = if with_vector { NAMES.len() } else { VECTOR };
        let missing = found.iter().take(needed).position(Option::is_none);
        if let Some(missing) = missing {
            return Err(Fault::NoColumn {
                column: place_name(Some(missing)),
                found: shortened(&names),
            });
        }
        Ok(Self {
            places,
            with_vector,
        })
    }

    /// The entry in the fields of a line.
    pub(super) fn read<'f>(
        &self,
        fields: impl IntoIterator<Item = Cow<'f, str>>,
    ) -> Result<Measured, Fault> {
        let mut texts: [Cow<'f, str>; 6] = core::array::from_fn(|_| Cow::Borrowed(""));
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
        let [id1, id2, force, x, y, z] = &texts;
        let measured = Measured::new([id("id1", id1)?, id("id2", id2)?], number("force", force)?);
        if !self.with_vector {
            return Ok(measured);
        }
        let vector = [number("fx", x)?, number("fy", y)?, number("fz", z)?];
        Ok(measured.with_vector(vector))
    }
}

/// The name that this crate writes.
fn place_name(place: Option<usize>) -> &'static str {
    let names = place.and_then(|place| NAMES.get(place));
    names
        .and_then(|names| names.first())
        .copied()
        .unwrap_or_default()
}

/// Names in a message: quoted, and cut where they get many.
fn shortened<'n>(names: impl IntoIterator<Item = &'n Cow<'n, str>>) -> String {
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
/// An exponent is refused, since it stands for digits that were rounded off: by default LAMMPS writes sphere 1234567 as
/// 1.23457e+06.
fn id(column: &'static str, text: &str) -> Result<u64, Fault> {
    let expected = "the number of a sphere, such as 17, counted from 1 (LAMMPS writes all digits with dump_modify \
                    format float %.17g)";
    let (whole, zeros) = text.split_once('.').unwrap_or((text, ""));
    let digits = !whole.is_empty() && whole.bytes().all(|byte| byte.is_ascii_digit());
    let whole = whole
        .parse::<u64>()
        .ok()
        .filter(|id| digits && *id > 0 && zeros.bytes().all(|byte| byte == b'0'));
    whole.ok_or_else(|| Fault::Field {
        column,
        error: Box::new(Error::syntax(text, expected)),
    })
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
