//! The response to a unit load on weightless spheres (`paper`, "Invariants"): Σv = 1, Σv² = 1/3 and Σvr² = n² at depth n.
//! Here v is the vertical part of a contact force, and r the distance of the lower sphere from the line of the load, in 2R
//! sinθ.

use std::collections::BTreeMap;

use cannonpile::Forces;
use cannonpile::shape::Selection;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::forces::invariants::square;
use cannonpile_testkit::cases::{Bounds, Case, Random, all_signs, repeated};
use cannonpile_testkit::oracles::balance::{Balance, Place, ratio};

/// The vertical parts of the nonzero contact forces with their lower sphere, by depth from 1 on.
type Response = Vec<Vec<(Place, BigRational)>>;

/// A weightless pile with a unit load on the sphere (0, 0) of the top layer.
fn loaded(signs: &str) -> Case {
    let case = Case::under(&Bounds::hexagon(2, 2), signs).weightless();
    case.with_load((0, 0, 0), &BigRational::one())
}

fn response(case: &Case) -> Response {
    let forces: Forces<BigRational> = case.pile.forces();
    let contacts = forces.contacts(Selection::All).unwrap();
    let mut response = vec![Vec::new(); case.balance.signs.len()];
    for contact in contacts {
        let contact = contact.unwrap();
        let below = case.pile.shape().below(contact.site, contact.direction);
        let below = below.expect("off the floor");
        let depth = usize::try_from(contact.site.k).unwrap();
        if !contact.force.is_zero() {
            let v = contact.force / BigInt::from(3);
            response[depth].push(((below.k, below.j, below.i), v));
        }
    }
    response
}

fn holds(balance: &Balance, response: &Response) -> Result<(), String> {
    for (depth, contacts) in (1_i64..).zip(response) {
        let sum = |of: &dyn Fn(Place, &BigRational) -> BigRational| -> BigRational {
            contacts.iter().map(|(at, v)| of(*at, v)).sum()
        };
        let sums = [
            sum(&|_, v| v.clone()),
            sum(&|_, v| v * v),
            sum(&|at, v| v * square(&balance.position(at))),
        ];
        if sums != [ratio(1, 1), ratio(1, 3), ratio(depth * depth, 1)] {
            return Err(format!("{sums:?} at depth {depth} of {}", balance.signs));
        }
    }
    Ok(())
}

#[test]
fn of_every_stacking_up_to_8_layers() {
    for signs in (1..8).flat_map(all_signs) {
        let case = loaded(&signs);
        holds(&case.balance, &response(&case)).unwrap();
    }
}

#[test]
fn of_long_stackings() {
    for signs in [
        repeated("+-", 24),
        repeated("++--", 24),
        repeated("+++++--", 24),
        Random(41).signs(24),
    ] {
        let case = loaded(&signs);
        holds(&case.balance, &response(&case)).unwrap();
    }
}

#[test]
fn a_small_fault_is_caught() {
    let case = loaded("+-+");
    let right = response(&case);
    for (depth, contacts) in right.iter().enumerate() {
        for n in 0..contacts.len() {
            let mut wrong = right.clone();
            wrong[depth][n].1 = -&right[depth][n].1;
            assert!(holds(&case.balance, &wrong).is_err());
        }
    }
}

#[test]
fn straight_piles_transmit_a_load_along_three_lines() {
    for signs in ["+++++++", "-------"] {
        for contacts in response(&loaded(signs)) {
            let thirds: Vec<BigRational> = contacts.into_iter().map(|(_, v)| v).collect();
            assert_eq!(thirds, [ratio(1, 3), ratio(1, 3), ratio(1, 3)]);
        }
    }
}

/// The oracle's response in the same form.
fn response_by_oracle(balance: &Balance) -> Response {
    let mut response = vec![Vec::new(); balance.signs.len()];
    for (at, forces) in balance.forces().below {
        let depth = usize::try_from(at.0).unwrap();
        for (m, force) in forces.into_iter().enumerate() {
            if !force.is_zero() {
                let below = balance.below(at, m).expect("off the floor");
                response[depth].push((below, force / BigInt::from(3)));
            }
        }
    }
    response
}

/// The number of contacts with each nonzero force.
fn profile(contacts: &[(Place, BigRational)]) -> BTreeMap<BigRational, usize> {
    let mut profile = BTreeMap::new();
    for (_, v) in contacts {
        *profile.entry(v.clone()).or_default() += 1;
    }
    profile
}

/// The total force on the spheres at each squared distance from the line of the load.
fn rings(
    balance: &Balance,
    contacts: &[(Place, BigRational)],
) -> BTreeMap<BigRational, BigRational> {
    let mut rings = BTreeMap::new();
    for (at, v) in contacts {
        *rings.entry(square(&balance.position(*at))).or_default() += v;
    }
    rings
}

/// For depths 1 to 6 of HCP: the frequency of each force, as its numerator over 3^depth. Found by the oracle.
const FORCES_OF_HCP: [&[(i64, usize)]; 6] = [
    &[(1, 3)],
    &[(-1, 3), (2, 6)],
    &[(-3, 3), (-2, 6), (4, 12)],
    &[(-8, 6), (-5, 3), (-4, 6), (4, 6), (8, 12), (16, 3)],
    &[
        (-28, 6),
        (-16, 3),
        (-15, 3),
        (-8, 6),
        (-4, 6),
        (8, 12),
        (16, 12),
        (32, 9),
    ],
    &[
        (-96, 3),
        (-60, 6),
        (-32, 9),
        (-22, 6),
        (-16, 6),
        (4, 6),
        (16, 6),
        (32, 12),
        (47, 3),
        (48, 6),
        (64, 6),
        (96, 6),
    ],
];

/// The response by squared distance from the line of the load: the sum over the ring, as its numerator over 3^(depth−1).
const RINGS_OF_HCP: [&[(i64, i64)]; 6] = [
    &[(1, 1)],
    &[(0, -1), (3, 4)],
    &[(1, -7), (4, 8), (7, 8)],
    &[(0, -5), (3, -16), (9, 32), (12, 16)],
    &[(1, 1), (4, -72), (7, -8), (13, 96), (16, 32), (19, 32)],
    &[(0, 47), (3, -156), (9, -192), (12, 96), (21, 384), (27, 64)],
];

#[test]
fn hcp_has_a_ring_of_compression_around_tension() {
    let case = loaded("+-+-+-");
    for response in [response(&case), response_by_oracle(&case.balance)] {
        for (n, contacts) in response.iter().enumerate() {
            let over = 3_i64.pow(u32::try_from(n).unwrap());
            let forces = FORCES_OF_HCP[n].iter();
            let forces = forces.map(|(v, count)| (ratio(*v, 3 * over), *count));
            assert_eq!(profile(contacts), forces.collect());
            let sums = RINGS_OF_HCP[n].iter();
            let sums = sums.map(|(square, sum)| (ratio(*square, 1), ratio(*sum, over)));
            assert_eq!(rings(&case.balance, contacts), sums.collect());
        }
    }
    let pulls =
        |contacts: &Vec<(Place, BigRational)>| contacts.iter().any(|(_, v)| v.is_negative());
    assert!(response(&case)[1..].iter().all(pulls));
}

#[test]
fn weight_keeps_contacts_compressive_up_to_a_critical_load() {
    // With the load w on the top, the contacts of an edge carry 1 − (1 + w)/3 below the sign change.
    let failure = |load: BigRational| {
        let case = Case::under(&Bounds::SITE, "+-").with_load((0, 0, 0), &load);
        case.pile.standing().unwrap().first_failure
    };
    assert_eq!(failure(ratio(2, 1)), None);
    assert_eq!(failure(ratio(2_000_001, 1_000_000)), Some(1));
}
