//! The table of spheres.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Float, Rounding, greatest_place, indices, narrower, places, refuse_beyond, rounding};
use crate::table::cell::Cell;
use crate::table::pieces::{columns, in_pieces, slices};
use crate::table::rows::{Column, Row, RowIter, Table, boxed};
use crate::table::units::Units;
use crate::{Each, Error};
use cannonpile::lattice::{Dimension, Site};
use cannonpile::scalar::ByValue;
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
    table(packing, None, selection)
}

/// Returns the table of [`spheres`] with the stress of each sphere times its volume: `stress_xx, stress_yy, stress_zz,
/// stress_xy, stress_xz, stress_yz`; for discs `stress_xx, stress_zz, stress_xz`.
///
/// [`Forces::stress`](cannonpile::Forces::stress) defines the stress and its pile units. If `in_si` is true, the stress times
/// the volume is in N·m.
///
/// # Errors
/// As for [`spheres`]; [`Error::TooLarge`](cannonpile::Error::TooLarge) as for
/// [`Forces::stresses`](cannonpile::Forces::stresses).
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
/// use cannonpile::{Packing, Pile};
/// use cannonpile_dem::table;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// let table = table::spheres_with_stress(&packing, false, Selection::All)?;
/// let zz = &table.columns()[12];
/// assert_eq!((zz.name, zz.unit), ("stress_zz", "mgR·cosθ"));
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
pub fn spheres_with_stress<'p>(
    packing: &Packing<'p>,
    in_si: bool,
    selection: Selection,
) -> Result<Table<'p>, Error> {
    let units = if in_si {
        Units::of_packing(packing.clone())
    } else {
        Units::Pile(Box::new(packing.forces().clone()))
    };
    table(packing, Some(units), selection)
}

/// Returns the table of spheres, with the stress in the given units.
fn table<'p>(
    packing: &Packing<'p>,
    stress: Option<Units<'p>>,
    selection: Selection,
) -> Result<Table<'p>, Error> {
    let pile = packing.pile();
    let rows = pile.rows(selection)?;
    let count = rows.site_count();
    refuse_beyond(&count, narrower(selection))?;
    let mut columns = indices(pile, &["id", "k"]);
    columns.extend(["x", "y", "z", "radius"].map(|name| Column::measured(name, "m")));
    columns.push(Column::summed("mass", "kg"));
    columns.push(Column::plain("fixed"));
    let mut greatest_stress = Cell::Missing;
    if let Some(units) = &stress {
        columns.extend(in_dimension(pile, units.stress_columns()));
        greatest_stress = units.greatest_stress().into();
    }
    let bound = |column: &Column| match column.unit {
        "m" => greatest_place(packing).into(),
        "kg" => greatest_mass(packing).into(),
        "" => Cell::Missing,
        _ => greatest_stress.clone(),
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
        let sites = rows.flatten();
        let exact = |made: Packing<'p>| {
            ids.clone().zip(sites).map(move |numbered| {
                let centre = made.position(numbered.1)?.each(Cell::from);
                sphere_cells(&made, numbered, centre)
            })
        };
        Ok(match (stress, rounding(numbers, selection)) {
            (Some(units), _) => {
                let stresses = units.forces().stresses(selection)?;
                boxed(exact(made).zip(stresses).map(move |(cells, stress)| {
                    let (mut cells, stress) = (cells?, units.stress(stress?));
                    cells.extend(in_dimension(pile, stress.map(Cell::from)));
                    Ok(cells)
                }))
            }
            (None, Some(Rounding::F64)) => rounded_spheres::<f64>(made, selection, ids)?,
            (None, Some(Rounding::F32)) => rounded_spheres::<f32>(made, selection, ids)?,
            (None, None) => boxed(exact(made)),
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
            sphere_cells(&packing, (id, site), [x, y, z].each(Into::into))
        });
        rows.collect()
    });
    Ok(boxed(rows))
}

/// Returns the components of a tensor that a pile has: all six, or xx, zz and xz of discs.
pub(crate) fn in_dimension<C>(pile: &Pile, [xx, yy, zz, xy, xz, yz]: [C; 6]) -> Vec<C> {
    match pile.dimension() {
        Dimension::Two => vec![xx, zz, xz],
        Dimension::Three => vec![xx, yy, zz, xy, xz, yz],
    }
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
    let special = packing.pile().weights().map(|(_, weight)| ByValue(weight));
    let one = BigRational::one();
    special.fold(ByValue(&one), Ord::max).0 * packing.mass()
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
