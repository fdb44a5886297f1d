//! The contacts between spheres.

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::Zero;

use super::{Float, Rounding, bounds, indices, narrower, places, refuse_beyond, rounding};
use crate::table::cell::Cell;
use crate::table::pieces::{columns, in_pieces, slices};
use crate::table::rows::{Column, RowIter, Table, boxed};
use crate::table::units::Units;
use crate::{Each, Error};
use cannonpile::lattice::{ContactKind, HorizontalContact, Site};
use cannonpile::shape::{Rows, Selection};
use cannonpile::{Contacts, PackedContact, Pile};

/// Returns the table of the contacts between spheres: `k, i, j, direction, force`. In SI units the force on the upper
/// sphere `fx, fy, fz` and the contact point `x, y, z` follow. Discs have no `j`.
///
/// Horizontal contacts with a [given force](Pile::with_horizontal_force) follow the sloping contacts of the sphere that
/// names them. Their direction is their axis. In such a row, k, i and j are the site of the naming sphere.
///
/// # Errors
/// [`Error::SiteOutside`](cannonpile::Error::SiteOutside), [`Error::LayerOutside`](cannonpile::Error::LayerOutside); [`Error::TooManyRows`](cannonpile::Error::TooManyRows).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_dem::table;
/// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
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
    table(units, selection, Horizontal::Pushing)
}

/// Returns the table of [`contacts`] with all horizontal contacts off the floor, including those without a force.
///
/// # Errors
/// As for [`contacts`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_dem::table;
/// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(3)?;
/// let table = table::touching_contacts(&Units::of_pile(&pile), Selection::Layer(1))?;
/// let mut csv = Vec::new();
/// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert!(String::from_utf8(csv)?.contains("1,0,0,gamma,1\n1,0,0,alpha-beta,0\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn touching_contacts<'p>(units: &Units<'p>, selection: Selection) -> Result<Table<'p>, Error> {
    table(units, selection, Horizontal::Touching)
}

/// The horizontal contacts in a table.
#[derive(Clone, Copy, PartialEq)]
enum Horizontal {
    Pushing,
    Touching,
}

fn table<'p>(
    units: &Units<'p>,
    selection: Selection,
    listed: Horizontal,
) -> Result<Table<'p>, Error> {
    let pile = units.pile();
    let directions = pile.dimension().directions();
    let rows = pile.rows(selection)?.off_the_floor();
    let mut count = rows.site_count() * directions.len();
    refuse_beyond(&count, narrower(selection))?;
    count += listed.count(pile, &rows);
    refuse_beyond(&count, narrower(selection))?;
    let mut columns = indices(pile, &["k"]);
    columns.push(Column::plain("direction"));
    columns.push(Column::measured("force", units.force()));
    if let Units::Si(_) = units {
        columns.extend(["fx", "fy", "fz"].each(|name| Column::measured(name, "N")));
        columns.extend(["x", "y", "z"].each(|name| Column::measured(name, "m")));
    }
    let bounds = bounds(&columns, units, selection);
    let made = units.clone();
    let spheres = rows.flatten();
    let rows = move |numbers| {
        let sloping = match rounding(numbers, selection) {
            Some(Rounding::F64) => rounded_contacts::<f64>(&made, selection)?,
            Some(Rounding::F32) => rounded_contacts::<f32>(&made, selection)?,
            None => exact_contacts(&made, made.forces().contacts(selection)?),
        };
        if listed == Horizontal::Pushing && pile.horizontal_forces().len() == 0 {
            return Ok(sloping);
        }
        Ok(listed.after(sloping, spheres, made))
    };
    Ok(Table::made_for(columns, "contacts", rows).bounded(count, bounds))
}

/// Returns the first cells of a contact's row: site and direction.
pub(super) fn contact_cells(pile: &Pile, site: Site, direction: ContactKind) -> Vec<Cell> {
    let mut cells = Vec::with_capacity(11);
    cells.push(site.k.into());
    cells.extend(places(pile, site));
    cells.push(direction.name().into());
    cells
}

impl Horizontal {
    /// Returns the listed horizontal contacts of a sphere, with their forces.
    fn of(self, pile: &Pile, site: Site) -> impl Iterator<Item = (HorizontalContact, BigRational)> {
        let contacts = pile.shape().horizontal_contacts(site);
        let forces = contacts.map(|contact| (contact, pile.horizontal_force(contact)));
        forces.filter(move |(_, force)| self == Self::Touching || !force.is_zero())
    }

    /// Returns the number of listed horizontal contacts of the spheres of the given rows.
    fn count(self, pile: &Pile, rows: &Rows<'_>) -> BigUint {
        match (self, rows.one()) {
            (Self::Pushing, _) => pushing(pile, rows).count().into(),
            (Self::Touching, Some(site)) => self.of(pile, site).count().into(),
            (Self::Touching, None) => {
                let layers = rows.layers();
                layers.map(|k| pile.shape().horizontal_contacts_in(k)).sum()
            }
        }
    }

    /// Returns the rows of sloping contacts, with the rows of horizontal contacts after each sphere.
    fn after<'p>(
        self,
        sloping: RowIter<'p>,
        spheres: impl Iterator<Item = Site> + 'p,
        units: Units<'p>,
    ) -> RowIter<'p> {
        let pile = units.pile();
        let mut sloping = sloping;
        let directions = pile.dimension().directions().len();
        boxed(spheres.flat_map(move |site| {
            let own: Vec<_> = sloping.by_ref().take(directions).collect();
            let horizontal = self
                .of(pile, site)
                .map(|(contact, force)| row(&units, contact, force));
            own.into_iter().chain(horizontal.collect::<Vec<_>>())
        }))
    }
}

/// Returns the horizontal contacts with a force that are named by a sphere of the given rows.
fn pushing<'p>(
    pile: &'p Pile,
    rows: &Rows<'_>,
) -> impl Iterator<Item = (HorizontalContact, &'p BigRational)> + use<'p> {
    let (one, layers) = (rows.one(), rows.layers());
    pile.horizontal_forces()
        .filter(move |(contact, _)| match one {
            Some(one) => one == contact.site,
            None => layers.contains(&contact.site.k),
        })
}

/// Returns the exact row of a horizontal contact. Such contacts are few, so they are never rounded early.
fn row(
    units: &Units<'_>,
    contact: HorizontalContact,
    force: BigRational,
) -> Result<Vec<Cell>, Error> {
    let mut cells = contact_cells(units.pile(), contact.site, contact.axis.into());
    match units {
        Units::Pile(_) => cells.push(force.into()),
        Units::Si(packing) => {
            cells.extend(packed_cells(
                packing.horizontal_contact_in_si(contact, &force)?,
            ));
        }
    }
    Ok(cells)
}

/// Returns the cells of a contact in SI units.
fn packed_cells(contact: PackedContact) -> impl Iterator<Item = Cell> {
    let PackedContact {
        force,
        vector,
        point,
        ..
    } = contact;
    core::iter::once(force)
        .chain(vector)
        .chain(point)
        .map(Cell::from)
}

fn exact_contacts<'p>(units: &Units<'p>, forces: Contacts<'p, BigRational>) -> RowIter<'p> {
    let pile = units.pile();
    match units.clone() {
        Units::Pile(_) => boxed(forces.map(|contact| {
            let contact = contact?;
            let mut cells = contact_cells(pile, contact.site, contact.direction.into());
            cells.push(contact.force.into());
            Ok(cells)
        })),
        Units::Si(packing) => boxed(forces.map(move |contact| {
            let contact = packing.contact_in_si(contact?)?;
            let mut cells = contact_cells(pile, contact.site, contact.direction);
            cells.extend(packed_cells(contact));
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
            layers.fill_row_of_vectors(row, vectors.each_mut().each(slices))?;
            numbers.extend(vectors);
            let mut points = [columns::<F>(row)?, columns(row)?, columns(row)?];
            let [x, y, z] = points.each_mut().each(slices);
            let by_direction = x.into_iter().zip(y).zip(z).zip(directions);
            for (((x, y), z), direction) in by_direction {
                places.fill_row_of_contacts(row, *direction, [x, y, z])?;
            }
            numbers.extend(points);
        }
        let mut rows = Vec::new();
        for (place, site) in row.clone().into_iter().enumerate() {
            for direction in directions {
                let mut cells = contact_cells(pile, site, (*direction).into());
                let numbers = numbers
                    .iter()
                    .map(|column| column[direction.index()][place]);
                cells.extend(numbers.map(Into::into));
                rows.push(cells);
            }
        }
        Ok(rows)
    });
    Ok(boxed(rows))
}
