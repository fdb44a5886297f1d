//! The tables there are: base, contacts, spheres, theorems, census.

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::cell::{Cell, NumberFormat};
use super::pieces::{columns, in_pieces, slices};
use super::rows::{Column, Row, RowIter, Table};
use super::summary::steps;
use super::units::Units;
use crate::census::Entry;
use crate::lattice::{Dimension, Direction, Site};
use crate::scalar::NearestFloat;
use crate::shape::Selection;
use crate::theorem::{Proof, Theorem};
use crate::{ContactForce, Contacts, Error, FloorForce, Packing, Pile};

/// The most rows that are written.
pub const MAX_ROWS: u64 = 100_000_000_000;

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
    refuse_beyond(&rows.site_count(), "ask for one sphere")?;
    let floor = pile.layers() - 1;
    if let Some(site) = rows.clone().flatten().next().filter(|site| site.k != floor) {
        return Err(Error::NotOnFloor { site, floor });
    }
    let mut columns = indices(pile, &[]);
    columns.push(Column::summed("normal", units.normal()));
    columns.push(Column::summed("shear_x", units.shear_x()));
    if pile.dimension() == Dimension::Three {
        columns.push(Column::summed("shear_y", units.shear_y()));
    }
    let (count, bounds) = (rows.site_count(), bounds(&columns, units, selection)?);
    let made = units.clone();
    let rows = move |numbers| {
        Ok(match rounding(numbers, selection) {
            Some(Rounding::F64) => rounded_base::<f64>(&made, selection)?,
            Some(Rounding::F32) => rounded_base::<f32>(&made, selection)?,
            None => {
                let forces = made.forces().base(selection)?;
                Box::new(forces.map(move |force| Ok(floor_cells(pile, made.on_floor(force?)))))
            }
        })
    };
    let summed = units.clone();
    let sums = move || {
        let [normal, shear_x, shear_y] = summed.forces().sum_on_floor(selection)?;
        let site = Site::APEX;
        let sum = summed.on_floor(FloorForce {
            site,
            normal,
            shear_x,
            shear_y,
        });
        Ok(vec![sum.normal, sum.shear_x, sum.shear_y])
    };
    let table = Table::made_for(columns, "bottom spheres", rows).bounded(count, bounds);
    Ok(match selection {
        Selection::One(_) => table.summed_by_rows(),
        _ => table.summed(sums),
    })
}

/// The cells of a bottom sphere.
fn floor_cells<F: Into<Cell>>(pile: &Pile, force: FloorForce<F>) -> Vec<Cell> {
    let mut cells = Vec::with_capacity(5);
    cells.extend(places(pile, force.site));
    cells.extend([force.normal.into(), force.shear_x.into()]);
    if pile.dimension() == Dimension::Three {
        cells.push(force.shear_y.into());
    }
    cells
}

/// The floats that many rows are rounded to at once. One sphere is answered exactly, and rounded as it is shown.
enum Rounding {
    F64,
    F32,
}

fn rounding(numbers: NumberFormat, selection: Selection) -> Option<Rounding> {
    match (numbers, selection) {
        (NumberFormat::Exact | NumberFormat::Interval, _) | (_, Selection::One(_)) => None,
        (NumberFormat::F64, _) => Some(Rounding::F64),
        (NumberFormat::F32, _) => Some(Rounding::F32),
    }
}

/// A float that a cell holds.
trait Float: NearestFloat + Default + Into<Cell> + 'static {}

impl Float for f64 {}
impl Float for f32 {}

fn rounded_base<'p, F: Float>(
    units: &Units<'p>,
    selection: Selection,
) -> Result<RowIter<'p>, Error> {
    let pile = units.pile();
    let mut layers = units.layers::<F>(selection)?;
    let rows = in_pieces(pile.rows(selection)?, move |row| {
        let mut forces = columns::<F>(row)?;
        layers.fill_row_of_base(row, slices(&mut forces))?;
        let [normal, x, y] = forces;
        let forces = normal.into_iter().zip(x).zip(y);
        let sites = row.clone().into_iter();
        let rows = sites
            .zip(forces)
            .map(|(site, ((normal, shear_x), shear_y))| {
                let force = FloorForce {
                    site,
                    normal,
                    shear_x,
                    shear_y,
                };
                floor_cells(pile, force)
            });
        Ok(rows.collect())
    });
    Ok(Box::new(rows))
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
    let count = rows.site_count() * directions.len();
    refuse_beyond(&count, narrower(selection))?;
    let mut columns = indices(pile, &["k"]);
    columns.push(Column::plain("direction"));
    columns.push(Column::summed("force", units.force()));
    if let Units::Si(_) = units {
        columns.extend(["fx", "fy", "fz"].map(|name| Column::measured(name, "N")));
        columns.extend(["x", "y", "z"].map(|name| Column::measured(name, "m")));
    }
    let bounds = bounds(&columns, units, selection)?;
    let made = units.clone();
    let rows = move |numbers| match rounding(numbers, selection) {
        Some(Rounding::F64) => rounded_contacts::<f64>(&made, selection),
        Some(Rounding::F32) => rounded_contacts::<f32>(&made, selection),
        None => Ok(exact_contacts(&made, made.forces().contacts(selection)?)),
    };
    let summed = units.clone();
    let sums = move || {
        let sum = summed.forces().sum_of_contacts(selection)?;
        Ok(vec![summed.contact(sum)])
    };
    let table = Table::made_for(columns, "contacts", rows).bounded(count, bounds);
    Ok(match selection {
        Selection::One(_) => table.summed_by_rows(),
        _ => table.summed(sums),
    })
}

/// Where a contact is, and the first cells of its row.
fn contact_cells(pile: &Pile, site: Site, direction: Direction) -> Vec<Cell> {
    let mut cells = Vec::with_capacity(11);
    cells.push(site.k.into());
    cells.extend(places(pile, site));
    cells.push(direction.name().into());
    cells
}

fn exact_contacts<'p>(units: &Units<'p>, forces: Contacts<'p, BigRational>) -> RowIter<'p> {
    let pile = units.pile();
    match units.clone() {
        Units::Pile(_) => Box::new(forces.map(|contact| {
            let contact = contact?;
            let mut cells = contact_cells(pile, contact.site, contact.direction);
            cells.push(contact.force.into());
            Ok(cells)
        })),
        Units::Si(packing) => Box::new(forces.map(move |contact| {
            let contact = packing.packed(contact?)?;
            let mut cells = contact_cells(pile, contact.site, contact.direction);
            cells.push(contact.force.into());
            cells.extend(contact.vector.map(Cell::from));
            cells.extend(contact.point.map(Cell::from));
            Ok(cells)
        })),
    }
}

fn rounded_contacts<'p, F: Float>(
    units: &Units<'p>,
    selection: Selection,
) -> Result<RowIter<'p>, Error> {
    let pile = units.pile();
    let directions = pile.dimension().directions();
    let (mut layers, places) = (units.layers::<F>(selection)?, units.places::<F>());
    let rows = pile.rows(selection)?.off_the_floor();
    let rows = in_pieces(rows, move |row| {
        let mut forces = columns::<F>(row)?;
        layers.fill_row(row, slices(&mut forces))?;
        let mut numbers = vec![forces];
        if let Some(places) = &places {
            let mut vectors = [columns::<F>(row)?, columns(row)?, columns(row)?];
            layers.fill_row_of_vectors(row, vectors.each_mut().map(slices))?;
            numbers.extend(vectors);
            let mut points = [columns::<F>(row)?, columns(row)?, columns(row)?];
            let [x, y, z] = points.each_mut().map(slices);
            let by_direction = x.into_iter().zip(y).zip(z).zip(directions);
            for (((x, y), z), direction) in by_direction {
                places.fill_row_of_contacts(row, *direction, [x, y, z])?;
            }
            numbers.extend(points);
        }
        let mut rows = Vec::new();
        for (place, site) in row.clone().into_iter().enumerate() {
            for direction in directions {
                let mut cells = contact_cells(pile, site, *direction);
                let numbers = numbers
                    .iter()
                    .map(|column| column[direction.index()][place]);
                cells.extend(numbers.map(Into::into));
                rows.push(cells);
            }
        }
        Ok(rows)
    });
    Ok(Box::new(rows))
}

/// The question that has fewer answers, unless it is the narrowest.
pub(crate) fn narrower(selection: Selection) -> &'static str {
    match selection {
        Selection::Layer(_) | Selection::Base => "ask for one sphere",
        _ => "ask for one layer or one sphere",
    }
}

/// A row that no row of the table exceeds, for the columns that hold forces and places.
fn bounds(columns: &[Column], units: &Units<'_>, selection: Selection) -> Result<Vec<Cell>, Error> {
    // The rows of one sphere are few enough to be looked at themselves.
    if let Selection::One(_) = selection {
        return Ok(Vec::new());
    }
    let force = units.greatest_force(selection)?;
    let bound = |column: &Column| match (column.unit, units) {
        ("", _) => Cell::Missing,
        ("m", Units::Si(packing)) => greatest_place(packing).into(),
        _ => force.clone().into(),
    };
    Ok(columns.iter().map(bound).collect())
}

/// A length that no coordinate of a centre exceeds: from the origin on it takes as many steps of 2R as layers, and as
/// i and j of the base count.
fn greatest_place(packing: &Packing<'_>) -> BigRational {
    let shape = packing.pile().shape();
    let corners = shape.base().corners();
    let farthest = corners.iter().flatten().map(|x| x.unsigned_abs()).max();
    let steps = BigUint::from(farthest.unwrap_or(0)) * 2_u32
        + BigUint::from(shape.layers().unsigned_abs()) * 3_u32;
    packing.radius() * BigRational::from(BigInt::from(steps * 2_u32))
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
    let count = rows.site_count();
    refuse_beyond(&count, narrower(selection))?;
    let mut columns = indices(pile, &["id", "k"]);
    columns.extend(["x", "y", "z", "radius"].map(|name| Column::measured(name, "m")));
    columns.push(Column::summed("mass", "kg"));
    columns.push(Column::plain("fixed"));
    let bound = |column: &Column| match column.unit {
        "m" => greatest_place(packing).into(),
        "kg" => greatest_mass(packing).into(),
        _ => Cell::Missing,
    };
    let bounds = columns.iter().map(bound).collect();
    // Rows follow each other, and so do numbers.
    let first = match rows.clone().flatten().next() {
        Some(site) => BigInt::from(pile.shape().before(site)?) + 1,
        None => BigInt::one(),
    };
    let ids = core::iter::successors(Some(first), |id| Some(id + 1));
    let made = packing.clone();
    let rows = move |numbers| -> Result<RowIter<'p>, Error> {
        Ok(match rounding(numbers, selection) {
            Some(Rounding::F64) => rounded_spheres::<f64>(made, selection, ids)?,
            Some(Rounding::F32) => rounded_spheres::<f32>(made, selection, ids)?,
            None => Box::new(ids.zip(rows.flatten()).map(move |(id, site)| {
                sphere_cells(&made, (id, site), made.position(site)?.map(Cell::from))
            })),
        })
    };
    let summed = packing.clone();
    let sums = move || {
        Ok(vec![
            (weight_of(summed.pile(), selection)? * summed.mass()).into(),
        ])
    };
    let table = Table::made_for(columns, "spheres", rows);
    Ok(table.bounded(count, bounds).summed(sums))
}

fn rounded_spheres<'p, F: Float>(
    packing: Packing<'p>,
    selection: Selection,
    mut ids: impl Iterator<Item = BigInt> + 'p,
) -> Result<RowIter<'p>, Error> {
    let centres = packing.places::<F>();
    let rows = in_pieces(packing.pile().rows(selection)?, move |row| {
        let mut places = columns::<F>(row)?;
        centres.fill_row(row, slices(&mut places))?;
        let [x, y, z] = places;
        // Sites first: no number is drawn for one past the end.
        let spheres = row.clone().into_iter().zip(ids.by_ref());
        let rows = spheres.zip(x.into_iter().zip(y).zip(z));
        let rows = rows.map(|((site, id), ((x, y), z))| {
            sphere_cells(&packing, (id, site), [x, y, z].map(Into::into))
        });
        rows.collect()
    });
    Ok(Box::new(rows))
}

/// The cells of a sphere.
fn sphere_cells(packing: &Packing<'_>, (id, site): (BigInt, Site), centre: [Cell; 3]) -> Row {
    let pile = packing.pile();
    let mut cells = vec![Cell::Integer(id), site.k.into()];
    cells.extend(places(pile, site));
    cells.extend(centre);
    cells.push(packing.radius().clone().into());
    cells.push(packing.mass_of(site)?.into());
    cells.push(Cell::Flag(site.k + 1 == pile.layers()));
    Ok(cells)
}

/// The mass of the heaviest sphere, or more.
fn greatest_mass(packing: &Packing<'_>) -> BigRational {
    let special = packing.pile().weights().map(|(_, weight)| weight);
    let greatest = special.fold(BigRational::one(), |most, weight| most.max(weight.clone()));
    greatest * packing.mass()
}

/// The weight of the spheres of a part without their loads, in mg.
fn weight_of(pile: &Pile, selection: Selection) -> Result<BigRational, Error> {
    let ordinary = if pile.is_weightless() {
        BigRational::zero()
    } else {
        BigRational::one()
    };
    let spheres = BigInt::from(pile.rows(selection)?.site_count());
    let floor = pile.layers() - 1;
    let selected = |site: Site| match selection {
        Selection::All => true,
        Selection::Base => site.k == floor,
        Selection::Layer(k) => site.k == k,
        Selection::One(one) => site == one,
    };
    let special = pile.weights().filter(|(site, _)| selected(*site));
    let extra = special.map(|(_, weight)| weight - &ordinary);
    Ok(extra.sum::<BigRational>() + &ordinary * spheres)
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
    Table::of_rows(columns.into(), "theorems", proved.map(row))
}

/// The most layers of a stacking with a change of sign whose normal forces a census has.
const MOST_LAYERS: i128 = 100_000;

/// Stackings and whether they stand, one a row: `stacking, layers, stands, min_contact, base_spheres, normal_min,
/// normal_max`, and where the least contact is, `k, i, j, direction`.
///
/// The normal forces of those that do not stand are left out, and those of more than 100,000 layers where the sign
/// changes, as every row of the base would be looked at.
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
            None if pile.layers() > MOST_LAYERS && pile.shape().stacking().changes() > 0 => None,
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
    Table::of_rows(columns, "stackings", entries.map(row))
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
fn places(pile: &Pile, site: Site) -> impl Iterator<Item = Cell> + use<> {
    let j = (pile.dimension() == Dimension::Three).then_some(site.j);
    core::iter::once(site.i).chain(j).map(Cell::from)
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
