//! The table of the response to a unit load.

use cannonpile::lattice::{Dimension, Site};
use cannonpile::shape::Selection;
use cannonpile::{FloorForce, Forces, Load, Pile};
use cannonpile_dem::table::{Cell, Column, Row, Table, indices, places, refuse_beyond};
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
    let of_contacts = contacts(pile, &responses)?;
    let rows = of_contacts.chain(floor(pile, &responses)?);
    Ok(Table::of_rows(columns, "rows", rows).bounded(count, Vec::new()))
}

fn contacts<'p>(
    pile: &'p Pile,
    responses: &[Forces<'p, BigRational>],
) -> Result<impl Iterator<Item = Row> + use<'p>, Error> {
    let answers = responses
        .iter()
        .map(|forces| forces.contacts(Selection::All));
    let mut answers: Vec<_> = answers.collect::<Result<_, _>>()?;
    Ok(std::iter::from_fn(move || {
        let forces: Option<Vec<_>> = answers.iter_mut().map(Iterator::next).collect();
        let forces: Result<Vec<_>, _> = forces?.into_iter().collect();
        Some(forces.map_err(Into::into).map(|forces| {
            let mut cells = Vec::with_capacity(7);
            if let Some(contact) = forces.first() {
                cells.extend(site_cells(pile, contact.site, contact.direction.name()));
            }
            cells.extend(forces.into_iter().map(|contact| Cell::from(contact.force)));
            cells
        }))
    }))
}

fn floor<'p>(
    pile: &'p Pile,
    responses: &[Forces<'p, BigRational>],
) -> Result<impl Iterator<Item = Row> + use<'p>, Error> {
    let answers = responses.iter().map(|forces| forces.base(Selection::Base));
    let mut answers: Vec<_> = answers.collect::<Result<_, _>>()?;
    let next = move || -> Option<Result<Vec<FloorForce<BigRational>>, cannonpile::Error>> {
        let forces: Option<Vec<_>> = answers.iter_mut().map(Iterator::next).collect();
        Some(forces?.into_iter().collect())
    };
    let names: &[&'static str] = match pile.dimension() {
        Dimension::Two => &["normal", "shear_x"],
        Dimension::Three => &["normal", "shear_x", "shear_y"],
    };
    let spheres = std::iter::from_fn(next);
    Ok(spheres.flat_map(move |forces| {
        let forces = match forces {
            Ok(forces) => forces,
            Err(error) => return vec![Err(error.into())],
        };
        let rows = names.iter().enumerate().map(|(n, name)| {
            let mut cells = Vec::with_capacity(7);
            if let Some(force) = forces.first() {
                cells.extend(site_cells(pile, force.site, name));
            }
            cells.extend(forces.iter().map(|force| {
                let parts = [&force.normal, &force.shear_x, &force.shear_y];
                Cell::from(parts[n].clone())
            }));
            Ok(cells)
        });
        rows.collect()
    }))
}

/// Returns the cells of a site and a direction.
fn site_cells(
    pile: &Pile,
    site: Site,
    direction: &'static str,
) -> impl Iterator<Item = Cell> + use<> {
    let site = std::iter::once(Cell::from(site.k)).chain(places(pile, site));
    site.chain(std::iter::once(direction.into()))
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
