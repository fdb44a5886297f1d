//! The contacts between spheres.

use num_rational::BigRational;

use super::{Float, Rounding, bounds, indices, narrower, places, refuse_beyond, rounding};
use crate::lattice::{Direction, Site};
use crate::shape::Selection;
use crate::table::cell::Cell;
use crate::table::pieces::{columns, in_pieces, slices};
use crate::table::rows::{Column, RowIter, Table};
use crate::table::units::Units;
use crate::{Contacts, Error, Pile};

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
