//! Stackings, and whether they stand.

use cannonpile::census::Entry;
use cannonpile::{ContactForce, Error, Pile, Standing, Verdict};
use cannonpile_dem::table::{Cell, Column, Row, Table, steps};
use cannonpile_horizontal::census as horizontal;

/// The most layers of a stacking with a change of sign whose normal forces a census has.
const MOST_LAYERS: i128 = 100_000;

/// Stackings and whether they stand, one a row: `stacking, layers, stands, min_contact, base_spheres, normal_min,
/// normal_max`, and where the least contact is, `k, i, j, direction`.
///
/// The normal forces of those that do not stand are left out, and those of more than 100,000 layers where the sign
/// changes, as every row of the base would be looked at.
pub(crate) fn census<'t>(entries: impl Iterator<Item = Result<Entry, Error>> + 't) -> Table<'t> {
    let row = |entry: Result<Entry, Error>| -> Row {
        let Entry { pile, standing, .. } = entry?;
        let mut cells = judged(&pile, standing.verdict(&[]));
        cells.extend(without_horizontal_contacts(&pile, Some(&standing))?);
        Ok(cells)
    };
    Table::of_rows(columns(&[]), "stackings", entries.map(row))
}

/// Stackings and whether they stand at a = R, one a row: as [`census`], and `decided_by`, the
/// [reason](cannonpile_horizontal::census::DecidedBy), after `stands`.
///
/// All columns after `decided_by` are of the forces without horizontal contacts; the least is left out where it would take
/// too long to find.
pub(crate) fn horizontal_census<'t>(
    entries: impl Iterator<Item = Result<horizontal::Entry, cannonpile_horizontal::Error>> + 't,
) -> Table<'t> {
    let row = |entry: Result<horizontal::Entry, cannonpile_horizontal::Error>| -> Row {
        let entry = entry?;
        let verdict = if entry.stands() {
            Verdict::Yes
        } else {
            Verdict::No
        };
        let mut cells = judged(&entry.pile, verdict);
        cells.push(entry.decided_by.name().into());
        let standing = match entry.pile.standing() {
            Err(Error::TooLarge { .. }) => None,
            standing => Some(standing?),
        };
        cells.extend(without_horizontal_contacts(&entry.pile, standing.as_ref())?);
        Ok(cells)
    };
    Table::of_rows(columns(&["decided_by"]), "stackings", entries.map(row))
}

/// The columns of a census; `more` after the verdict.
fn columns(more: &[&'static str]) -> Vec<Column> {
    let names = ["stacking", "layers", "stands"].iter().chain(more);
    let mut columns: Vec<Column> = names.map(|name| Column::plain(name)).collect();
    columns.push(Column::measured("min_contact", "mg/(3cosθ)"));
    columns.push(Column::plain("base_spheres"));
    columns.extend(["normal_min", "normal_max"].map(|name| Column::measured(name, "mg")));
    columns.extend(["k", "i", "j", "direction"].map(Column::plain));
    columns
}

fn judged(pile: &Pile, verdict: Verdict) -> Vec<Cell> {
    vec![
        Cell::Word(steps(pile).into()),
        pile.layers().into(),
        verdict.name().into(),
    ]
}

/// The cells after the verdict; of the forces as far as they are known.
fn without_horizontal_contacts(
    pile: &Pile,
    standing: Option<&Standing>,
) -> Result<Vec<Cell>, Error> {
    let least = standing.and_then(|standing| standing.least.as_ref());
    let mut cells = vec![least.map_or(Cell::Missing, |least| least.force.clone().into())];
    cells.push(Cell::Integer(pile.base_sphere_count().into()));
    let stands = standing.is_some_and(|standing| standing.first_failure.is_none());
    let is_tall = pile.layers() > MOST_LAYERS && pile.shape().stacking().changes() > 0;
    let base = if stands && !is_tall {
        match pile.base_extremes() {
            Err(Error::TooLarge { .. }) => None,
            base => Some(base?),
        }
    } else {
        None
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
}

#[cfg(test)]
mod tests {
    use super::super::test::csv;
    use super::*;

    #[test]
    fn the_census_of_three_layers() {
        let found = cannonpile::census::under_one_sphere(3, false).unwrap();
        assert_eq!(
            csv(census(found)),
            "stacking,layers,stands,min_contact,base_spheres,normal_min,normal_max,k,i,j,direction\n\
             ++,3,yes,1,6,5/3,5/3,0,0,0,alpha\n+-,3,yes,2/3,7,14/9,5/3,1,0,0,alpha\n",
        );
    }

    #[test]
    fn horizontal_contacts_hold_what_pulls() {
        let found = horizontal::under_one_sphere(6, false).unwrap();
        let csv = csv(horizontal_census(found));
        assert!(csv.contains("\n+-+-+,6,yes,horizontal,-22/81,27,,,4,1,-2,gamma\n"));
    }
}
