//! The table of bounds of base normal forces, at a = R.

use cannonpile::Pile;
use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile_dem::table::{Cell, Column, Table, indices, places, refuse_beyond};
use cannonpile_horizontal::{NormalBounds, base_bounds};

use crate::Error;

/// Returns the smallest and largest normal force of each bottom sphere, in mg, with horizontal contacts at a = R.
///
/// The columns are `i, j, normal_min, normal_max, proved`. If both bounds are attained, `proved` is `yes`. Otherwise they are
/// certified outer bounds.
///
/// # Errors
/// Those of [`base_bounds`]; [`TooManyRows`](cannonpile::Error::TooManyRows).
pub(crate) fn bounds(pile: &Pile, selection: Selection) -> Result<Table<'_>, Error> {
    let rows = pile.rows(selection)?;
    refuse_beyond(&rows.site_count(), "ask for one sphere")?;
    Ok(bounds_of(pile, base_bounds(pile, selection)?))
}

/// Returns the table of [`bounds`] for computed bounds.
pub(crate) fn bounds_of<'p>(
    pile: &'p Pile,
    bounds: impl Iterator<Item = Result<(Site, NormalBounds), cannonpile_horizontal::Error>> + 'p,
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

#[cfg(test)]
mod tests {
    use super::super::test::csv;
    use super::*;

    #[test]
    fn bounds_of_three_layers() {
        let pile = Pile::triangular(3).unwrap();
        let csv = csv(bounds(&pile, Selection::Base).unwrap());
        assert!(
            csv.starts_with("i,j,normal_min,normal_max,proved\n0,0,5/3,7/3,yes\n1,0,1,5/3,yes\n")
        );
    }

    #[test]
    fn bounds_of_one_sphere() {
        let (pile, site) = (Pile::triangular(3).unwrap(), Site { i: 0, j: 0, k: 2 });
        let found = cannonpile_horizontal::bounds(&pile, site).unwrap();
        let table = bounds_of(&pile, [Ok((site, found))].into_iter());
        assert_eq!(csv(table).lines().nth(1), Some("0,0,5/3,7/3,yes"));
    }
}
