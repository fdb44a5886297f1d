//! Counts, by spheres and by contacts.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::Selection;
use num_rational::BigRational as Q;
use num_traits::{One, Zero};

use super::{at_site, equilateral_piles, int, prove, value};

const LAYERS: i128 = 12;

/// The number of spheres above a site on one line, from a walk up.
fn walked(pile: &Pile, site: Site, direction: Direction) -> Q {
    let up = core::iter::successors(Some(site), |site| pile.shape().above(*site, direction));
    up.skip(1).fold(Q::zero(), |n, _| n + Q::one())
}

const NAMES: [&str; 3] = ["N_α", "N_β", "N_γ"];

#[test]
fn counts_equal_walks() {
    let proof = prove("counts");
    let pile = Pile::triangular(8).expect("a pile");
    for site in pile.shape().sites() {
        for direction in Direction::ALL {
            let Some(below) = pile.shape().below(site, direction) else {
                continue;
            };
            for (other, name) in Direction::ALL.into_iter().zip(NAMES) {
                let claim = format!("step along {direction}: {name}");
                assert_eq!(
                    value(&proof, &claim, &at_site(site)),
                    walked(&pile, below, other)
                );
            }
        }
    }
    for name in NAMES {
        assert!(value(&proof, &format!("base case: {name}"), &[]).is_zero());
    }
}

#[test]
fn the_rotation_permutes_counts() {
    let proof = prove("rotation");
    let pile = Pile::triangular(7).expect("a pile");
    for site in pile.shape().sites() {
        // The paper's rotation about the axis.
        let Site { i, j, k } = site;
        let image = Site {
            i: j,
            j: k - i - j,
            k,
        };
        let here = at_site(site);
        for (direction, name) in Direction::ALL.into_iter().zip(NAMES) {
            let count = value(&proof, &format!("{name} of the image"), &here);
            assert_eq!(count, walked(&pile, image, direction));
        }
    }
}

#[test]
fn spheres_are_counted() {
    let proof = prove("spheres");
    for pile in equilateral_piles(LAYERS) {
        let (l, last) = (pile.layers(), pile.layers() - 1);
        let sites = pile.shape().sites();
        let all: Vec<Site> = sites.collect();
        let in_all = value(&proof, "Σ 1 over the pile", &[("L", int(l))]);
        assert_eq!(in_all, Q::from_integer(all.len().into()));
        assert_eq!(in_all, Q::from_integer(pile.sphere_count().into()));
        let in_base = value(&proof, "Σ 1 over layer k", &[("k", int(last))]);
        assert_eq!(in_base, Q::from_integer(pile.base_sphere_count().into()));
        let of_base = all.iter().filter(|site| site.k == last).count();
        assert_eq!(in_base, Q::from_integer(of_base.into()));
    }
}

#[test]
fn contacts_are_counted_by_strength() {
    let (contacts, strengths) = (prove("contacts"), prove("strengths"));
    for pile in equilateral_piles(LAYERS) {
        let l = ("L", int(pile.layers()));
        let forces = pile.forces::<Q>();
        let mut by_strength: BTreeMap<(Direction, Q), Q> = BTreeMap::new();
        for contact in forces.contacts(Selection::All).expect("rows") {
            let contact = contact.expect("a force");
            *by_strength
                .entry((contact.direction, contact.force))
                .or_default() += Q::one();
        }
        let at_l = core::slice::from_ref(&l);
        let all: Q = by_strength.values().sum();
        assert_eq!(
            value(&contacts, "Σ over the spheres off the floor", at_l),
            all
        );
        assert_eq!(value(&strengths, "counts every contact", at_l), all);
        assert_eq!(Q::from_integer(pile.contact_count().into()), all);
        for direction in Direction::ALL {
            let of_direction = || by_strength.iter().filter(|((d, _), _)| *d == direction);
            for ((_, n), count) in of_direction() {
                let values = [l.clone(), ("n", n.clone())];
                assert_eq!(&value(&strengths, "N_γ = n−1", &values), count);
                let n = i128::try_from(n.to_integer()).expect("small");
                assert_eq!(
                    &Q::from_integer(pile.contact_count_of_strength(n).into()),
                    count
                );
            }
            let moment = |power: i32| -> Q {
                of_direction()
                    .map(|((_, n), count)| n.pow(power) * count)
                    .sum()
            };
            assert_eq!(value(&strengths, "by n and by contact", at_l), moment(1));
            assert_eq!(value(&strengths, "the mean", at_l), moment(1) * int(4));
            assert_eq!(value(&strengths, "5 Σ n²", at_l), moment(2) * int(5));
        }
    }
}
