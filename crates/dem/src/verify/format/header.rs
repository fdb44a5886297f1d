//! The columns of a table, found by name or by number, and the parser of their cells.

use core::fmt::Write;

use super::columns::{Column, Columns, Quantity, Term};
use super::number::{number, whole_number};
use crate::Error;
use crate::verify::entry::{Entry, Force, Place, Spheres};
use crate::verify::refusal::Fault;

/// The identification of the two spheres that a table must contain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::verify) enum Identity {
    #[default]
    Numbers,
    Places,
    /// One sphere, which touches the floor.
    OnFloor,
}

/// The columns of a table that are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::verify) struct Needs {
    pub(in crate::verify) identity: Identity,
    /// True if tangential forces are read.
    pub(in crate::verify) tangential: bool,
}

/// The columns that are read. All others may hold anything.
pub(in crate::verify) struct Header {
    /// The number of cells in a row.
    width: usize,
    has_names: bool,
    /// True if the last name is empty, after a separator at the end of the line.
    is_open: bool,
    /// For each quantity, its columns, counted from 0, with their factors.
    sums: [Vec<(usize, f64)>; Quantity::COUNT],
    kinds: Vec<String>,
    first_id: u64,
    needs: Needs,
    decimal_comma: bool,
}

/// The content of a row.
pub(in crate::verify) enum Row<'c> {
    /// A contact.
    Entry(Entry),
    /// A contact of another kind than those that are read.
    OtherKind(&'c str),
    /// A line of text: no necessary cell is a number.
    Text,
}

impl Header {
    /// Finds the necessary columns in a table of this width, whose names may be known.
    pub(in crate::verify) fn find(
        names: Option<&[&str]>,
        width: usize,
        columns: &Columns,
        needs: Needs,
    ) -> Result<Self, Fault> {
        let mut header = Self {
            width,
            has_names: names.is_some(),
            is_open: names.is_some_and(|names| names.last() == Some(&"")),
            sums: [const { Vec::new() }; Quantity::COUNT],
            kinds: columns.kinds().to_vec(),
            first_id: columns.first_id(),
            needs,
            decimal_comma: false,
        };
        let names = names.unwrap_or(&[]);
        let is_mapped = |quantity: &Quantity| columns.terms(*quantity).is_some();
        let is_there = |quantity: &Quantity| {
            let named = || names.iter().any(|name| quantity.is_named(name));
            is_mapped(quantity) || named()
        };
        for quantity in header.needed(is_there, is_mapped) {
            let sum = match columns.terms(quantity) {
                Some(terms) => named(quantity, terms, names, width)?,
                None => usual(quantity, names)?,
            };
            if let Some(place) = header.sums.get_mut(quantity as usize) {
                *place = sum;
            }
        }
        header.drop_added_tangential();
        match header.missing() {
            None => Ok(header),
            Some(quantity) => Err(Fault::NoColumn {
                column: quantity.name(),
                found: shortened(names),
            }),
        }
    }

    pub(super) fn set_decimal_comma(&mut self, decimal_comma: bool) {
        self.decimal_comma = decimal_comma;
    }

    /// Returns this header for rows of this width. Either the header or the rows may end with a separator.
    pub(super) fn matched_to(mut self, width: usize, rows_are_open: bool) -> Result<Self, Fault> {
        let is_longer = self.is_open && self.width == width + 1;
        let is_shorter = rows_are_open && self.width + 1 == width;
        if self.width != width && !is_longer && !is_shorter {
            return Err(self.row_of(width));
        }
        self.width = width;
        Ok(self)
    }

    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Returns the quantities that are read if they are there. Incomplete centres and vectors are not read if there is a
    /// contact point or a force instead, unless the user mapped them.
    fn needed(
        &self,
        is_there: impl Fn(&Quantity) -> bool,
        is_mapped: impl Fn(&Quantity) -> bool,
    ) -> Vec<Quantity> {
        use Quantity::{Force, Id, Kind, Step, X, X1, X2, Z, Z1, Z2};
        let are_there = |quantities: &[Quantity]| quantities.iter().all(&is_there);
        let is_any_mapped = |quantities: &[Quantity]| quantities.iter().any(&is_mapped);
        let centres = [Quantity::FIRST, Quantity::SECOND].concat();
        let has_point = are_there(&[X, Z]) && !are_there(&[X1, Z1, X2, Z2]);
        let has_centres = centres.iter().any(&is_there);
        let identity = match self.needs.identity {
            Identity::Numbers => Quantity::NUMBERS,
            Identity::OnFloor => &[Id],
            Identity::Places if has_centres && (!has_point || is_any_mapped(&centres)) => &centres,
            Identity::Places => &Quantity::POINT,
        };
        let vector = &Quantity::VECTOR[..];
        let is_incomplete = is_there(&Force) && !are_there(vector) && !is_any_mapped(vector);
        let vector = if is_incomplete { &[] } else { vector };
        let has_tangential = self.needs.tangential && Quantity::TANGENTIAL.iter().any(&is_there);
        let tangential = if has_tangential {
            &Quantity::TANGENTIAL[..]
        } else {
            &[]
        };
        [identity, &[Force], vector, tangential, &[Kind, Step]].concat()
    }

    /// Drops the tangential force if the vector already contains it: the sums of both have a column with one sign.
    fn drop_added_tangential(&mut self) {
        let is_added =
            Quantity::VECTOR
                .into_iter()
                .zip(Quantity::TANGENTIAL)
                .any(|(whole, part)| {
                    let mut parts = self.sum_of(part).iter();
                    parts.any(|(column, factor)| {
                        let mut terms = self.sum_of(whole).iter();
                        terms.any(|(other, of_whole)| other == column && factor * of_whole > 0.0)
                    })
                });
        if is_added {
            for part in Quantity::TANGENTIAL {
                self.sums[part as usize].clear();
            }
        }
    }

    /// Returns the first necessary quantity without a column.
    fn missing(&self) -> Option<Quantity> {
        use Quantity::{Force, Id, X, X1, X2, Z, Z1, Z2};
        let identity: &[Quantity] = match self.needs.identity {
            Identity::Numbers => Quantity::NUMBERS,
            Identity::OnFloor => &[Id],
            Identity::Places if self.has_centres() => &[X1, Z1, X2, Z2],
            Identity::Places => &[X, Z],
        };
        // With a vector, the magnitude is not necessary.
        let has_vector = self.has_any(Quantity::VECTOR);
        let force = if has_vector {
            &Quantity::VECTOR[..]
        } else {
            &[Force]
        };
        let has_tangential = self.has_any(Quantity::TANGENTIAL);
        let tangential = Quantity::TANGENTIAL.iter().filter(|_| has_tangential);
        let needed = identity.iter().chain(force).chain(tangential);
        needed.copied().find(|quantity| !self.has_any([*quantity]))
    }

    fn sum_of(&self, quantity: Quantity) -> &[(usize, f64)] {
        self.sums.get(quantity as usize).map_or(&[], Vec::as_slice)
    }

    fn has_any<const N: usize>(&self, quantities: [Quantity; N]) -> bool {
        let mut quantities = quantities.into_iter();
        quantities.any(|quantity| !self.sum_of(quantity).is_empty())
    }

    fn has_centres(&self) -> bool {
        self.has_any(Quantity::FIRST) || self.has_any(Quantity::SECOND)
    }

    /// Returns the columns that are read, counted from 0. Some may occur twice.
    pub(in crate::verify) fn columns(&self) -> impl Iterator<Item = usize> {
        self.sums.iter().flatten().map(|(column, _)| *column)
    }

    /// Reads the cells of a line.
    pub(in crate::verify) fn read<'c>(&self, cells: &[&'c str]) -> Result<Row<'c>, Fault> {
        if cells.len() != self.width {
            return self.text_or(cells, self.row_of(cells.len()));
        }
        if self.has_any([Quantity::Kind]) {
            let kind = self.cell(Quantity::Kind, cells)?;
            if !self.kinds.iter().any(|known| known == kind) {
                return Ok(Row::OtherKind(kind));
            }
        }
        match self.entry(cells) {
            Ok(entry) => Ok(Row::Entry(entry)),
            Err(fault) => self.text_or(cells, fault),
        }
    }

    /// Returns the step of a row.
    pub(super) fn step<'c>(&self, cells: &[&'c str]) -> Option<&'c str> {
        match self.sum_of(Quantity::Step) {
            [(column, _)] => cells.get(*column).copied(),
            _ => None,
        }
    }

    /// Returns the fault of a row with another number of cells.
    pub(super) fn row_of(&self, cells: usize) -> Fault {
        Fault::Fields {
            columns: self.width,
            fields: cells,
            has_names: self.has_names,
        }
    }

    fn text_or<'c>(&self, cells: &[&'c str], fault: Fault) -> Result<Row<'c>, Fault> {
        if self.is_text(cells) {
            Ok(Row::Text)
        } else {
            Err(fault)
        }
    }

    /// Returns whether no necessary cell is a number.
    pub(super) fn is_text(&self, cells: &[&str]) -> bool {
        let mut numbers = self.numbers(cells);
        !numbers.any(|cell| number(cell, self.decimal_comma).is_some())
    }

    /// Returns the cells that are numbers in a row.
    pub(super) fn numbers<'c>(&self, cells: &[&'c str]) -> impl Iterator<Item = &'c str> {
        let words = [Quantity::Kind, Quantity::Step];
        let numbers = Quantity::all().filter(move |quantity| !words.contains(quantity));
        let columns = numbers.flat_map(|quantity| self.sum_of(quantity));
        columns.filter_map(|(column, _)| cells.get(*column).copied())
    }

    /// Returns a number of a row without a header that may be cut at its decimal comma. In such a row no number that is
    /// read has decimals, and a column of digits that is not read follows one of them.
    pub(super) fn cut_number(&self, cells: &[&str]) -> Option<String> {
        let is_whole = |cell: &str| cell.trim_start_matches('-').parse::<u64>().is_ok();
        if self.has_names || !self.numbers(cells).all(is_whole) {
            return None;
        }
        let is_read = |place| self.columns().any(|column| column == place);
        let mut pairs = (1..).zip(cells.windows(2));
        pairs.find_map(|(place, pair)| {
            let is_cut = is_read(place - 1) && !is_read(place);
            let [whole, digits] = pair else { return None };
            let is_rest = digits.starts_with(|c: char| c.is_ascii_digit())
                && !digits.contains('.')
                && number(digits, false).is_some();
            (is_cut && is_rest).then(|| format!("{whole},{digits}"))
        })
    }

    fn entry(&self, cells: &[&str]) -> Result<Entry, Fault> {
        let number = |quantity| self.number(quantity, cells);
        let vector = |[x, y, z]: [Quantity; 3]| Ok([number(x)?, number(y)?, number(z)?]);
        let spheres = match self.needs.identity {
            Identity::Numbers => Spheres::Numbers([
                self.id(Quantity::Id1, cells)?,
                self.id(Quantity::Id2, cells)?,
            ]),
            // No sphere has the number 0.
            Identity::OnFloor => Spheres::Numbers([self.id(Quantity::Id, cells)?, 0]),
            Identity::Places if self.has_centres() => Spheres::Places(Place::Centres([
                vector(Quantity::FIRST)?,
                vector(Quantity::SECOND)?,
            ])),
            Identity::Places => Spheres::Places(Place::Point(vector(Quantity::POINT)?)),
        };
        let components = Quantity::VECTOR;
        let force = match (self.has_any([Quantity::Force]), self.has_any(components)) {
            (true, true) => Force::Both(number(Quantity::Force)?, vector(components)?),
            (false, true) => Force::Vector(vector(components)?),
            // A header without a force and without a vector was rejected before.
            (_, false) => Force::Along(number(Quantity::Force)?),
        };
        let tangential = Quantity::TANGENTIAL;
        let tangential = self.has_any(tangential).then(|| vector(tangential));
        Ok(Entry {
            spheres,
            force,
            tangential: tangential.transpose()?,
        })
    }

    /// Returns the cell of a quantity that is one column.
    fn cell<'c>(&self, quantity: Quantity, cells: &[&'c str]) -> Result<&'c str, Fault> {
        match self.sum_of(quantity) {
            [(column, _)] => self.at(cells, *column),
            _ => Err(Fault::of_bug("a header has one column for each sphere")),
        }
    }

    fn at<'c>(&self, cells: &[&'c str], column: usize) -> Result<&'c str, Fault> {
        cells
            .get(column)
            .copied()
            .ok_or_else(|| self.row_of(cells.len()))
    }

    /// Returns a sum of columns. Without a column it is 0, because discs have no y.
    fn number(&self, quantity: Quantity, cells: &[&str]) -> Result<f64, Fault> {
        let value = |column: usize| {
            let text = self.at(cells, column)?;
            let value = number(text, self.decimal_comma).ok_or_else(|| Fault::Field {
                column: quantity.name(),
                error: Box::new(Error::syntax(text, "a number such as 0.46 or 1e-3")),
            })?;
            if value.is_finite() {
                Ok(value)
            } else {
                let column = quantity.name();
                Err(Fault::NotFinite { column, value })
            }
        };
        match self.sum_of(quantity) {
            [(column, 1.0)] => value(*column),
            terms => {
                let mut sum = 0.0;
                for (column, factor) in terms {
                    sum += factor * value(*column)?;
                }
                Ok(sum)
            }
        }
    }

    /// Returns the number of a sphere, counted from 1 if it is a sphere of the pile.
    fn id(&self, quantity: Quantity, cells: &[&str]) -> Result<i64, Fault> {
        let text = self.cell(quantity, cells)?;
        let first = i64::try_from(self.first_id).ok();
        let counted = whole_number(text).zip(first);
        let counted = counted.and_then(|(id, first)| id.checked_sub(first)?.checked_add(1));
        let is_word = text.starts_with(char::is_alphabetic);
        let expected = if is_word { NO_ID } else { ID };
        counted.ok_or_else(|| Fault::Field {
            column: quantity.name(),
            error: Box::new(Error::syntax(text, expected)),
        })
    }
}

/// Finds the columns that the user named.
fn named(
    quantity: Quantity,
    terms: &[Term],
    names: &[&str],
    width: usize,
) -> Result<Vec<(usize, f64)>, Fault> {
    if let Some(sum) = whole(terms, names) {
        return Ok(sum);
    }
    let mut sum = Vec::new();
    for term in &differences(terms, names) {
        let place = match &term.column {
            Column::Numbered(place) if *place < width => *place,
            Column::Numbered(place) => {
                return Err(Fault::NoNumberedColumn {
                    column: quantity.name(),
                    number: place + 1,
                    columns: width,
                    has_names: !names.is_empty(),
                });
            }
            Column::Named(wanted) => {
                let mut places = (0..).zip(names).filter(|(_, name)| **name == wanted);
                match (places.next(), places.next()) {
                    (Some((place, _)), None) => place,
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
        };
        sum.push((place, term.factor));
    }
    Ok(sum)
}

/// Splits each name that is not a column at its signs −, if the parts are columns.
fn differences(terms: &[Term], names: &[&str]) -> Vec<Term> {
    let mut split = Vec::new();
    for term in terms {
        match &term.column {
            Column::Named(name) if !names.contains(&name.as_str()) => {
                let parts: Vec<&str> = name.split('-').map(str::trim).collect();
                let are_columns = parts.iter().all(|part| names.contains(part));
                let parts = if are_columns {
                    parts
                } else {
                    vec![name.as_str()]
                };
                split.extend((0..).zip(parts).map(|(n, part)| Term {
                    factor: if n == 0 { term.factor } else { -1.0 },
                    column: Column::Named(part.to_owned()),
                }));
            }
            _ => split.push(term.clone()),
        }
    }
    split
}

/// Finds the column whose name contains a +, so that it was parsed as a sum, unless the parts are columns too.
fn whole(terms: &[Term], names: &[&str]) -> Option<Vec<(usize, f64)>> {
    let mut parts = Vec::new();
    for (n, term) in terms.iter().enumerate() {
        match &term.column {
            Column::Named(name) if n == 0 || matches!(term.factor, 1.0) => {
                parts.push(name.as_str());
            }
            _ => return None,
        }
    }
    let bare = |name: &str| name.replace(char::is_whitespace, "");
    let name = bare(&parts.join("+"));
    let is_sum = parts.len() < 2 || parts.iter().all(|part| names.contains(part));
    let place = names.iter().position(|known| bare(known) == name)?;
    (!is_sum).then(|| vec![(place, terms.first().map_or(1.0, |term| term.factor))])
}

/// Finds the column with one of the usual names of a quantity. Names in other capital or small letters count if no column
/// has the name itself.
fn usual(quantity: Quantity, names: &[&str]) -> Result<Vec<(usize, f64)>, Fault> {
    let places = |is_name: &dyn Fn(&str) -> bool| {
        let places = (0..).zip(names).filter(|(_, name)| is_name(name));
        places.collect::<Vec<_>>()
    };
    let mut found = places(&|name| quantity.names().contains(&name));
    if found.is_empty() {
        found = places(&|name| quantity.is_named(name));
    }
    match found[..] {
        [(_, first), (_, second), ..] => Err(twice(quantity, first, second)),
        _ => Ok(found.iter().map(|(place, _)| (*place, 1.0)).collect()),
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
pub(in crate::verify) fn shortened(names: &[&str]) -> String {
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

const ID: &str = "the number of a sphere, such as 17, with all its digits (in LAMMPS by dump_modify format float %.17g)";

/// What is expected in place of a word, which may begin a row of totals.
const NO_ID: &str =
    "the number of a sphere, such as 17: if this row is a footer, leave it out or put # before it";
