//! The columns of a table, found by name or by number, and the parser of their cells.

use crate::columns::{Column, Identity, Quantity, Term};
use crate::contact::{Contact, Force, Place, Spheres};
use crate::error::{Fault, shortened};
use crate::format::Format;
use crate::number::{number, whole_number};

/// The columns that are read. All others may hold anything.
pub(crate) struct Header {
    /// The number of cells in a row.
    width: usize,
    has_names: bool,
    /// True if the last name is empty, after a separator at the end of the line.
    is_open: bool,
    /// For each quantity, its columns, counted from 0, with their factors.
    sums: [Vec<(usize, f64)>; Quantity::COUNT],
    kinds: Vec<String>,
    first_id: u64,
    identity: Identity,
    decimal_comma: bool,
}

/// The content of a row.
pub(crate) enum Row<'c> {
    /// A contact.
    Contact(Contact),
    /// A contact of another kind than those that are read.
    OtherKind(&'c str),
    /// A line of text: no necessary cell is a number.
    Text,
}

impl Header {
    /// Finds the necessary columns in a table of this width, whose names may be known.
    pub(crate) fn find(
        names: Option<&[&str]>,
        width: usize,
        format: &Format,
    ) -> Result<Self, Fault> {
        let columns = &format.columns;
        let mut header = Self {
            width,
            has_names: names.is_some(),
            is_open: names.is_some_and(|names| names.last() == Some(&"")),
            sums: [const { Vec::new() }; Quantity::COUNT],
            kinds: columns.kinds().to_vec(),
            first_id: columns.first_id(),
            identity: format.identity,
            decimal_comma: false,
        };
        let names = names.unwrap_or(&[]);
        let is_mapped = |quantity: &Quantity| columns.terms(*quantity).is_some();
        let is_there = |quantity: &Quantity| {
            let named = || names.iter().any(|name| quantity.is_named(name));
            is_mapped(quantity) || named()
        };
        for quantity in needed(format, is_there, is_mapped) {
            let sum = match columns.terms(quantity) {
                Some(terms) => named(quantity, terms, names, width)?,
                None => usual(quantity, names)?,
            };
            header.sums[quantity as usize] = sum;
        }
        header.drop_added_tangential();
        match header.missing() {
            None => Ok(header),
            Some(quantity) => {
                let wanted = match quantity {
                    Quantity::Id => "id, fx, fy and fz",
                    _ => "id1, id2, force, and fx, fy, fz if there are vectors",
                };
                Err(Fault::no_column(format!(
                    "no column {}, only {}: name the columns {wanted} (in LAMMPS with dump_modify colname)",
                    quantity.name(),
                    shortened(names)
                )))
            }
        }
    }

    pub(crate) fn set_decimal_comma(&mut self, decimal_comma: bool) {
        self.decimal_comma = decimal_comma;
    }

    /// Returns this header for rows of this width. Either the header or the rows may end with a separator.
    pub(crate) fn matched_to(mut self, width: usize, rows_are_open: bool) -> Result<Self, Fault> {
        let is_longer = self.is_open && self.width == width + 1;
        let is_shorter = rows_are_open && self.width + 1 == width;
        if self.width != width && !is_longer && !is_shorter {
            return Err(self.row_of(width));
        }
        self.width = width;
        Ok(self)
    }

    pub(crate) fn width(&self) -> usize {
        self.width
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
        let identity = self.identity.necessary(self.has_centres());
        // With a vector, the magnitude is not necessary.
        let has_vector = self.has_any(Quantity::VECTOR);
        let force = if has_vector {
            &Quantity::VECTOR[..]
        } else {
            &[Quantity::Force]
        };
        let has_tangential = self.has_any(Quantity::TANGENTIAL);
        let tangential = Quantity::TANGENTIAL.iter().filter(|_| has_tangential);
        let needed = identity.iter().chain(force).chain(tangential);
        needed.copied().find(|quantity| !self.has_any([*quantity]))
    }

    fn sum_of(&self, quantity: Quantity) -> &[(usize, f64)] {
        &self.sums[quantity as usize]
    }

    fn has_any<const N: usize>(&self, quantities: [Quantity; N]) -> bool {
        let mut quantities = quantities.into_iter();
        quantities.any(|quantity| !self.sum_of(quantity).is_empty())
    }

    fn has_centres(&self) -> bool {
        self.has_any(Quantity::FIRST) || self.has_any(Quantity::SECOND)
    }

    /// Returns the columns that are read, counted from 0. Some may occur twice.
    pub(crate) fn columns(&self) -> impl Iterator<Item = usize> {
        self.sums.iter().flatten().map(|(column, _)| *column)
    }

    /// Reads the cells of a line.
    pub(crate) fn read<'c>(&self, cells: &[&'c str], line: u64) -> Result<Row<'c>, Fault> {
        if cells.len() != self.width {
            return self.text_or(cells, self.row_of(cells.len()));
        }
        if self.has_any([Quantity::Kind]) {
            let kind = self.cell(Quantity::Kind, cells)?;
            if !self.kinds.iter().any(|known| known == kind) {
                return Ok(Row::OtherKind(kind));
            }
        }
        match self.contact(cells, line) {
            Ok(contact) => Ok(Row::Contact(contact)),
            Err(fault) => self.text_or(cells, fault),
        }
    }

    /// Returns whether there is a column of steps.
    pub(crate) fn has_steps(&self) -> bool {
        self.has_any([Quantity::Step])
    }

    /// Returns the step of a row.
    pub(crate) fn step<'c>(&self, cells: &[&'c str]) -> Option<&'c str> {
        match self.sum_of(Quantity::Step) {
            [(column, _)] => cells.get(*column).copied(),
            _ => None,
        }
    }

    /// Returns whether the last column is a step or a kind, whose words a comment would join.
    pub(crate) fn ends_with_word(&self) -> bool {
        let words = [Quantity::Step, Quantity::Kind].map(|word| self.sum_of(word));
        let mut columns = words.into_iter().flatten();
        columns.any(|(column, _)| column + 1 == self.width)
    }

    /// Returns the fault of a row with another number of cells.
    pub(crate) fn row_of(&self, cells: usize) -> Fault {
        let columns = self.width;
        let (of, remedy) = if !self.has_names {
            ("most rows have", "give every column a value")
        } else if cells == columns + 1 {
            let remedy = "does the header lack the name of the first column, as for the row names of R, or does a cell \
                          contain the separator?";
            ("the header has", remedy)
        } else {
            ("the header has", "give every column a value")
        };
        Fault::new(format!("{cells} cells, but {of} {columns}: {remedy}"))
    }

    fn text_or<'c>(&self, cells: &[&'c str], fault: Fault) -> Result<Row<'c>, Fault> {
        if self.is_text(cells) {
            Ok(Row::Text)
        } else {
            Err(fault)
        }
    }

    /// Returns whether no necessary cell is a number.
    pub(crate) fn is_text(&self, cells: &[&str]) -> bool {
        let mut numbers = self.numbers(cells);
        !numbers.any(|cell| number(cell, self.decimal_comma).is_some())
    }

    /// Returns the cells that are numbers in a row.
    pub(crate) fn numbers<'c>(&self, cells: &[&'c str]) -> impl Iterator<Item = &'c str> {
        let words = [Quantity::Kind, Quantity::Step];
        let numbers = Quantity::all().filter(move |quantity| !words.contains(quantity));
        let columns = numbers.flat_map(|quantity| self.sum_of(quantity));
        columns.filter_map(|(column, _)| cells.get(*column).copied())
    }

    /// Returns a number of a row without a header that may be cut at its decimal comma. In such a row no number that is
    /// read has decimals, and a column of digits that is not read follows one of them.
    pub(crate) fn cut_number(&self, cells: &[&str]) -> Option<String> {
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

    fn contact(&self, cells: &[&str], line: u64) -> Result<Contact, Fault> {
        let number = |quantity| self.number(quantity, cells);
        let vector = |[x, y, z]: [Quantity; 3]| Ok([number(x)?, number(y)?, number(z)?]);
        let spheres = match self.identity {
            Identity::Numbers => Spheres::Numbers([
                self.id(Quantity::Id1, cells)?,
                self.id(Quantity::Id2, cells)?,
            ]),
            // No sphere has the number 0.
            Identity::OneNumber => Spheres::Numbers([self.id(Quantity::Id, cells)?, 0]),
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
        Ok(Contact {
            spheres,
            force,
            tangential: tangential.transpose()?,
            line,
        })
    }

    /// Returns the cell of a quantity that is one column.
    fn cell<'c>(&self, quantity: Quantity, cells: &[&'c str]) -> Result<&'c str, Fault> {
        match self.sum_of(quantity) {
            [(column, _)] => self.at(cells, *column),
            _ => Err(Fault::bug("a header has one column for each sphere")),
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
            let value = number(text, self.decimal_comma).ok_or_else(|| {
                Fault::of_cell(quantity.name(), text, "a number such as 0.46 or 1e-3")
            })?;
            finite(quantity, value)
        };
        match self.sum_of(quantity) {
            [(column, 1.0)] => value(*column),
            terms => {
                let mut sum = 0.0;
                for (column, factor) in terms {
                    sum += factor * value(*column)?;
                }
                finite(quantity, sum)
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
        counted.ok_or_else(|| Fault::of_cell(quantity.name(), text, expected))
    }
}

/// Refuses a value that is infinite or not a number.
fn finite(quantity: Quantity, value: f64) -> Result<f64, Fault> {
    if value.is_finite() {
        return Ok(value);
    }
    let name = quantity.name();
    let reason = format!("{name} is {value}: forces and positions must be finite");
    Err(Fault::new(reason))
}

/// Returns the quantities that are read if they are there. Incomplete centres and vectors are not read if there is a
/// contact point or a force instead, unless the user mapped them.
fn needed(
    format: &Format,
    is_there: impl Fn(&Quantity) -> bool,
    is_mapped: impl Fn(&Quantity) -> bool,
) -> Vec<Quantity> {
    use Quantity::{Force, Kind, Step};
    let are_there = |quantities: &[Quantity]| quantities.iter().all(&is_there);
    let is_any_mapped = |quantities: &[Quantity]| quantities.iter().any(&is_mapped);
    let [point, centres] = [false, true].map(|of_centres| format.identity.necessary(of_centres));
    let all_centres = [Quantity::FIRST, Quantity::SECOND].concat();
    let has_point = are_there(point) && !are_there(centres);
    let has_centres = all_centres.iter().any(&is_there);
    let identity = match format.identity {
        Identity::Numbers | Identity::OneNumber => point,
        Identity::Places if has_centres && (!has_point || is_any_mapped(&all_centres)) => {
            &all_centres
        }
        Identity::Places => &Quantity::POINT,
    };
    let vector = &Quantity::VECTOR[..];
    let is_incomplete = is_there(&Force) && !are_there(vector) && !is_any_mapped(vector);
    let vector = if is_incomplete { &[] } else { vector };
    let has_tangential = format.tangential && Quantity::TANGENTIAL.iter().any(&is_there);
    let tangential = if has_tangential {
        &Quantity::TANGENTIAL[..]
    } else {
        &[]
    };
    [identity, &[Force], vector, tangential, &[Kind, Step]].concat()
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
    let terms = if quantity.is_one_column() {
        terms.to_vec()
    } else {
        differences(terms, names)
    };
    for term in &terms {
        let place = match &term.column {
            Column::Numbered(place) if *place < width => *place,
            Column::Numbered(place) => {
                let header = if names.is_empty() {
                    ", and there is no header"
                } else {
                    ""
                };
                return Err(Fault::new(format!(
                    "no column #{} for {}: the rows have {width} columns{header}; does the table have another form?",
                    place + 1,
                    quantity.name()
                )));
            }
            Column::Named(wanted) => {
                let mut places = (0..).zip(names).filter(|(_, name)| **name == wanted);
                match (places.next(), places.next()) {
                    (Some((place, _)), None) => place,
                    (Some((_, first)), Some((_, second))) => {
                        return Err(twice(quantity, first, second));
                    }
                    (None, _) => {
                        return Err(Fault::no_column(format!(
                            "no column {} for {}, only {}: name one of these",
                            shortened(&[wanted]),
                            quantity.name(),
                            shortened(names)
                        )));
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
    let name = quantity.name();
    Fault::new(format!(
        "two columns, {} and {}, for {name}: choose one by its number, {name}=#N",
        shortened(&[first]),
        shortened(&[second])
    ))
}

const ID: &str = "the number of a sphere, such as 17, with all its digits (in LAMMPS by dump_modify format float %.17g)";

/// The value expected in place of a word. A row of totals may begin with the word.
const NO_ID: &str =
    "the number of a sphere, such as 17: if this row is a footer, leave it out or put # before it";
