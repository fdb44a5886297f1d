//! One number of what is accepted is changed.

use cannonpile::lattice::{Axis, HorizontalContact};
use cannonpile_horizontal::certificate::{Certificate, Claim, Refusal};
use num_rational::BigRational;
use num_traits::Zero;

use super::{all, springs};
use cannonpile_testkit::answers::ratio;

/// By how much numbers are changed.
fn changes() -> [BigRational; 4] {
    [ratio(1, 1), ratio(-1, 1), ratio(1, 1_000_000), ratio(-2, 7)]
}

/// Every horizontal contact above the floor, whether it bears something or not.
pub(super) fn contacts(certificate: &Certificate) -> Vec<HorizontalContact> {
    let shape = certificate.pile.shape();
    let above = shape.sites().filter(|site| site.k < shape.layers() - 1);
    let contacts = above.flat_map(|site| Axis::ALL.map(|axis| HorizontalContact { site, axis }));
    contacts
        .filter(|contact| contact.neighbour().is_some_and(|site| shape.contains(site)))
        .collect()
}

/// A field that proves a bound, or springs that bear at every contact, leave no number free.
#[test]
fn every_number_of_a_field_counts() {
    let mut changed = 0;
    for certificate in all() {
        // With c < 0 and every force positive no other field is of springs; any counts for a bound by its work.
        if matches!(certificate.claim, Claim::Stands | Claim::CannotStand) {
            continue;
        }
        let directions = certificate.pile.dimension().directions();
        for site in certificate.field.keys() {
            for direction in directions {
                for change in changes() {
                    let mut other = certificate.clone();
                    let field = other.field.get_mut(site).unwrap();
                    field[direction.index()] += change;
                    let refusal = other.check().expect_err("another field");
                    assert!(
                        matches!(
                            *refusal,
                            Refusal::Drop { .. }
                                | Refusal::Compression { .. }
                                | Refusal::Bound { .. }
                        ),
                        "{refusal}: {other:?}"
                    );
                    changed += 1;
                }
            }
        }
    }
    // Four changes of each of 250 numbers: 173 of the certificates made by hand, 77 of the two from files.
    assert_eq!(changed, 1000);
}

/// The forces of springs are the only ones of least energy, and the forces that attain a bound are used up to the last.
#[test]
fn every_force_counts() {
    let mut changed = 0;
    for certificate in all() {
        let contacts = match &certificate.claim {
            Claim::Elastic { .. } => contacts(&certificate),
            Claim::Greatest(greatest) if greatest.attained => {
                certificate.horizontal.keys().copied().collect()
            }
            _ => continue,
        };
        for contact in contacts {
            for change in changes() {
                let mut other = certificate.clone();
                let force = other.horizontal.entry(contact).or_default();
                *force += change;
                assert!(other.check().is_err(), "{contact}: {other:?}");
                changed += 1;
            }
        }
    }
    // Four changes in each of 113 contacts.
    assert_eq!(changed, 452);
}

#[test]
fn every_number_of_a_claim_counts() {
    for certificate in all() {
        for change in changes() {
            let mut other = certificate.clone();
            match &mut other.claim {
                Claim::Least(extreme) | Claim::Greatest(extreme) => {
                    let proved = extreme.normal.clone();
                    extreme.normal += change;
                    let claimed = extreme.normal.clone();
                    let refusal = *other.check().unwrap_err();
                    assert_eq!(refusal, Refusal::Bound { claimed, proved });
                }
                Claim::Elastic { stiffness_ratio } => {
                    *stiffness_ratio += change;
                    let bears = |force: &BigRational| !force.is_zero();
                    if certificate.horizontal.values().any(bears) {
                        other.check().expect_err("another ratio");
                    }
                }
                _ => {}
            }
        }
    }
}

/// Where nothing is pressed together the ratio does not matter, but its sign does.
#[test]
fn straight_piles_are_alike_for_all_springs() {
    for (numer, denom) in [(1, 1), (1, 1_000_000), (1_000_000, 1)] {
        let pile = cannonpile::Pile::triangular(5).unwrap();
        assert_eq!(springs(pile, ratio(numer, denom)).check(), Ok(()));
    }
}

/// The other bound: the same field with the signs changed proves nothing of it.
#[test]
fn least_is_not_greatest() {
    for certificate in all() {
        let mut other = certificate.clone();
        let is_only = certificate.pile.layers() == 2;
        other.claim = match certificate.claim.clone() {
            Claim::Least(extreme) if !is_only => Claim::Greatest(extreme),
            Claim::Greatest(extreme) if !is_only => Claim::Least(extreme),
            _ => continue,
        };
        assert!(
            matches!(
                *other.check().unwrap_err(),
                Refusal::Drop { .. } | Refusal::Compression { .. }
            ),
            "{other:?}"
        );
    }
}
