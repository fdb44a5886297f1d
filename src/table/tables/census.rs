//! Stackings, and whether they stand.

use crate::census::Entry;
use crate::table::cell::Cell;
use crate::table::rows::{Column, Row, Table};
use crate::table::summary::steps;
use crate::{ContactForce, Error};

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
