//! The mapping from quantities to the columns of a table.

use core::str::FromStr;

use crate::error::Syntax;

/// A quantity that columns of a table can contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
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
    pub(crate) const COUNT: usize = 21;

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

    pub(crate) const FIRST: [Self; 3] = [Self::X1, Self::Y1, Self::Z1];
    pub(crate) const SECOND: [Self; 3] = [Self::X2, Self::Y2, Self::Z2];
    pub(crate) const POINT: [Self; 3] = [Self::X, Self::Y, Self::Z];
    pub(crate) const VECTOR: [Self; 3] = [Self::Fx, Self::Fy, Self::Fz];
    pub(crate) const TANGENTIAL: [Self; 3] = [Self::Tx, Self::Ty, Self::Tz];

    pub(crate) fn all() -> impl Iterator<Item = Self> {
        Self::NAMES.into_iter().map(|(quantity, _)| quantity)
    }

    pub(crate) const fn names(self) -> &'static [&'static str] {
        Self::NAMES[self as usize].1
    }

    /// Returns whether a column with this name contains the quantity.
    pub(crate) fn is_named(self, name: &str) -> bool {
        let mut names = self.names().iter();
        names.any(|known| known.eq_ignore_ascii_case(name))
    }

    /// Returns whether the quantity is one column, never a sum: the number of a sphere, a kind, or a step.
    pub(crate) const fn is_one_column(self) -> bool {
        matches!(
            self,
            Self::Id1 | Self::Id2 | Self::Id | Self::Kind | Self::Step
        )
    }

    pub(crate) const fn name(self) -> &'static str {
        match self.names() {
            [name, ..] => name,
            [] => "kind",
        }
    }
}

/// The identification of the two spheres that a table must contain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Identity {
    /// The numbers of both.
    #[default]
    Numbers,
    /// Their centres, or the contact point.
    Places,
    /// The number of one sphere, in the column `id`. The other number of its row is 0.
    OneNumber,
}

impl Identity {
    /// Returns the quantities without which the spheres are not known. The centres or the contact point may be given.
    pub(crate) const fn necessary(self, by_centres: bool) -> &'static [Quantity] {
        use Quantity::{Id, Id1, Id2, X, X1, X2, Z, Z1, Z2};
        match self {
            Self::Numbers => &[Id1, Id2],
            Self::OneNumber => &[Id],
            Self::Places if by_centres => &[X1, Z1, X2, Z2],
            Self::Places => &[X, Z],
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
/// use contact_tables::Columns;
///
/// let columns: Columns = "id1=A,id2=B,fx=-f_x,fy=-f_y,fz=-f_z".parse()?;
/// assert_eq!(columns, "id1 = A, id2 = B, fx = -1*f_x, fy = -1*f_y, fz = -1*f_z".parse()?);
/// assert!("weight=W".parse::<Columns>().is_err());
/// # Ok::<(), contact_tables::Syntax>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    /// The mapped quantities, in the order of the user.
    sums: Vec<(Quantity, Vec<Term>)>,
    kinds: Vec<String>,
    /// The number of the first sphere, if it is not 1.
    first_id: Option<u64>,
}

/// A column and its factor.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Term {
    pub(crate) factor: f64,
    pub(crate) column: Column,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Column {
    Named(String),
    /// Counted from 0.
    Numbered(usize),
}

impl Columns {
    /// Returns these columns with the quantities that `by` maps replaced.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::{Columns, Preset};
    ///
    /// // MDDEM writes overlaps. The force of a linear spring is its stiffness times the overlap.
    /// let columns = Preset::Mddem.columns().overridden(&"force=1e7*overlap".parse()?);
    /// assert_eq!(columns, "x=cx,y=cy,z=cz,force=1e7*overlap".parse()?);
    /// # Ok::<(), contact_tables::Syntax>(())
    /// ```
    #[must_use]
    pub fn overridden(mut self, by: &Self) -> Self {
        self.sums
            .retain(|(quantity, _)| by.terms(*quantity).is_none());
        self.sums.extend(by.sums.iter().cloned());
        if !by.kinds.is_empty() {
            self.kinds.clone_from(&by.kinds);
        }
        self.first_id = by.first_id.or(self.first_id);
        self
    }

    /// Returns these columns for a code that numbers its spheres from `first_id` instead of 1.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::{Columns, Format, Spheres};
    ///
    /// let format = Format::of(Columns::default().with_first_id(0));
    /// let table = "id1,id2,force\n0,1,0.5\n";
    /// let first = contact_tables::read(table.as_bytes(), &format)?.next().unwrap()?;
    /// assert_eq!(first.spheres, Spheres::Numbers([1, 2]));
    /// # Ok::<(), contact_tables::Error>(())
    /// ```
    #[must_use]
    pub fn with_first_id(self, first_id: u64) -> Self {
        Self {
            first_id: Some(first_id).filter(|first| *first != 1),
            ..self
        }
    }

    /// Returns the number that the code gives to its first sphere.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::Preset;
    ///
    /// assert_eq!(Preset::Yade.columns().first_id(), 0);
    /// ```
    #[must_use]
    pub fn first_id(&self) -> u64 {
        self.first_id.unwrap_or(1)
    }

    /// Returns the kinds of contacts that are read. An empty list means all kinds.
    pub(crate) fn kinds(&self) -> &[String] {
        &self.kinds
    }

    /// Returns the columns whose sum is this quantity, if it is mapped.
    pub(crate) fn terms(&self, quantity: Quantity) -> Option<&[Term]> {
        let mut sums = self.sums.iter();
        let (_, terms) = sums.find(|(named, _)| *named == quantity)?;
        Some(terms)
    }

    /// Returns whether all necessary columns are given by number, so that no header is necessary.
    pub(crate) fn are_numbered(&self, identity: Identity) -> bool {
        let are_mapped =
            |quantities: &[Quantity]| quantities.iter().all(|q| self.terms(*q).is_some());
        let is_numbered = |term: &Term| matches!(term.column, Column::Numbered(_));
        let mut terms = self.sums.iter().flat_map(|(_, terms)| terms);
        let spheres = [false, true].map(|by_centres| identity.necessary(by_centres));
        terms.all(is_numbered)
            && spheres.into_iter().any(are_mapped)
            && (are_mapped(&[Quantity::Force]) || are_mapped(&Quantity::VECTOR))
    }

    fn name(&mut self, assignment: &str) -> Result<(), Syntax> {
        let (key, column) = assignment
            .split_once('=')
            .ok_or_else(|| Syntax::new(assignment, ASSIGNMENT))?;
        let quantity = Quantity::all()
            .find(|quantity| quantity.name() == key.trim() && *quantity != Quantity::Id)
            .ok_or_else(|| Syntax::new(key, QUANTITY))?;
        if self.terms(quantity).is_some() {
            return Err(Syntax::new(
                assignment,
                "the only assignment of its quantity: assign each quantity once",
            ));
        }
        let terms = if quantity == Quantity::Kind {
            let (column, kinds) = column
                .rsplit_once(':')
                .ok_or_else(|| Syntax::new(assignment, "kind=COLUMN:VALUE"))?;
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
            return Err(Syntax::new(assignment, ONE));
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
    type Err = Syntax;

    fn from_str(text: &str) -> Result<Self, Syntax> {
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
fn terms(text: &str) -> Result<Vec<Term>, Syntax> {
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

fn term(text: &str) -> Result<Term, Syntax> {
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

fn factor_of(text: &str) -> Result<f64, Syntax> {
    let factor = text.trim().parse::<f64>().ok();
    let factor = factor.filter(|factor| factor.is_finite() && *factor != 0.0);
    factor.ok_or_else(|| Syntax::new(text, "a factor such as 1e7 or -0.5"))
}

fn column_of(text: &str) -> Result<Column, Syntax> {
    let text = text.trim();
    let Some(place) = text.strip_prefix('#') else {
        let quoted = text
            .strip_prefix('"')
            .and_then(|text| text.strip_suffix('"'));
        let name = quoted.unwrap_or(text).trim();
        if name.is_empty() || name.contains('"') {
            return Err(Syntax::new(text, COLUMN));
        }
        return Ok(Column::Named(name.to_owned()));
    };
    let place = place
        .parse()
        .ok()
        .and_then(|place: usize| place.checked_sub(1));
    let place = place.ok_or_else(|| Syntax::new(text, COLUMN))?;
    Ok(Column::Numbered(place))
}
