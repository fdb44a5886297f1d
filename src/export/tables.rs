//! The tables there are: summary, base, contacts, spheres, theorems.

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::One;

use super::table::{Layout, Row};
use super::{Cell, Column, Table};
use crate::geometry::Apart;
use crate::lattice::{Dimension, Direction, Selection, Site, count};
use crate::scalar::{Ring, Surd};
use crate::theorem::{Proof, Theorem};
use crate::{Error, FloorForce, Packing, Pile, Statics};

/// The most rows that are written.
pub const MAX_ROWS: u64 = 100_000_000_000;

/// The units of a table.
#[derive(Clone, Debug)]
pub enum Units<'p> {
    /// Multiples of f₀, mg and mg·tanθ: rational, whatever the spacing.
    Pile(Box<Statics<'p, BigRational>>),
    /// Newtons and metres, for radius, mass and gravity in SI units.
    Si(Box<Packing<'p>>),
}

impl<'p> Units<'p> {
    /// Pile units.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::export::{Units, tables};
    /// use cannonpile::lattice::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let table = tables::contacts(&Units::of_pile(&pile), Selection::All)?;
    /// assert_eq!(table.columns()[4].unit, "mg/(3cosθ)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn of_pile(pile: &'p Pile) -> Self {
        Self::Pile(Box::new(pile.statics()))
    }

    /// SI units.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::export::{Units, tables};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Selection;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let units = Units::of_packing(Packing::new(&pile, &spacing)?);
    /// assert_eq!(tables::base(&units, Selection::Base)?.columns()[2].unit, "N");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn of_packing(packing: Packing<'p>) -> Self {
        Self::Si(Box::new(packing))
    }

    fn pile(&self) -> &'p Pile {
        match self {
            Self::Pile(statics) => statics.pile(),
            Self::Si(packing) => packing.pile(),
        }
    }

    fn on_floor(&self, site: Site) -> Result<FloorForce<Surd>, Error> {
        match self {
            Self::Pile(statics) => statics.on_floor(site).map(|force| FloorForce {
                site,
                normal: force.normal.into(),
                shear_x: force.shear_x.into(),
                shear_y: force.shear_y.into(),
            }),
            Self::Si(packing) => packing.on_floor(site),
        }
    }

    fn contact(&self, site: Site, direction: Direction) -> Result<Surd, Error> {
        match self {
            Self::Pile(statics) => Ok(statics.contact(site, direction)?.into()),
            Self::Si(packing) => packing.contact(site, direction),
        }
    }

    fn force(&self) -> &'static str {
        match self {
            Self::Si(_) => "N",
            Self::Pile(_) if self.pile().dimension() == Dimension::Two => "mg/(2cosθ)",
            Self::Pile(_) if self.pile().is_regular() => "mg/(3cosθ)",
            Self::Pile(_) => "mg/(2(1+sinφ)cosθ)",
        }
    }

    fn normal(&self) -> &'static str {
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
/// use cannonpile::export::{FileFormat, NumberFormat, Units, tables};
/// use cannonpile::lattice::{Selection, Site};
///
/// let pile = Pile::triangular(10)?;
/// let corner = Selection::One(Site { i: 0, j: 0, k: 9 });
/// let mut csv = Vec::new();
/// tables::base(&Units::of_pile(&pile), corner)?.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(String::from_utf8(csv)?, "i,j,normal,shear_x,shear_y\n0,0,4,-3/2,-3/2\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn base<'p>(units: &Units<'p>, selection: Selection) -> Result<Table<'p>, Error> {
    let pile = units.pile();
    let rows = pile.rows(selection)?;
    refuse_beyond(&rows.sites(), "ask for one sphere with --at")?;
    let mut columns = indices(pile, &[]);
    columns.push(Column::summed("normal", units.normal()));
    columns.push(Column::summed("shear_x", units.shear_x()));
    if pile.dimension() == Dimension::Three {
        columns.push(Column::summed("shear_y", units.shear_y()));
    }
    let units = units.clone();
    let row = move |site| -> Row {
        let force = units.on_floor(site)?;
        let mut cells = places(pile, site);
        cells.extend([force.normal.into(), force.shear_x.into()]);
        if pile.dimension() == Dimension::Three {
            cells.push(force.shear_y.into());
        }
        Ok(cells)
    };
    Ok(Table {
        columns,
        layout: Layout::Rows("bottom spheres"),
        extremes: rows.corners().map(&row).collect(),
        rows: Box::new(rows.flatten().map(row)),
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
/// use cannonpile::export::{FileFormat, NumberFormat, Units, tables};
/// use cannonpile::lattice::Selection;
///
/// let pile = Pile::triangular(2)?;
/// let table = tables::contacts(&Units::of_pile(&pile), Selection::All)?;
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
    let mut columns = indices(pile, &["k"]);
    columns.push(Column::plain("direction"));
    columns.push(Column::summed("force", units.force()));
    if let Units::Si(_) = units {
        columns.extend(["fx", "fy", "fz"].map(|name| Column::measured(name, "N")));
        columns.extend(["x", "y", "z"].map(|name| Column::measured(name, "m")));
    }
    let units = units.clone();
    let row = move |(site, direction): (Site, Direction)| -> Row {
        let mut cells = vec![site.k.into()];
        cells.extend(places(pile, site));
        cells.push(direction.name().into());
        cells.push(units.contact(site, direction)?.into());
        if let Units::Si(packing) = &units {
            cells.extend(packing.contact_vector(site, direction)?.map(Cell::from));
            cells.extend(packing.contact_point(site, direction)?.map(Cell::from));
        }
        Ok(cells)
    };
    let below = move |site| directions.iter().map(move |direction| (site, *direction));
    Ok(Table {
        columns,
        layout: Layout::Rows("contacts"),
        extremes: rows.corners().flat_map(below).map(&row).collect(),
        rows: Box::new(rows.flatten().flat_map(below).map(row)),
    })
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
/// use cannonpile::export::{FileFormat, NumberFormat, tables};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::lattice::{Selection, Site};
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::from_integer(1.into()))?)?;
/// let table = tables::spheres(&packing, Selection::One(Site::APEX))?;
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
    let row = move |site: Site| -> Row {
        let mut cells = vec![Cell::Integer(id(pile, site)), site.k.into()];
        cells.extend(places(pile, site));
        cells.extend(packing.position(site)?.map(Cell::from));
        cells.extend([
            packing.radius().clone().into(),
            packing.mass().clone().into(),
        ]);
        cells.push(Cell::Flag(site.k + 1 == pile.layers()));
        Ok(cells)
    };
    Ok(Table {
        columns,
        layout: Layout::Rows("spheres"),
        extremes: rows.corners().map(&row).collect(),
        rows: Box::new(rows.flatten().map(row)),
    })
}

/// What is proved for every pile, a theorem a row: `name, statement, symbols, holds`.
///
/// # Examples
/// ```
/// use cannonpile::export::tables;
/// use cannonpile::theorem;
///
/// let table = tables::theorems(theorem::all().map(|theorem| (theorem, theorem.prove())));
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
        rows: Box::new(proved.map(row)),
    }
}

/// The pile in one row: `layers, stacking, spheres, contacts, weight, stands, min_contact, base_spheres,
/// normal_min, normal_max, max_shear_ratio, touching, plan`.
///
/// `touching` is what touches beside the contacts at the spacing in question, if there is one. The least
/// and greatest values are taken from the corners, where a linear function has them.
///
/// # Errors
/// None of a pile that exists; those of its forces are handed on.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::export::{FileFormat, NumberFormat, Units, tables};
///
/// let pile = Pile::triangular(10)?;
/// let table = tables::summary(&Units::of_pile(&pile), None)?;
/// let mut text = Vec::new();
/// table.write(FileFormat::Text, NumberFormat::Exact, &mut text)?;
/// let text = String::from_utf8(text)?;
/// assert!(text.starts_with("layers           10\nstacking         fcc\nspheres          220\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn summary<'p>(units: &Units<'p>, touching: Option<&[Apart]>) -> Result<Table<'p>, Error> {
    let pile = units.pile();
    let base = pile.rows(Selection::Base)?;
    let normals: Result<Vec<Surd>, Error> = base
        .corners()
        .map(|site| Ok(units.on_floor(site)?.normal))
        .collect();
    let normals = normals?;
    let directions = pile.dimension().directions();
    let first_contacts: Result<Vec<Surd>, Error> = match pile.layers() {
        1 => Ok(Vec::new()),
        _ => directions
            .iter()
            .map(|d| units.contact(Site::APEX, *d))
            .collect(),
    };
    let ratio = pile.base_extremes()?.max_shear_ratio;
    let (weight, ratio) = match units {
        Units::Pile(_) => (BigRational::one(), ratio),
        Units::Si(packing) => (
            packing.sphere_weight(),
            packing.inclination().tan() * &ratio,
        ),
    };
    let spheres = BigInt::from(pile.spheres());
    let or_missing = |value: Option<&Surd>| value.map_or(Cell::Missing, |x| x.clone().into());
    let entries = [
        (Column::plain("layers"), pile.layers().into()),
        (Column::plain("stacking"), stacking(pile).into()),
        (Column::plain("spheres"), Cell::Integer(spheres.clone())),
        (
            Column::plain("contacts"),
            Cell::Integer(pile.contacts().into()),
        ),
        (
            Column::measured("weight", units.normal()),
            (weight * BigRational::from_integer(spheres)).into(),
        ),
        // Every force of a straight pile is a positive number of increments.
        (Column::plain("stands"), "yes".into()),
        (
            Column::measured("min_contact", units.force()),
            or_missing(first_contacts?.iter().min()),
        ),
        (
            Column::plain("base_spheres"),
            Cell::Integer(pile.base_spheres().into()),
        ),
        (
            Column::measured("normal_min", units.normal()),
            or_missing(normals.iter().min()),
        ),
        (
            Column::measured("normal_max", units.normal()),
            or_missing(normals.iter().max()),
        ),
        (
            Column::measured(
                "max_shear_ratio",
                if let Units::Pile(_) = units {
                    "tanθ"
                } else {
                    ""
                },
            ),
            ratio.into(),
        ),
        (
            Column::plain("touching"),
            touching.map_or(Cell::Missing, describe),
        ),
        (Column::plain("plan"), "closed".into()),
    ];
    let (columns, row): (Vec<_>, Vec<_>) = entries.into_iter().unzip();
    Ok(Table {
        columns,
        layout: Layout::Record,
        extremes: vec![Ok(row.clone())],
        rows: Box::new(core::iter::once(Ok(row))),
    })
}

/// The name of a straight pile's stacking.
fn stacking(pile: &Pile) -> &'static str {
    match pile.dimension() {
        Dimension::Two => "discs",
        Dimension::Three => "fcc",
    }
}

/// `none`, `in one layer and 3 layers apart`.
fn describe(touching: &[Apart]) -> Cell {
    let words: Vec<String> = touching.iter().map(ToString::to_string).collect();
    if words.is_empty() {
        "none".into()
    } else {
        Cell::Word(words.join(" and ").into())
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

/// The number of a sphere, from 1 in row order from the top.
fn id(pile: &Pile, site: Site) -> BigInt {
    let [i, j, k] = [site.i, site.j, site.k].map(BigRational::from_i128);
    count::before(&i, &j, &k, pile.dimension().number()).to_integer() + 1
}

fn refuse_beyond(rows: &BigUint, remedy: &'static str) -> Result<(), Error> {
    if *rows <= BigUint::from(MAX_ROWS) {
        return Ok(());
    }
    Err(Error::TooManyRows {
        rows: rows.clone(),
        limit: MAX_ROWS,
        remedy,
    })
}
