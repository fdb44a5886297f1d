//! The forces of bottom spheres on the floor.

use super::{Float, Rounding, bounds, indices, places, refuse_beyond, rounding};
use crate::Error;
use crate::table::cell::Cell;
use crate::table::pieces::{columns, in_pieces, slices};
use crate::table::rows::{Column, RowIter, Table, boxed};
use crate::table::units::Units;
use cannonpile::lattice::{Dimension, Site};
use cannonpile::shape::Selection;
use cannonpile::{FloorForce, Pile};

/// Returns the table of the forces of bottom spheres on the floor: `i, j, normal, shear_x, shear_y`; for discs `i,
/// normal, shear_x`.
///
/// # Errors
/// [`Error::SiteOutside`](cannonpile::Error::SiteOutside), [`Error::LayerOutside`](cannonpile::Error::LayerOutside) and
/// [`Error::NotOnFloor`](cannonpile::Error::NotOnFloor) for a selection outside the base;
/// [`Error::TooManyRows`](cannonpile::Error::TooManyRows).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_dem::table;
/// use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
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
        return Err(cannonpile::Error::NotOnFloor { site, floor }.into());
    }
    let mut columns = indices(pile, &[]);
    columns.push(Column::summed("normal", units.normal()));
    columns.push(Column::summed("shear_x", units.shear_x()));
    if pile.dimension() == Dimension::Three {
        columns.push(Column::summed("shear_y", units.shear_y()));
    }
    let (count, bounds) = (rows.site_count(), bounds(&columns, units, selection));
    let made = units.clone();
    let rows = move |numbers| {
        Ok(match rounding(numbers, selection) {
            Some(Rounding::F64) => rounded_base::<f64>(&made, selection)?,
            Some(Rounding::F32) => rounded_base::<f32>(&made, selection)?,
            None => {
                let forces = made.forces().base(selection)?;
                boxed(forces.map(move |force| Ok(floor_cells(pile, made.on_floor(force?)))))
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

/// Returns the cells of a bottom sphere.
pub(super) fn floor_cells<F: Into<Cell>>(pile: &Pile, force: FloorForce<F>) -> Vec<Cell> {
    let mut cells = Vec::with_capacity(5);
    cells.extend(places(pile, force.site));
    cells.extend([force.normal.into(), force.shear_x.into()]);
    if pile.dimension() == Dimension::Three {
        cells.push(force.shear_y.into());
    }
    cells
}

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
    Ok(boxed(rows))
}
