//! The mapping from quantities to the columns of a table.

use core::fmt;
use core::str::FromStr;

use super::header::{Identity, Needs};
use crate::Error;

/// A quantity that columns of a table can contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::verify) enum Quantity {
    Id1,
    Id2,
    Force,
    Fx,
    Fy,
    Fz,
    X,
    Y,
    Z,
    X1,
    Y1,
    Z1,
    X2,
    Y2,
    Z2,
    Tx,
    Ty,
    Tz,
    /// The sphere of a row with the force of the floor on it.
    Id,
    Kind,
    Step,
}

impl Quantity {
    pub(super) const COUNT: usize = 21;

    /// Each quantity with the names of its column if the user names none: first that of this crate, then those of LAMMPS.
    const NAMES: [(Self, &[&str]); Self::COUNT] = [
        (Self::Id1, &["id1", "patom1", "natom1"]),
        (Self::Id2, &["id2", "patom2", "natom2"]),
        (Self::Force, &["force"]),
        (Self::Fx, &["fx", "force_vector_x"]),
        (Self::Fy, &["fy", "force_vector_y"]),
        (Self::Fz, &["fz", "force_vector_z"]),
        (Self::X, &["x"]),
        (Self::Y, &["y"]),
        (Self::Z, &["z"]),
        (Self::X1, &["x1"]),
        (Self::Y1, &["y1"]),
        (Self::Z1, &["z1"]),
        (Self::X2, &["x2"]),
        (Self::Y2, &["y2"]),
        (Self::Z2, &["z2"]),
        (Self::Tx, &["tx"]),
        (Self::Ty, &["ty"]),
        (Self::Tz, &["tz"]),
        (Self::Id, &["id"]),
        // Only the user knows which kinds are read.
        (Self::Kind, &[]),
        (Self::Step, &["step", "timestep", "time_step"]),
    ];

    pub(super) const NUMBERS: &[Self] = &[Self::Id1, Self::Id2];
    pub(super) const FIRST: [Self; 3] = [Self::X1, Self::Y1, Self::Z1];
    pub(super) const SECOND: [Self; 3] = [Self::X2, Self::Y2, Self::Z2];
    pub(super) const POINT: [Self; 3] = [Self::X, Self::Y, Self::Z];
    pub(super) const VECTOR: [Self; 3] = [Self::Fx, Self::Fy, Self::Fz];
    pub(super) const TANGENTIAL: [Self; 3] = [Self::Tx, Self::Ty, Self::Tz];

    pub(super) fn all() -> impl Iterator<Item = Self> {
        Self::NAMES.into_iter().map(|(quantity, _)| quantity)
    }

    pub(super) const fn names(self) -> &'static [&'static str] {
        Self::NAMES[self as usize].1
    }

    /// Returns whether a column with this name contains the quantity.
    pub(super) fn is_named(self, name: &str) -> bool {
        let mut names = self.names().iter();
        names.any(|known| known.eq_ignore_ascii_case(name))
    }

    /// Returns whether the quantity is one column, never a sum: the number of a sphere, or a step.
    const fn is_one_column(self) -> bool {
        matches!(self, Self::Id1 | Self::Id2 | Self::Id | Self::Step)
    }

    pub(super) const fn name(self) -> &'static str {
        match self.names() {
            [name, ..] => name,
            [] => "kind",
        }
    }
}

/// The mapping from quantities to columns, by the names in the header or by the positions of the columns.
///
/// It is written as `QUANTITY=COLUMN,…`, with these quantities:
///
/// | quantity | meaning |
/// |---|---|
/// | `id1`, `id2` | the numbers of the two spheres |
/// | `force` | the force along the line between their centres; compressive forces are positive |
/// | `fx`, `fy`, `fz` | the force on the first of the two |
/// | `tx`, `ty`, `tz` | on a rough floor, the tangential force on the first; `fx`, `fy` and `fz` are then the normal force |
/// | `x1`, `y1`, `z1`, `x2`, `y2`, `z2` | the centres of the two |
/// | `x`, `y`, `z` | the contact point |
/// | `kind` | the kind of contact: `kind=contact_type:SS` reads the rows with `SS` in this column, and `SS\|SP` allows two kinds; all other rows count as contacts with walls |
/// | `step` | the time step or the time: of several steps in one table, the last is read |
///
/// A column is a name in the header, or `#n` for the n-th column, counted from 1, with or without a header. Numbers and
/// vectors may be sums of columns with factors:
///
/// * `fx=-f_x` reads a vector that is the force on the second sphere.
/// * `fx=#10+#13` adds a normal and a tangential part, and `fx=fx-tx` takes the tangential part away. A name in the header may
///   contain the sign too, and comes first.
/// * `force=1e7*overlap` is the force of a linear spring of 10⁷ N/m.
///
/// A quantity that is not mapped is read from the column with its own name, in capital or small letters. For LAMMPS, `patom1`, `patom2`, `natom1`
/// and `natom2` also stand for the numbers of the spheres. A column name that begins with - or contains a * needs its
/// factor: `force=1*a*b`. A name that contains a comma is quoted: `force="Force, normal"`. A + in a name is read as a
/// sum if the table has columns with the names of its parts.
///
/// # Examples
/// ```
/// use cannonpile_dem::verify::Columns;
///
/// let columns: Columns = "id1=A,id2=B,fx=-f_x,fy=-f_y,fz=-f_z".parse()?;
/// assert_eq!(columns.to_string(), "id1=A,id2=B,fx=-f_x,fy=-f_y,fz=-f_z");
/// assert!("weight=W".parse::<Columns>().is_err());
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    /// The mapped quantities, in the order of the user.
    sums: Vec<(Quantity, Vec<Term>)>,
    kinds: Vec<String>,
    first_id: FirstId,
}

/// The number that a code gives to its first sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FirstId(u64);

impl Default for FirstId {
    fn default() -> Self {
        Self(1)
    }
}

/// A column and its factor.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Term {
    pub(super) factor: f64,
    pub(super) column: Column,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Column {
    Named(String),
    /// Counted from 0.
    Numbered(usize),
}

impl Columns {
    /// Returns these columns with the quantities that `by` maps replaced.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Columns, Preset};
    ///
    /// // MDDEM writes overlaps. The force of a linear spring is its stiffness times the overlap.
    /// let columns = Preset::Mddem.columns().overridden(&"force=1e7*overlap".parse()?);
    /// assert!(columns.to_string().ends_with("force=10000000*overlap"));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn overridden(mut self, by: &Self) -> Self {
        self.sums
            .retain(|(quantity, _)| by.terms(*quantity).is_none());
        self.sums.extend(by.sums.iter().cloned());
        if !by.kinds.is_empty() {
            self.kinds.clone_from(&by.kinds);
        }
        if by.first_id != FirstId::default() {
            self.first_id = by.first_id;
        }
        self
    }

    /// Returns these columns for a code that numbers its spheres from `first_id` instead of 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::{Columns, Reader};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let reader = Reader::new().with_columns(Columns::default().with_first_id(0));
    /// let read = reader.compare(&packing, &b"id1,id2,force\n0,1,0.46\n0,2,0.46\n0,3,0.46\n"[..])?;
    /// assert_eq!(read.comparison.matched(), 3);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn with_first_id(self, first_id: u64) -> Self {
        Self {
            first_id: FirstId(first_id),
            ..self
        }
    }

    /// Returns these columns with a quantity that is a factor times a sum of columns. The caller maps each quantity once.
    pub(super) fn with(
        mut self,
        quantity: Quantity,
        factor: f64,
        sum: impl Iterator<Item = Column>,
    ) -> Self {
        let terms = sum.map(|column| Term { factor, column }).collect();
        self.sums.push((quantity, terms));
        self
    }

    /// Returns these columns with the kinds of contacts that are read.
    pub(super) fn with_kinds(mut self, kinds: &[&str]) -> Self {
        self.kinds = kinds.iter().map(|&kind| kind.to_owned()).collect();
        self
    }

    pub(in crate::verify) fn first_id(&self) -> u64 {
        self.first_id.0
    }

    /// Returns the kinds of contacts that are read. An empty list means all kinds.
    pub(super) fn kinds(&self) -> &[String] {
        &self.kinds
    }

    /// Returns the columns whose sum is this quantity, if it is mapped.
    pub(super) fn terms(&self, quantity: Quantity) -> Option<&[Term]> {
        let mut sums = self.sums.iter();
        let (_, terms) = sums.find(|(named, _)| *named == quantity)?;
        Some(terms)
    }

    /// Returns whether all necessary columns are given by number, so that no header is necessary.
    pub(super) fn are_numbered(&self, needs: Needs) -> bool {
        use Quantity::{Force, Fx, Fy, Fz, Id, Id1, Id2, Tx, Ty, Tz, X, X1, X2, Z, Z1, Z2};
        let is_numbered = |quantity: &Quantity| {
            let is_numbered = |term: &Term| matches!(term.column, Column::Numbered(_));
            let terms = self.terms(*quantity);
            terms.is_some_and(|terms| terms.iter().all(is_numbered))
        };
        let are_numbered = |quantities: &[Quantity]| quantities.iter().all(is_numbered);
        let spheres = match needs.identity {
            Identity::Numbers => are_numbered(&[Id1, Id2]),
            Identity::OnFloor => are_numbered(&[Id]),
            Identity::Places => are_numbered(&[X1, Z1, X2, Z2]) || are_numbered(&[X, Z]),
        };
        let is_named =
            |quantity: &Quantity| self.terms(*quantity).is_some() && !is_numbered(quantity);
        let others = [
            Force,
            Fx,
            Fy,
            Fz,
            Tx,
            Ty,
            Tz,
            Quantity::Kind,
            Quantity::Step,
        ];
        spheres
            && !others.iter().any(is_named)
            && (are_numbered(&[Force]) || are_numbered(&[Fx, Fy, Fz]))
    }

    fn name(&mut self, assignment: &str) -> Result<(), Error> {
        let (key, column) = assignment
            .split_once('=')
            .ok_or_else(|| Error::syntax(assignment, ASSIGNMENT))?;
        let quantity = Quantity::all()
            .find(|quantity| quantity.name() == key.trim() && *quantity != Quantity::Id)
            .ok_or_else(|| Error::syntax(key, QUANTITY))?;
        if self.terms(quantity).is_some() {
            return Err(Error::syntax(
                assignment,
                "the only assignment of its quantity: assign each quantity once",
            ));
        }
        let terms = if quantity == Quantity::Kind {
            let (column, kinds) = column
                .rsplit_once(':')
                .ok_or_else(|| Error::syntax(assignment, "kind=COLUMN:VALUE"))?;
            self.kinds = kinds
                .split('|')
                .map(|kind| kind.trim().to_owned())
                .collect();
            vec![Term {
                factor: 1.0,
                column: column_of(column)?,
            }]
        } else {
            terms(column)?
        };
        if quantity.is_one_column() && !matches!(terms[..], [Term { factor: 1.0, .. }]) {
            return Err(Error::syntax(assignment, ONE));
        }
        self.sums.push((quantity, terms));
        Ok(())
    }
}

const ASSIGNMENT: &str =
    "a column such as id1=A or fx=-#10 (QUANTITY=COLUMN, several separated by commas)";
const QUANTITY: &str =
    "one of id1, id2, force, fx, fy, fz, tx, ty, tz, x, y, z, x1, y1, z1, x2, y2, z2, kind, step";
const ONE: &str = "id1=COLUMN or step=COLUMN: one column, without a sign or a factor";
const COLUMN: &str = "a column: its name, in quotes if it contains a comma, or #1 for the first";

impl FromStr for Columns {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let mut columns = Self::default();
        for assignment in split(text, ',') {
            columns.name(assignment)?;
        }
        Ok(columns)
    }
}

/// Splits a text at a sign outside of quotes.
fn split(text: &str, mark: char) -> impl Iterator<Item = &str> {
    let mut is_quoted = false;
    text.split(move |c| {
        is_quoted ^= c == '"';
        c == mark && !is_quoted
    })
}

/// Parses a sum of columns with signs and factors. A + ends a column name. A - does so after a quote and before #; in other
/// names, the header decides.
fn terms(text: &str) -> Result<Vec<Term>, Error> {
    let (mut spaced, mut is_quoted, mut before) = (String::new(), false, None);
    for (place, c) in text.char_indices() {
        let ends_name = before == Some('"') || text[place..].starts_with("-#");
        if c == '-' && !is_quoted && before.is_some() && ends_name {
            spaced.push('+');
        }
        spaced.push(c);
        is_quoted ^= c == '"';
        before = Some(c).filter(|c| !c.is_whitespace()).or(before);
    }
    let spaced = spaced.strip_prefix('+').unwrap_or(&spaced);
    split(spaced, '+').map(term).collect()
}

fn term(text: &str) -> Result<Term, Error> {
    let (sign, rest) = match text.trim().strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text.trim()),
    };
    let (factor, column) = match rest.split_once('*') {
        Some((factor, column)) if !rest.starts_with('"') => (factor_of(factor)?, column),
        _ => (1.0, rest),
    };
    Ok(Term {
        factor: sign * factor,
        column: column_of(column)?,
    })
}

fn factor_of(text: &str) -> Result<f64, Error> {
    let factor = text.trim().parse::<f64>().ok();
    let factor = factor.filter(|factor| factor.is_finite() && *factor != 0.0);
    factor.ok_or_else(|| Error::syntax(text, "a factor such as 1e7 or -0.5"))
}

fn column_of(text: &str) -> Result<Column, Error> {
    let text = text.trim();
    let Some(place) = text.strip_prefix('#') else {
        let quoted = text
            .strip_prefix('"')
            .and_then(|text| text.strip_suffix('"'));
        let name = quoted.unwrap_or(text).trim();
        if name.is_empty() || name.contains('"') {
            return Err(Error::syntax(text, COLUMN));
        }
        return Ok(Column::Named(name.to_owned()));
    };
    let place = place
        .parse()
        .ok()
        .and_then(|place: usize| place.checked_sub(1));
    let place = place.ok_or_else(|| Error::syntax(text, COLUMN))?;
    Ok(Column::Numbered(place))
}

impl fmt::Display for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, (quantity, terms)) in self.sums.iter().enumerate() {
            let comma = if n == 0 { "" } else { "," };
            write!(f, "{comma}{}=", quantity.name())?;
            for (n, Term { factor, column }) in terms.iter().enumerate() {
                let sign = match (*factor < 0.0, n) {
                    (true, _) if matches!(column, Column::Named(_)) && n > 0 => "+-",
                    (true, _) => "-",
                    (false, 0) => "",
                    (false, _) => "+",
                };
                f.write_str(sign)?;
                // The explicit factor keeps the first part of such a name from being parsed as a factor or a sign. A
                // kind takes no factor.
                let is_part_of = |name: &String| name.starts_with('-') || name.contains('*');
                let needs_factor = *quantity != Quantity::Kind
                    && matches!(column, Column::Named(name) if is_part_of(name));
                if needs_factor || factor.abs().to_bits() != 1.0_f64.to_bits() {
                    write!(f, "{}*", factor.abs())?;
                }
                match column {
                    Column::Named(name) if name.starts_with('#') || name.contains([',', '+']) => {
                        write!(f, "\"{name}\"")?;
                    }
                    Column::Named(name) => f.write_str(name)?,
                    Column::Numbered(place) => write!(f, "#{}", place + 1)?,
                }
            }
            if *quantity == Quantity::Kind {
                write!(f, ":{}", self.kinds.join("|"))?;
            }
        }
        Ok(())
    }
}
