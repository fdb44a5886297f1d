//! Elimination, sphere by sphere, confirms the forces in piles of discs and of spheres on isosceles bases. Both have weights
//! and loads.

use std::collections::BTreeMap;

use arbitrary::Unstructured;
use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{ContactForce, Error, FloorForce, Pile};
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Checked, same};
use crate::answers::{Answers, Shape};
use crate::generators::{number, rarely, region};
use crate::oracles::elimination;

/// Compares all contacts, the base, and the answers about one sphere.
pub fn any_base(u: &mut Unstructured<'_>) -> Checked {
    let Loaded {
        shape,
        pile,
        acting,
    } = loaded(u)?;
    let answers = elimination::solve_loaded(&shape, pile.layers(), |site| acting[&site].clone());
    same("the weight", &pile.weight(), &acting.values().sum())?;
    agrees(&pile, &answers)?;
    let sites = shape.sites(pile.layers());
    let site = *u.choose(&sites)?;
    let forces = pile.forces::<BigRational>();
    let sphere = &answers.spheres[&site];
    same("from above", &forces.from_above(site)?, &sphere.from_above)?;
    same("a position", &forces.position(site)?, &sphere.position)
}

/// A pile and the external force on each of its spheres, in mg.
struct Loaded {
    shape: Shape,
    pile: Pile,
    acting: BTreeMap<Site, BigRational>,
}

fn loaded(u: &mut Unstructured<'_>) -> Result<Loaded, super::Failure> {
    let layers = u.int_in_range(1..=6)?;
    let shape = if rarely(u, 4)? {
        Shape::Discs
    } else {
        Shape::Spheres(number::sin_phi(u)?)
    };
    let sites = shape.sites(layers);
    let mut pile = shape.pile(layers);
    let one = |site: &Site| (*site, BigRational::one());
    let mut acting: BTreeMap<_, _> = sites.iter().map(one).collect();
    for _ in 0..u.int_in_range(0..=3)? {
        let (site, weight) = (*u.choose(&sites)?, region::weight(u)?);
        pile = pile.with_weight(site, weight.clone())?;
        acting.insert(site, weight);
    }
    if rarely(u, 6)? {
        pile = pile.weightless();
        acting.values_mut().for_each(Zero::set_zero);
    }
    for _ in 0..u.int_in_range(0..=3)? {
        let (site, load) = (*u.choose(&sites)?, region::weight(u)?);
        pile = pile.with_load(site, load.clone())?;
        *acting.entry(site).or_default() += load;
    }
    Ok(Loaded {
        shape,
        pile,
        acting,
    })
}

fn agrees(pile: &Pile, answers: &Answers) -> Checked {
    let forces = pile.forces::<BigRational>();
    let contacts: Result<Vec<_>, Error> = forces.contacts(Selection::All)?.collect();
    let expected = answers.contacts.iter();
    let mut expected: Vec<_> = expected
        .map(|((site, direction), contact)| ContactForce {
            site: *site,
            direction: *direction,
            force: contact.force.clone(),
        })
        .collect();
    expected.sort_by_key(|contact| {
        let Site { i, j, k } = contact.site;
        (k, j, i, contact.direction.index())
    });
    same("the contacts", &contacts?, &expected)?;
    let floor: Result<Vec<_>, Error> = forces.base(Selection::Base)?.collect();
    let expected = answers.floor.iter().map(|(site, force)| FloorForce {
        site: *site,
        normal: force.z.clone(),
        shear_x: force.x.clone(),
        shear_y: force.y.clone(),
    });
    let mut expected: Vec<_> = expected.collect();
    expected.sort_by_key(|force| (force.site.j, force.site.i));
    same("the base", &floor?, &expected)
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::ratio;

    #[test]
    fn a_misplaced_load_is_caught() {
        let loads = |at: Site, load: i64| {
            move |site: Site| ratio(1, 1) + ratio(if site == at { load } else { 0 }, 1)
        };
        let at = Site { i: 0, j: 1, k: 2 };
        for shape in [Shape::Spheres(ratio(2, 7)), Shape::Discs] {
            let at = if shape == Shape::Discs {
                Site { j: 0, ..at }
            } else {
                at
            };
            let pile = shape.pile(4).with_load(at, ratio(3, 1)).unwrap();
            let judge = |at, load| {
                agrees(
                    &pile,
                    &elimination::solve_loaded(&shape, 4, loads(at, load)),
                )
                .is_ok()
            };
            assert!(judge(at, 3));
            assert!(!judge(at, 2));
            assert!(!judge(Site { i: 1, ..at }, 3));
        }
    }
}
