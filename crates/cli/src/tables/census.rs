//! The tables of the census: stackings and their stability.

use cannonpile::{ContactForce, Error, Pile, Standing, Verdict};
use cannonpile_dem::table::{Cell, Column, Row, Table, steps};
use cannonpile_horizontal::census as horizontal;
use cannonpile_stability::census::Entry;

/// The largest number of layers of a stacking with a sign change for which a census computes base normal forces.
const MAX_CHECKED_LAYERS: i128 = 100_000;

/// Returns a row for each stacking: `stacking, layers, stands, min_contact, base_spheres, normal_min, normal_max`, and the
/// contact with the smallest force, `k, i, j, direction`. The last column is `margin_squared`, the squared margin of stable
/// stackings.
///
/// The normal forces are empty for unstable stackings. They are also empty for more than 100,000 layers with a sign change,
/// where every row of the base would have to be computed.
pub(crate) fn census<'t>(entries: impl Iterator<Item = Result<Entry, Error>> + 't) -> Table<'t> {
    let row = |entry: Result<Entry, Error>| -> Row {
        let Entry { pile, standing, .. } = entry?;
        let mut cells = judged(&pile, standing.verdict(&[]));
        cells.extend(without_horizontal_contacts(&pile, Some(&standing))?);
        cells.push(margin(&pile, Some(&standing))?);
        Ok(cells)
    };
    Table::of_rows(columns(&[]), "stackings", entries.map(row))
}

/// Returns a row for each stacking at a = R: the columns of [`census`], and after `stands` the
/// [reason](cannonpile_horizontal::census::DecidedBy), `decided_by`.
///
/// The columns after `decided_by` are without horizontal contacts. The smallest force is empty if it takes too long to
/// compute.
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
        cells.push(margin(&entry.pile, standing.as_ref())?);
        Ok(cells)
    };
    Table::of_rows(columns(&["decided_by"]), "stackings", entries.map(row))
}

/// Returns the columns of a census, with `more` after the verdict.
fn columns(more: &[&'static str]) -> Vec<Column> {
    let names = ["stacking", "layers", "stands"].iter().chain(more);
    let mut columns: Vec<Column> = names.map(|name| Column::plain(name)).collect();
    columns.push(Column::measured("min_contact", "mg/(3cosθ)"));
    columns.push(Column::plain("base_spheres"));
    columns.extend(["normal_min", "normal_max"].map(|name| Column::measured(name, "mg")));
    columns.extend(["k", "i", "j", "direction"].map(Column::plain));
    columns.push(Column::measured("margin_squared", "tan²θ"));
    columns
}

fn judged(pile: &Pile, verdict: Verdict) -> Vec<Cell> {
    vec![
        Cell::Word(steps(pile).into()),
        pile.layers().into(),
        verdict.name().into(),
    ]
}

/// Returns the squared margin of a pile without horizontal contacts. It is empty for an unstable pile, for a single layer,
/// and where it takes too long to compute.
fn margin(pile: &Pile, standing: Option<&Standing>) -> Result<Cell, Error> {
    use cannonpile_stability::Error::Core;

    if standing.is_none_or(|standing| standing.first_failure.is_some()) {
        return Ok(Cell::Missing);
    }
    match cannonpile_stability::margin(pile) {
        Ok(margin) => Ok(margin.map_or(Cell::Missing, |margin| margin.squared.into())),
        Err(Core(error)) if !matches!(error, Error::TooLarge { .. }) => Err(error),
        Err(_) => Ok(Cell::Missing),
    }
}

/// Returns the cells after the verdict. Forces that were not computed are empty.
fn without_horizontal_contacts(
    pile: &Pile,
    standing: Option<&Standing>,
) -> Result<Vec<Cell>, Error> {
    let least = standing.and_then(|standing| standing.least.as_ref());
    let mut cells = vec![least.map_or(Cell::Missing, |least| least.force.clone().into())];
    cells.push(Cell::Integer(pile.base_sphere_count().into()));
    let stands = standing.is_some_and(|standing| standing.first_failure.is_none());
    let is_tall = pile.layers() > MAX_CHECKED_LAYERS && pile.shape().stacking().changes() > 0;
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
    fn census_of_three_layers() {
        let found = cannonpile_stability::census::under_one_sphere(3, false).unwrap();
        assert_eq!(
            csv(census(found)),
            "stacking,layers,stands,min_contact,base_spheres,normal_min,normal_max,k,i,j,direction,\
             margin_squared_over_tan2_theta\n\
             ++,3,yes,1,6,5/3,5/3,0,0,0,alpha,1/4\n+-,3,yes,2/3,7,14/9,5/3,1,0,0,alpha,1/16\n",
        );
    }

    #[test]
    fn horizontal_contacts_stabilise_hcp() {
        let found = horizontal::under_one_sphere(6, false).unwrap();
        let csv = csv(horizontal_census(found));
        assert!(csv.contains("\n+-+-+,6,yes,horizontal,-22/81,27,,,4,1,-2,gamma,\n"));
    }
}
