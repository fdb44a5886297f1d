//! The table of spheres.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Float, Rounding, greatest_place, indices, narrower, places, refuse_beyond, rounding};
use crate::Error;
use crate::table::cell::Cell;
use crate::table::pieces::{columns, in_pieces, slices};
use crate::table::rows::{Column, Row, RowIter, Table};
use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{Packing, Pile};

/// Returns the table of spheres, in SI units: `id, k, i, j, x, y, z, radius, mass, fixed`; for discs without `j`.
///
/// Numbers start from 1, row by row from the top. The bottom layer is fixed.
///
/// # Errors
/// [`Error::SiteOutside`](cannonpile::Error::SiteOutside), [`Error::LayerOutside`](cannonpile::Error::LayerOutside); [`Error::TooManyRows`](cannonpile::Error::TooManyRows).
///
/// # Examples
/// ```
/// use cannonpile_dem::table;
/// use cannonpile_dem::table::{FileFormat, NumberFormat};
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
    // Rows are consecutive, and so are sphere numbers.
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
        // Sites come first in the zip, so that the end of a row does not consume a sphere number.
        let spheres = row.clone().into_iter().zip(ids.by_ref());
        let rows = spheres.zip(x.into_iter().zip(y).zip(z));
        let rows = rows.map(|((site, id), ((x, y), z))| {
            sphere_cells(&packing, (id, site), [x, y, z].map(Into::into))
        });
        rows.collect()
    });
    Ok(Box::new(rows))
}

/// Returns the cells of a sphere.
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

/// Returns an upper bound of the masses of all spheres.
fn greatest_mass(packing: &Packing<'_>) -> BigRational {
    let special = packing.pile().weights().map(|(_, weight)| weight);
    let greatest = special.fold(BigRational::one(), |most, weight| most.max(weight.clone()));
    greatest * packing.mass()
}

/// Returns the weight of the spheres of a selection without their loads, in mg.
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
