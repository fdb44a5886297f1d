//! The tables there are: base, contacts, spheres, theorems, census.

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::One;

use super::rows::{Layout, Row};
use super::summary::steps;
use super::{Cell, Column, Table};
use crate::census::Entry;
use crate::lattice::{Dimension, Direction, Site};
use crate::scalar::{Ring, Surd};
use crate::shape::{Rows, Selection};
use crate::theorem::{Proof, Theorem};
use crate::{ContactForce, Error, FloorForce, Forces, Packing, Pile};

/// The most rows that are written.
pub const MAX_ROWS: u64 = 100_000_000_000;

/// The units of a table.
#[derive(Clone, Debug)]
pub enum Units<'p> {
    /// Multiples of f₀, mg and mg·tanθ: rational, whatever the spacing.
    Pile(Box<Forces<'p, BigRational>>),
    /// Newtons and metres, for radius, mass and gravity in SI units.
    Si(Box<Packing<'p>>),
}

impl<'p> Units<'p> {
    /// Pile units.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::table::{self, Units};
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let table = table::contacts(&Units::of_pile(&pile), Selection::All)?;
    /// assert_eq!(table.columns()[4].unit, "mg/(3cosθ)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn of_pile(pile: &'p Pile) -> Self {
        Self::Pile(Box::new(pile.forces()))
    }

    /// SI units.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::{self, Units};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let units = Units::of_packing(Packing::new(&pile, &spacing)?);
    /// assert_eq!(table::base(&units, Selection::Base)?.columns()[2].unit, "N");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn of_packing(packing: Packing<'p>) -> Self {
        Self::Si(Box::new(packing))
    }

    pub(super) fn pile(&self) -> &'p Pile {
        match self {
            Self::Pile(forces) => forces.pile(),
            Self::Si(packing) => packing.pile(),
        }
    }

    /// The forces of the bottom spheres of these rows on the floor.
    fn base(
        &self,
        part: Selection,
    ) -> Result<Box<dyn Iterator<Item = Result<FloorForce<Surd>, Error>> + 'p>, Error> {
        Ok(match self {
            Self::Pile(forces) => {
                Box::new(forces.base(part)?.map(|force| Ok(force?.map(Surd::from))))
            }
            Self::Si(packing) => Box::new(packing.base(part)?),
        })
    }

    /// The contacts of the spheres of these rows, as the cells of a table.
    fn contacts(&self, part: Selection) -> Result<Box<dyn Iterator<Item = Row> + 'p>, Error> {
        let pile = self.pile();
        let first = move |site: Site, direction: Direction, force: Cell| {
            let mut cells = vec![site.k.into()];
            cells.extend(places(pile, site));
            cells.extend([direction.name().into(), force]);
            cells
        };
        Ok(match self {
            Self::Pile(forces) => Box::new(forces.contacts(part)?.map(move |contact| {
                let contact = contact?;
                Ok(first(contact.site, contact.direction, contact.force.into()))
            })),
            Self::Si(packing) => Box::new(packing.contacts(part)?.map(move |contact| {
                let contact = contact?;
                let mut cells = first(contact.site, contact.direction, contact.force.into());
                cells.extend(contact.vector.map(Cell::from));
                cells.extend(contact.point.map(Cell::from));
                Ok(cells)
            })),
        })
    }

    /// A number that no force of the pile exceeds, in mg or f₀: in ℓ² over a layer, no more is passed on than √3 times
    /// the sum of all weights (THEORY §3).
    fn greatest_force(&self) -> Surd {
        let bound = self.pile().weight() * BigRational::from_i128(3);
        match self {
            Self::Pile(_) => bound.into(),
            // f₀ is greater than mg only by 1/cosθ, and shear by tanθ.
            Self::Si(packing) => {
                let unit = packing.sphere_weight() * bound;
                let cos2 = packing.inclination().cos2();
                // 1/cosθ and tanθ are both at most this; a rational bound is enough.
                (unit / cos2).into()
            }
        }
    }

    pub(super) fn force(&self) -> &'static str {
        match self {
            Self::Si(_) => "N",
            Self::Pile(_) if self.pile().dimension() == Dimension::Two => "mg/(2cosθ)",
            Self::Pile(_) if self.pile().is_regular() => "mg/(3cosθ)",
            Self::Pile(_) => "mg/(2(1+sinφ)cosθ)",
        }
    }

    pub(super) fn normal(&self) -> &'static str {
        if let Self::Si(_) = self { "N" } else { "mg" }
    }

    fn shear_x(&self) -> &'static str {
        if let Self::Si(_) = self {
            "N"
        } else {
            "mg·tanθ"
        }
    }

    fn shear_y(&self) -> &'static str {
        match self {
            Self::Si(_) => "N",
            Self::Pile(_) if self.pile().is_regular() => "√3·mg·tanθ",
            Self::Pile(_) => "2cosφ·mg·tanθ",
        }
    }
}

/// The force of each bottom sphere on the floor: `i, j, normal, shear_x, shear_y`; for discs
/// `i, normal, shear_x`.
///
/// # Errors
/// [`Error::SiteOutside`], [`Error::LayerOutside`], [`Error::NotOnFloor`] for a selection that is not
/// of the base; [`Error::TooManyRows`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::table::{self, FileFormat, NumberFormat, Units};
/// use cannonpile::lattice::Site;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let corner = Selection::One(Site { i: 0, j: 0, k: 9 });
/// let mut csv = Vec::new();
/// table::base(&Units::of_pile(&pile), corner)?.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(String::from_utf8(csv)?, "i,j,normal,shear_x,shear_y\n0,0,4,-3/2,-3/2\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn base<'p>(units: &Units<'p>, selection: Selection) -> Result<Table<'p>, Error> {
    let pile = units.pile();
    let rows = pile.rows(selection)?;
    refuse_beyond(&rows.sites(), "ask for one sphere with --at")?;
    // What cannot be done is refused before a row is written.
    let forces = units.base(selection)?;
    let mut columns = indices(pile, &[]);
    columns.push(Column::summed("normal", units.normal()));
    columns.push(Column::summed("shear_x", units.shear_x()));
    if pile.dimension() == Dimension::Three {
        columns.push(Column::summed("shear_y", units.shear_y()));
    }
    let row = move |force: Result<FloorForce<Surd>, Error>| -> Row {
        let force = force?;
        let mut cells = places(pile, force.site);
        cells.extend([force.normal.into(), force.shear_x.into()]);
        if pile.dimension() == Dimension::Three {
            cells.push(force.shear_y.into());
        }
        Ok(cells)
    };
    let corners = corners(pile, &rows);
    let mut extremes = Vec::new();
    for corner in corners {
        extremes.extend(units.base(corner)?.map(row));
    }
    Ok(Table {
        bounds: bounds(&columns, units),
        columns,
        layout: Layout::Rows("bottom spheres"),
        extremes,
        rows: Box::new(forces.map(row)),
    })
}

/// The contacts between spheres: `k, i, j, direction, force`, and in SI the force on the upper sphere
/// `fx, fy, fz` and the point of contact `x, y, z`; for discs without `j`.
///
/// # Errors
/// [`Error::SiteOutside`], [`Error::LayerOutside`]; [`Error::TooManyRows`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::table::{self, FileFormat, NumberFormat, Units};
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(2)?;
/// let table = table::contacts(&Units::of_pile(&pile), Selection::All)?;
/// let mut csv = Vec::new();
/// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(
///     String::from_utf8(csv)?,
///     "k,i,j,direction,force\n0,0,0,alpha,1\n0,0,0,beta,1\n0,0,0,gamma,1\n",
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn contacts<'p>(units: &Units<'p>, selection: Selection) -> Result<Table<'p>, Error> {
    let pile = units.pile();
    let directions = pile.dimension().directions();
    let rows = pile.rows(selection)?.off_the_floor();
    refuse_beyond(
        &(rows.sites() * directions.len()),
        "ask for --layer or --at",
    )?;
    let contacts = units.contacts(selection)?;
    let mut columns = indices(pile, &["k"]);
    columns.push(Column::plain("direction"));
    columns.push(Column::summed("force", units.force()));
    if let Units::Si(_) = units {
        columns.extend(["fx", "fy", "fz"].map(|name| Column::measured(name, "N")));
        columns.extend(["x", "y", "z"].map(|name| Column::measured(name, "m")));
    }
    let corners = corners(pile, &rows);
    let mut extremes = Vec::new();
    for corner in corners {
        extremes.extend(units.contacts(corner)?);
    }
    Ok(Table {
        bounds: bounds(&columns, units),
        columns,
        layout: Layout::Rows("contacts"),
        extremes,
        rows: contacts,
    })
}

/// The single spheres in which the columns of a table take their extremes, of a pile that the paper solved.
fn corners(pile: &Pile, rows: &Rows<'_>) -> impl Iterator<Item = Selection> + use<> {
    let corners: Vec<Site> = if pile.is_paper_pile() {
        rows.corners().collect()
    } else {
        Vec::new()
    };
    corners.into_iter().map(Selection::One)
}

/// A row that no row of the table exceeds, for the columns that hold forces.
fn bounds(columns: &[Column], units: &Units<'_>) -> Vec<Cell> {
    let greatest = units.greatest_force();
    let bound = |column: &Column| {
        if column.unit.is_empty() || column.unit == "m" {
            Cell::Missing
        } else {
            greatest.clone().into()
        }
    };
    columns.iter().map(bound).collect()
}

/// The spheres, in SI: `id, k, i, j, x, y, z, radius, mass, fixed`; for discs without `j`.
///
/// Numbered from 1 in row order from the top; the bottom layer is fixed.
///
/// # Errors
/// [`Error::SiteOutside`], [`Error::LayerOutside`]; [`Error::TooManyRows`].
///
/// # Examples
/// ```
/// use cannonpile::table::{self, FileFormat, NumberFormat};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::lattice::Site;
/// use cannonpile::shape::Selection;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::from_integer(1.into()))?)?;
/// let table = table::spheres(&packing, Selection::One(Site::APEX))?;
/// let mut csv = Vec::new();
/// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(
///     String::from_utf8(csv)?,
///     "id,k,i,j,x,y,z,radius,mass,fixed\n1,0,0,0,0,0,2/3*sqrt(6),1,1,0\n",
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn spheres<'p>(packing: &Packing<'p>, selection: Selection) -> Result<Table<'p>, Error> {
    let pile = packing.pile();
    let rows = pile.rows(selection)?;
    refuse_beyond(&rows.sites(), "ask for --layer or --at")?;
    let mut columns = indices(pile, &["id", "k"]);
    columns.extend(["x", "y", "z", "radius"].map(|name| Column::measured(name, "m")));
    columns.push(Column::summed("mass", "kg"));
    columns.push(Column::plain("fixed"));
    let packing = packing.clone();
    let row = move |(id, site): (BigInt, Site)| -> Row {
        let mut cells = vec![Cell::Integer(id), site.k.into()];
        cells.extend(places(pile, site));
        cells.extend(packing.position(site)?.map(Cell::from));
        cells.extend([
            packing.radius().clone().into(),
            packing.mass_of(site)?.into(),
        ]);
        cells.push(Cell::Flag(site.k + 1 == pile.layers()));
        Ok(cells)
    };
    let id = |site| Ok((BigInt::from(pile.shape().before(site)?) + 1, site));
    let extremes = rows.corners().map(|site| row(id(site)?)).collect();
    // Rows follow each other, and so do numbers.
    let first = rows
        .clone()
        .flatten()
        .next()
        .map_or(Ok(BigInt::one()), |site| Ok(id(site)?.0));
    let numbers = core::iter::successors(Some(first?), |id| Some(id + 1));
    Ok(Table {
        columns,
        layout: Layout::Rows("spheres"),
        extremes,
        bounds: Vec::new(),
        rows: Box::new(numbers.zip(rows.flatten()).map(row)),
    })
}

/// What is proved for every pile, a theorem a row: `name, statement, symbols, holds`.
///
/// # Examples
/// ```
/// use cannonpile::table;
/// use cannonpile::theorem;
///
/// let table = table::theorems(theorem::all().map(|theorem| (theorem, theorem.prove())));
/// assert_eq!(table.columns().len(), 4);
/// ```
pub fn theorems<'t>(proved: impl Iterator<Item = (&'t Theorem, Proof)> + 't) -> Table<'t> {
    let columns = ["name", "statement", "symbols", "holds"].map(Column::plain);
    let row = |(theorem, proof): (&Theorem, Proof)| -> Row {
        let Theorem {
            name,
            statement,
            symbols,
            ..
        } = *theorem;
        Ok(vec![
            name.into(),
            statement.into(),
            symbols.into(),
            Cell::Flag(proof.holds()),
        ])
    };
    Table {
        columns: columns.into(),
        layout: Layout::Rows("theorems"),
        extremes: Vec::new(),
        bounds: Vec::new(),
        rows: Box::new(proved.map(row)),
    }
}

/// The most layers of a stacking whose normal forces a census has.
const MOST_LAYERS: i128 = 100_000;

/// Stackings and whether they stand, one a row: `stacking, layers, stands, min_contact, base_spheres, normal_min,
/// normal_max`, and where the least contact is, `k, i, j, direction`.
///
/// The normal forces of those that do not stand are left out, and those of more than 100,000 layers, of which every row of
/// the base would be looked at.
///
/// # Examples
/// ```
/// use cannonpile::census;
/// use cannonpile::table::{self, FileFormat, NumberFormat};
///
/// let table = table::census(census::under_one_sphere(3, false)?);
/// let mut csv = Vec::new();
/// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(
///     String::from_utf8(csv)?,
///     "stacking,layers,stands,min_contact,base_spheres,normal_min,normal_max,k,i,j,direction\n\
///      ++,3,yes,1,6,5/3,5/3,0,0,0,alpha\n+-,3,yes,2/3,7,14/9,5/3,1,0,0,alpha\n",
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn census<'t>(entries: impl Iterator<Item = Result<Entry, Error>> + 't) -> Table<'t> {
    let mut columns: Vec<Column> = ["stacking", "layers", "stands"].map(Column::plain).into();
    columns.push(Column::measured("min_contact", "mg/(3cosθ)"));
    columns.push(Column::plain("base_spheres"));
    columns.extend(["normal_min", "normal_max"].map(|name| Column::measured(name, "mg")));
    columns.extend(["k", "i", "j", "direction"].map(Column::plain));
    let row = |entry: Result<Entry, Error>| -> Row {
        let Entry { pile, standing, .. } = entry?;
        let mut cells = vec![
            Cell::Word(steps(&pile).into()),
            pile.layers().into(),
            standing.verdict(&[]).name().into(),
        ];
        let least = standing.least.as_ref();
        cells.push(least.map_or(Cell::Missing, |least| least.force.clone().into()));
        cells.push(Cell::Integer(pile.base_spheres().into()));
        let base = match standing.first_failure {
            Some(_) => None,
            None if pile.layers() > MOST_LAYERS => None,
            None => match pile.base_extremes() {
                Err(Error::TooLarge { .. }) => None,
                base => Some(base?),
            },
        };
        cells.extend(match base {
            Some(base) => [base.normal_min.into(), base.normal_max.into()],
            None => [Cell::Missing, Cell::Missing],
        });
        cells.extend(match least {
            Some(ContactForce {
                site, direction, ..
            }) => [
                site.k.into(),
                site.i.into(),
                site.j.into(),
                direction.name().into(),
            ],
            None => [(); 4].map(|()| Cell::Missing),
        });
        Ok(cells)
    };
    Table {
        columns,
        layout: Layout::Rows("stackings"),
        extremes: Vec::new(),
        bounds: Vec::new(),
        rows: Box::new(entries.map(row)),
    }
}

/// The columns that say where a sphere is: those named first, then i, and j in space.
fn indices(pile: &Pile, first: &[&'static str]) -> Vec<Column> {
    let places: &[_] = if pile.dimension() == Dimension::Two {
        &["i"]
    } else {
        &["i", "j"]
    };
    first
        .iter()
        .chain(places)
        .copied()
        .map(Column::plain)
        .collect()
}

/// i, and j in space.
fn places(pile: &Pile, site: Site) -> Vec<Cell> {
    match pile.dimension() {
        Dimension::Two => vec![site.i.into()],
        Dimension::Three => vec![site.i.into(), site.j.into()],
    }
}

pub(crate) fn refuse_beyond(rows: &BigUint, remedy: &'static str) -> Result<(), Error> {
    if *rows <= BigUint::from(MAX_ROWS) {
        return Ok(());
    }
    Err(Error::TooManyRows {
        rows: rows.clone(),
        limit: MAX_ROWS,
        remedy,
    })
}
