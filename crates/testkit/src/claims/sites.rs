//! A pile has exactly the sites with three nonnegative counts, and rejects all others.

use arbitrary::Unstructured;
use cannonpile::lattice::{Dimension, Site};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{Checked, demand};
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
}
