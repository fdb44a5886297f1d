//! The columns of a table, found by their names, and the parser of their fields.

use core::fmt::Write;

use super::columns::{Column, Columns, Quantity, Term};
use super::entry::{Entry, Force, Place, Spheres};
use super::refusal::Fault;
use crate::Error;

/// The identification of the two spheres that a table must contain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Identity {
    #[default]
    Numbers,
    Places,
}

/// The positions of the columns that are read.
pub(super) struct Header {
    /// The number of columns, if the table has a header.
    width: Option<usize>,
    /// For each quantity, its columns, counted from 0, with their factors.
    sums: [Vec<(usize, f64)>; Quantity::COUNT],
    kinds: Vec<String>,
    first_id: u64,
    identity: Identity,
}

impl Header {
    /// Finds the columns in a header. Unknown columns are ignored.
    pub(super) fn find<'n>(
        names: impl IntoIterator<Item = &'n str>,
        columns: &Columns,
        identity: Identity,
    ) -> Result<Self, Fault> {
        let names: Vec<&str> = names.into_iter().collect();
        let mut sums = Quantity::ALL.map(|_| Vec::new());
        for quantity in Quantity::ALL {
            let sum = match columns.terms(quantity) {
                Some(terms) => named(quantity, terms, &names)?,
                None => usual(quantity, &names)?,
            };
            if let Some(place) = sums.get_mut(quantity as usize) {
                *place = sum;
            }
        }
        let width = Some(names.len());
        Self::of(sums, width, columns, identity, &names)
    }

    /// Returns the columns of a table without header.
    pub(super) fn numbered(columns: &Columns, identity: Identity) -> Result<Self, Fault> {
        let sums = Quantity::ALL.map(|quantity| {
            let terms = columns.terms(quantity).into_iter().flatten();
            let numbered = terms.filter_map(|term| match term.column {
                Column::Numbered(place) => Some((place, term.factor)),
                Column::Named(_) => None,
            });
            numbered.collect()
        });
        Self::of(sums, None, columns, identity, &[])
    }

    fn of(
        sums: [Vec<(usize, f64)>; Quantity::COUNT],
        width: Option<usize>,
        columns: &Columns,
        identity: Identity,
        names: &[&str],
    ) -> Result<Self, Fault> {
        let header = Self {
            width,
            sums,
            kinds: columns.kinds().to_vec(),
            first_id: columns.first_id(),
            identity,
        };
        match header.missing() {
            None => Ok(header),
            Some(quantity) => Err(Fault::NoColumn {
                column: quantity.name(),
                found: shortened(names),
            }),
        }
    }

    /// Returns the first necessary quantity without a column.
    fn missing(&self) -> Option<Quantity> {
        use Quantity::{Force, Fx, Fy, Fz, Id1, Id2, X, X1, X2, Y1, Y2, Z, Z1, Z2};
        let lacks = |quantity: &Quantity| !self.has(*quantity);
        let identity: &[Quantity] = match self.identity {
            Identity::Numbers => &[Id1, Id2],
            Identity::Places if [X1, Y1, Z1, X2, Y2, Z2].iter().any(|q| self.has(*q)) => {
                &[X1, Z1, X2, Z2]
            }
            Identity::Places => &[X, Z],
        };
        // With a vector, the magnitude is not necessary.
        let force: &[Quantity] = if self.has_vector() {
            &[Fx, Fy, Fz]
        } else {
            &[Force]
        };
        identity.iter().chain(force).copied().find(lacks)
    }

    fn sum_of(&self, quantity: Quantity) -> &[(usize, f64)] {
        self.sums.get(quantity as usize).map_or(&[], Vec::as_slice)
    }

    fn has(&self, quantity: Quantity) -> bool {
        !self.sum_of(quantity).is_empty()
    }

    fn has_vector(&self) -> bool {
        [Quantity::Fx, Quantity::Fy, Quantity::Fz]
            .into_iter()
            .any(|component| self.has(component))
    }

    /// Reads a row from the fields of a line. Returns `None` for a contact with a wall.
    pub(super) fn read(&self, fields: &[&str]) -> Result<Option<Entry>, Fault> {
        if let Some(columns) = self.width.filter(|columns| *columns != fields.len()) {
            return Err(Fault::Fields {
                columns,
                fields: fields.len(),
            });
        }
        if self.has(Quantity::Kind) {
            let kind = self.field(Quantity::Kind, fields)?;
            if !self.kinds.iter().any(|known| known == kind) {
                return Ok(None);
            }
        }
        let number = |quantity| self.number(quantity, fields);
        let vector = |[x, y, z]: [Quantity; 3]| Ok([number(x)?, number(y)?, number(z)?]);
        let spheres = match self.identity {
            Identity::Numbers => Spheres::Numbers([
                self.id(Quantity::Id1, fields)?,
                self.id(Quantity::Id2, fields)?,
            ]),
            Identity::Places if self.has(Quantity::X1) => Spheres::Places(Place::Centres([
                vector([Quantity::X1, Quantity::Y1, Quantity::Z1])?,
                vector([Quantity::X2, Quantity::Y2, Quantity::Z2])?,
            ])),
            Identity::Places => {
                let point = vector([Quantity::X, Quantity::Y, Quantity::Z])?;
                Spheres::Places(Place::Point(point))
            }
        };
        let components = [Quantity::Fx, Quantity::Fy, Quantity::Fz];
        let force = match (self.has(Quantity::Force), self.has_vector()) {
            (true, true) => Force::Both(number(Quantity::Force)?, vector(components)?),
            (false, true) => Force::Vector(vector(components)?),
            // A header without a force and without a vector was rejected before.
            (_, false) => Force::Along(number(Quantity::Force)?),
        };
        Ok(Some(Entry { spheres, force }))
    }

    /// Returns the field of a quantity that is one column.
    fn field<'f>(&self, quantity: Quantity, fields: &[&'f str]) -> Result<&'f str, Fault> {
        match self.sum_of(quantity) {
            [(column, _)] => at(fields, *column),
            _ => Err(Fault::of_bug("a header has one column for each sphere")),
        }
    }

    /// Returns a sum of columns. Without a column it is 0, because discs have no y.
    fn number(&self, quantity: Quantity, fields: &[&str]) -> Result<f64, Fault> {
        match self.sum_of(quantity) {
            [(column, 1.0)] => number(quantity, at(fields, *column)?),
            terms => {
                let mut sum = 0.0;
                for (column, factor) in terms {
                    sum += factor * number(quantity, at(fields, *column)?)?;
                }
                Ok(sum)
            }
        }
    }

    /// Returns the number of a sphere, counted from 1.
    fn id(&self, quantity: Quantity, fields: &[&str]) -> Result<u64, Fault> {
        let text = self.field(quantity, fields)?;
        let counted = whole(text).and_then(|id| id.checked_sub(self.first_id)?.checked_add(1));
        counted.ok_or_else(|| Fault::Field {
            column: quantity.name(),
            error: Box::new(Error::syntax(text, ID)),
        })
    }
}

/// Returns the n-th field, counted from 0.
fn at<'f>(fields: &[&'f str], n: usize) -> Result<&'f str, Fault> {
    fields.get(n).copied().ok_or(Fault::Fields {
        columns: n + 1,
        fields: fields.len(),
    })
}

/// Finds the columns that the user named.
fn named(quantity: Quantity, terms: &[Term], names: &[&str]) -> Result<Vec<(usize, f64)>, Fault> {
    let mut sum = Vec::new();
    for term in terms {
        let Column::Named(wanted) = &term.column else {
            continue;
        };
        let mut places = (0..).zip(names).filter(|(_, name)| **name == wanted);
        match (places.next(), places.next()) {
            (Some((place, _)), None) => sum.push((place, term.factor)),
            (Some((_, first)), Some((_, second))) => {
                return Err(twice(quantity, first, second));
            }
            (None, _) => {
                return Err(Fault::NoNamedColumn {
                    column: quantity.name(),
                    name: shortened(&[wanted]),
                    found: shortened(names),
                });
            }
        }
    }
    Ok(sum)
}

/// Finds the column with one of the usual names of a quantity.
fn usual(quantity: Quantity, names: &[&str]) -> Result<Vec<(usize, f64)>, Fault> {
    let known = quantity.names();
    let mut places = (0..).zip(names).filter(|(_, name)| known.contains(name));
    match (places.next(), places.next()) {
        (Some((_, first)), Some((_, second))) => Err(twice(quantity, first, second)),
        (first, _) => Ok(first.map(|(place, _)| (place, 1.0)).into_iter().collect()),
    }
}

fn twice(quantity: Quantity, first: &str, second: &str) -> Fault {
    Fault::TwoColumns {
        column: quantity.name(),
        first: shortened(&[first]),
        second: shortened(&[second]),
    }
}

/// Returns quoted names for a message, shortened if the list is long.
fn shortened(names: &[&str]) -> String {
    const LONGEST: usize = 120;
    let mut list = String::new();
    for name in names {
        let gap = if list.is_empty() { "" } else { ", " };
        // Writing to a String never fails.
        let _ = write!(list, "{gap}'{}'", name.escape_debug());
        if list.len() > LONGEST {
            let short: String = list.chars().take(LONGEST).collect();
            return short + "…";
        }
    }
    list
}

const ID: &str = "the number of a sphere, such as 17, counted from 1 (LAMMPS writes all digits with dump_modify \
                  format float %.17g)";

/// Parses the number of a sphere from all its digits. A fraction may consist of zeros only.
///
/// An exponent, as `numpy.savetxt` writes it, is accepted only if all digits of the number are present. Otherwise
/// digits may have been rounded off: by default LAMMPS writes sphere 1234567 as 1.23457e+06.
fn whole(text: &str) -> Option<u64> {
    if let Ok(id) = text.parse() {
        return Some(id);
    }
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let (moved, zeros) = fraction.split_at_checked(exponent.parse().ok()?)?;
    let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let fits = !whole.is_empty() && is_number(whole) && is_number(moved);
    let id = [whole, moved].concat().parse().ok()?;
    (fits && zeros.bytes().all(|byte| byte == b'0')).then_some(id)
}

/// Parses a number, correctly rounded to `f64`.
fn number(quantity: Quantity, text: &str) -> Result<f64, Fault> {
    let column = quantity.name();
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
