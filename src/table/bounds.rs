//! What bottom spheres can bear at a = R.

use super::cell::Cell;
use super::rows::{Column, Table};
use super::tables::{indices, places, refuse_beyond};
use crate::horizontal::NormalBounds;
use crate::lattice::Site;
use crate::shape::Selection;
use crate::{Error, Pile};

/// The least and the greatest normal force of bottom spheres at a = R, horizontal contacts included: `i, j, normal_min,
/// normal_max, proved`.
///
/// `proved` says that both are attained; else they are bounds that no forces pass.
///
/// # Errors
/// Those of [`Pile::base_bounds`]; [`Error::TooManyRows`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
/// use cannonpile::table::{self, FileFormat, NumberFormat};
///
/// let (pile, mut csv) = (Pile::triangular(3)?, Vec::new());
/// table::bounds(&pile, Selection::Base)?.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// let csv = String::from_utf8(csv)?;
/// assert!(csv.starts_with("i,j,normal_min,normal_max,proved\n0,0,5/3,7/3,yes\n1,0,1,5/3,yes\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bounds(pile: &Pile, selection: Selection) -> Result<Table<'_>, Error> {
    let rows = pile.rows(selection)?;
    refuse_beyond(&rows.site_count(), "ask for one sphere")?;
    Ok(bounds_of(pile, pile.base_bounds(selection)?))
}

/// The table of [`bounds`] that are found already.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
/// use cannonpile::table;
///
/// let (pile, site) = (Pile::triangular(3)?, Site { i: 0, j: 0, k: 2 });
/// let found = pile.bounds(site)?;
/// let table = table::bounds_of(&pile, [Ok((site, found))].into_iter());
/// assert_eq!(table.columns()[4].name, "proved");
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn bounds_of<'p>(
    pile: &'p Pile,
    bounds: impl Iterator<Item = Result<(Site, NormalBounds), Error>> + 'p,
) -> Table<'p> {
    let mut columns = indices(pile, &[]);
    columns.extend(["normal_min", "normal_max"].map(|name| Column::measured(name, "mg")));
    columns.push(Column::plain("proved"));
    let rows = bounds.map(|found| {
        let (site, bounds) = found?;
        let proved = bounds.least.attained && bounds.greatest.attained;
        let mut cells: Vec<Cell> = places(pile, site).collect();
        cells.push(bounds.least.normal.into());
        cells.push(bounds.greatest.normal.into());
        cells.push(if proved { "yes" } else { "no" }.into());
        Ok(cells)
    });
    Table::of_rows(columns, "bottom spheres", rows)
}
