//! The table of the response to a unit load.

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{Forces, Load, Pile};
use cannonpile_dem::table::{Cell, Column, Table, indices, places, refuse_beyond};
use num_rational::BigRational;

use crate::Error;

/// Returns a row for each contact, and two or three rows for each bottom sphere: `k, i, j, direction, down, x, y`.
///
/// The last columns are the forces per unit of each component of a load on the sphere at `site`. A row of a contact has
/// its direction, in multiples of f₀. The rows of a bottom sphere have the directions `normal`, `shear_x` and `shear_y`, in
/// multiples of mg, mg·tanθ and 2cosφ·mg·tanθ. Discs have no `j`, `y` and `shear_y`.
///
/// `pile` must be [bare](Pile::bare), as weights and other loads would add to all forces.
///
/// # Errors
/// [`TooManyRows`](cannonpile::Error::TooManyRows); those of the computation of forces.
pub(crate) fn response(pile: &Pile, site: Site) -> Result<Table<'_>, Error> {
    let axes = pile.dimension().directions().len();
    let count = (pile.contact_count() + pile.base_sphere_count() * axes) as num_bigint::BigUint;
    refuse_beyond(&count, "use fewer layers, or a smaller top or base")?;
    let responses = Load::units()
        .into_iter()
        .take(axes)
        .map(|load| Ok(pile.forces().with_load(site, load)?));
    let responses: Vec<Forces<'_, BigRational>> = responses.collect::<Result<_, Error>>()?;
    let mut columns = indices(pile, &["k"]);
    columns.push(Column::plain("direction"));
    let names = ["down", "x", "y"].into_iter().take(axes);
    columns.extend(names.map(|name| Column::measured(name, "")));
    let contacts = responses
        .iter()
        .map(|forces| forces.contacts(Selection::All));
    let contacts = side_by_side(contacts.collect::<Result<_, _>>()?);
    let of_contacts = contacts.map(|contacts| {
        let contacts = contacts?;
        let name = contacts
            .first()
            .map(|first| (first.site, first.direction.name()));
        Ok(row(
            pile,
            name,
            contacts.into_iter().map(|contact| contact.force),
        ))
    });
    let names = ["normal", "shear_x", "shear_y"].into_iter().take(axes);
    let floor = responses.iter().map(|forces| forces.base(Selection::Base));
    let floor = side_by_side(floor.collect::<Result<_, _>>()?);
    let of_floor = floor.flat_map(move |spheres| match spheres {
        Err(error) => vec![Err(error.into())],
        Ok(spheres) => {
            let part = |(n, name): (usize, &'static str)| {
                let name = spheres.first().map(|first| (first.site, name));
                let parts = spheres.iter().map(|force| {
                    let parts = [&force.normal, &force.shear_x, &force.shear_y];
                    parts[n].clone()
                });
                Ok(row(pile, name, parts))
            };
            names.clone().enumerate().map(part).collect()
        }
    });
    let rows = of_contacts.chain(of_floor);
    Ok(Table::of_rows(columns, "rows", rows).bounded(count, Vec::new()))
}

/// Returns the answers to all loads, side by side.
fn side_by_side<A, I: Iterator<Item = Result<A, cannonpile::Error>>>(
    mut answers: Vec<I>,
) -> impl Iterator<Item = Result<Vec<A>, cannonpile::Error>> {
    std::iter::from_fn(move || {
        let of_all: Option<Vec<_>> = answers.iter_mut().map(Iterator::next).collect();
        Some(of_all?.into_iter().collect())
    })
}

/// Returns the cells of a site and a direction, with the forces of all loads.
fn row(
    pile: &Pile,
    name: Option<(Site, &'static str)>,
    forces: impl Iterator<Item = BigRational>,
) -> Vec<Cell> {
    let mut cells = Vec::with_capacity(7);
    if let Some((site, direction)) = name {
        cells.push(site.k.into());
        cells.extend(places(pile, site));
        cells.push(direction.into());
    }
    cells.extend(forces.map(Cell::from));
    cells
}

#[cfg(test)]
mod tests {
    use super::super::test::csv;
    use super::*;

    /// On its three supports, a sphere has the increments of a load as contact forces.
    #[test]
    fn the_response_of_one_sphere() {
        let pile = Pile::triangular(2).unwrap().bare();
        let csv = csv(response(&pile, Site::APEX).unwrap());
        let head = "k,i,j,direction,down,x,y\n\
                    0,0,0,alpha,1,-1,-3\n0,0,0,beta,1,-1,3\n0,0,0,gamma,1,2,0\n\
                    1,0,0,normal,1/3,-1/3,-1\n";
        assert!(csv.starts_with(head), "{csv}");
        assert_eq!(csv.lines().count(), 1 + 3 + 9);
    }

    #[test]
    fn the_response_of_discs_and_of_a_bottom_sphere() {
        let pile = Pile::discs(2).unwrap().bare();
        let discs = csv(response(&pile, Site::APEX).unwrap());
        assert!(
            discs.starts_with("k,i,direction,down,x\n0,0,alpha,1,-1\n0,0,beta,1,1\n"),
            "{discs}"
        );
        let pile = Pile::triangular(2).unwrap().bare();
        let bottom = csv(response(&pile, Site { i: 0, j: 1, k: 1 }).unwrap());
        let end = "1,0,1,normal,1,0,0\n1,0,1,shear_x,0,1,0\n1,0,1,shear_y,0,0,1\n";
        assert!(
            bottom.ends_with(end) && bottom.contains("0,0,0,alpha,0,0,0\n"),
            "{bottom}"
        );
    }
}
