//! The answers about a whole pile agree with all forces of the oracle: the least force, the first failure, and the extremes
//! and sums of the base.

use arbitrary::Unstructured;
use cannonpile::shape::Selection;
use cannonpile::{BaseExtremes, Error, Forces, Standing};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::reference::{Contacts, Floor, Solved, contacts_of, floor_of, site_of};
use super::{Checked, same};
use crate::generators::number::ratio;
use crate::generators::region;

/// Checks a small pile of any stacking, with weights and loads.
pub fn of_all_forces(u: &mut Unstructured<'_>) -> Checked {
    let described = region::described(u)?;
    let solved = Solved::of(&described);
    let pile = described.pile()?;
    let (contacts, floor) = (contacts_of(&solved), floor_of(&solved));
    standing_agrees(&pile.standing()?, &contacts)?;
    same(
        "the first failure",
        &pile.first_failure()?,
        &first_failure(&contacts),
    )?;
    are_extremes(&pile.base_extremes()?, &floor)?;
    let forces = pile.forces();
    let k = u.int_in_range(0..=pile.layers() - 1)?;
    for part in [Selection::All, Selection::Base, Selection::Layer(k)] {
        let here = contacts.iter().filter(|contact| match part {
            Selection::Layer(k) => contact.site.k == k,
            Selection::Base => false,
            _ => true,
        });
        let sum: BigRational = here.map(|contact| &contact.force).sum();
        same("a sum of contacts", &forces.sum_of_contacts(part)?, &sum)?;
    }
    let sums = [
        floor.iter().map(|force| &force.normal).sum(),
        floor.iter().map(|force| &force.shear_x).sum(),
        floor.iter().map(|force| &force.shear_y).sum(),
    ];
    same(
        "the sums on the floor",
        &forces.sum_on_floor(Selection::Base)?,
        &sums,
    )?;
    let spheres: Vec<_> = solved.from_above.keys().copied().collect();
    to_below(&forces, &solved, *u.choose(&spheres)?)
}

/// The forces below one sphere. A bottom sphere transmits a force to the floor instead.
fn to_below(
    forces: &Forces<'_, BigRational>,
    solved: &Solved,
    sphere: super::reference::Sphere,
) -> Checked {
    let site = site_of(sphere);
    let one = Selection::One(site);
    let Some(transmitted) = solved.to_below.get(&sphere) else {
        let is_refused = matches!(forces.to_below(site), Err(Error::OnFloor { .. }));
        same("the error below the floor", &is_refused, &true)?;
        let floor = floor_of(solved)
            .into_iter()
            .find(|force| force.site == site);
        let parts = floor.map(|force| [force.normal, force.shear_x, force.shear_y]);
        return same("a sum of one", &Some(forces.sum_on_floor(one)?), &parts);
    };
    same("the forces to below", &forces.to_below(site)?, transmitted)?;
    same(
        "a sum of one",
        &forces.sum_of_contacts(one)?,
        &transmitted.iter().sum(),
    )
}

/// The least force is the first of the minima. The first failure is the first layer with a tensile contact.
fn standing_agrees(standing: &Standing, contacts: &Contacts) -> Checked {
    let least = contacts.iter().reduce(|least, contact| {
        if contact.force < least.force {
            contact
        } else {
            least
        }
    });
    same("the least force", &standing.least.as_ref(), &least)?;
    same(
        "the first failure",
        &standing.first_failure,
        &first_failure(contacts),
    )
}

fn first_failure(contacts: &Contacts) -> Option<i128> {
    let pulls = contacts.iter().find(|contact| contact.force.is_negative());
    pulls.map(|contact| contact.site.k)
}

/// Shear forces along y are in units of 2cosφ = √3 of those along x.
fn are_extremes(extremes: &BaseExtremes, floor: &Floor) -> Checked {
    let normals = || floor.iter().map(|force| force.normal.clone());
    same(
        "the least normal",
        &Some(&extremes.normal_min),
        &normals().min().as_ref(),
    )?;
    same(
        "the greatest normal",
        &Some(&extremes.normal_max),
        &normals().max().as_ref(),
    )?;
    let ratios = floor.iter().filter(|force| !force.normal.is_zero());
    let ratios = ratios.map(|force| {
        let [x, y] = [&force.shear_x, &force.shear_y].map(|shear| shear / &force.normal);
        &x * &x + &y * &y * ratio(3, 1)
    });
    let greatest = ratios.max().unwrap_or_else(BigRational::zero);
    same(
        "the greatest shear²",
        &extremes.max_shear_ratio.square(),
        &greatest,
    )
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::power;
    use crate::generators::region::Described;
    use cannonpile::lattice::Region;
    use cannonpile::lattice::Sign::{Minus, Plus};

    #[test]
    fn extremes_of_other_forces_are_caught() {
        let described = Described {
            region: Region::SITE,
            from_base: false,
            signs: vec![Plus, Minus, Plus, Minus, Plus],
            weightless: false,
            weights: vec![],
            loads: vec![],
        };
        let solved = Solved::of(&described);
        let pile = described.pile().unwrap();
        let (standing, base) = (pile.standing().unwrap(), pile.base_extremes().unwrap());
        let (mut contacts, mut floor) = (contacts_of(&solved), floor_of(&solved));
        assert!(standing_agrees(&standing, &contacts).is_ok());
        assert!(are_extremes(&base, &floor).is_ok());
        contacts[0].force = ratio(-1, 1);
        assert!(standing_agrees(&standing, &contacts).is_err());
        floor[0].normal += power(10, -60);
        floor[1].shear_y += ratio(9, 1);
        assert!(are_extremes(&base, &floor).is_err());
    }
}
