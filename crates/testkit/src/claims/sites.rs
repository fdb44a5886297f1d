//! A pile has exactly the sites with three nonnegative counts, numbers them without gaps, and rejects all others.

use arbitrary::Unstructured;
use cannonpile::lattice::{Dimension, Site, count};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::{Checked, demand, same};
use crate::generators::{number, pile};

/// For any three integers, either the pile has the site or it rejects every query about it.
pub fn anywhere(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::pile(u)?;
    let site = if u.arbitrary()? {
        nearby(u, &pile)?
    } else {
        Site {
            i: number::machine_integer(u)?,
            j: number::machine_integer(u)?,
            k: number::machine_integer(u)?,
        }
    };
    let forces = pile.forces::<BigRational>();
    let outside = |refused: Option<Error>| matches!(refused, Some(Error::SiteOutside { .. }));
    let direction = pile::direction(u, &pile)?;
    let refusals = [
        outside(pile.shape().check(site).err()),
        outside(forces.from_above(site).err()),
        outside(forces.contact(site, direction).err()),
        outside(forces.position(site).err()),
        outside(forces.on_floor(site).err()),
        outside(pile.rows(Selection::One(site)).err()),
    ];
    has_or_refuses(&pile, site, &refusals)
}

/// The next sphere in row order has the next number. The number after the last one is the sphere count.
pub fn numbered(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::pile(u)?;
    let site = pile::site(u, &pile)?;
    let (number, reported) = (before(&pile, site), pile.shape().before(site)?);
    same("the spheres before", &BigInt::from(reported), &number)?;
    let after = number + BigInt::one();
    match successor(&pile, site) {
        Some(next) => same("the next number", &before(&pile, next), &after),
        None => same("the spheres", &after, &pile.sphere_count().into()),
    }
}

/// The pile has the site exactly if it rejected no query.
fn has_or_refuses(pile: &Pile, site: Site, refusals: &[bool]) -> Checked {
    let [i, j, k, layers] = [site.i, site.j, site.k, pile.layers()].map(BigInt::from);
    let counts = [&k - &i - &j, i, j.clone()];
    let in_plane = pile.dimension() == Dimension::Three || j.is_zero();
    let has = counts.iter().all(|count| !count.is_negative()) && k < layers && in_plane;
    demand(refusals.iter().all(|refused| *refused != has), || {
        format!("{site} in {pile:?}: rejected {refusals:?}, has it {has}")
    })
}

/// A site of the pile, or one up to two steps outside.
fn nearby(u: &mut Unstructured<'_>, pile: &Pile) -> arbitrary::Result<Site> {
    let Site { i, j, k } = pile::site(u, pile)?;
    Ok(Site {
        i: i + u.int_in_range(-2..=2)?,
        j: j + u.int_in_range(-2..=2)?,
        k: k + u.int_in_range(-2..=2)?,
    })
}

/// The number of spheres before `site`.
fn before(pile: &Pile, site: Site) -> BigInt {
    let Site { i, j, k } = site;
    let layers = BigRational::from_integer(k.into());
    let above = count::spheres(&layers, pile.dimension().number()).to_integer();
    // Rows 0 … j−1 have k+1, k, … spheres.
    let [i, j, k] = [i, j, k].map(BigInt::from);
    above + (k * 2 + 3 - &j) * j / 2 + i
}

/// The next site in the row, or the first of the next row or layer.
fn successor(pile: &Pile, Site { i, j, k }: Site) -> Option<Site> {
    let steps = [
        Site { i: i + 1, j, k },
        Site { i: 0, j: j + 1, k },
        Site {
            i: 0,
            j: 0,
            k: k + 1,
        },
    ];
    steps.into_iter().find(|next| pile.shape().contains(*next))
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    #[test]
    fn an_answer_outside_the_pile_is_caught() {
        let pile = Pile::triangular(5).unwrap();
        let inside = Site { i: 1, j: 2, k: 3 };
        let nearby = Site { i: 2, ..inside };
        assert!(has_or_refuses(&pile, inside, &[false, false]).is_ok());
        assert!(has_or_refuses(&pile, inside, &[false, true]).is_err());
        assert!(has_or_refuses(&pile, nearby, &[true, true]).is_ok());
        assert!(has_or_refuses(&pile, nearby, &[true, false]).is_err());
    }

    #[test]
    fn a_skipped_number_is_caught() {
        let pile = Pile::triangular(5).unwrap();
        let last_of_row = Site { i: 1, j: 2, k: 3 };
        let next = successor(&pile, last_of_row).unwrap();
        assert_eq!(next, Site { i: 0, j: 3, k: 3 });
        let skipped = successor(&pile, next).unwrap();
        let after = before(&pile, last_of_row) + BigInt::one();
        assert!(same("number", &before(&pile, next), &after).is_ok());
        assert!(same("number", &before(&pile, skipped), &after).is_err());
    }
}
