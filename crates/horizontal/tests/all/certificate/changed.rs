//! Certificates with one changed number.

use cannonpile::lattice::{Axis, HorizontalContact};
use cannonpile_horizontal::certificate::{Certificate, Claim, Condition};
use num_rational::BigRational;
use num_traits::Zero;

use super::{all, springs, violated};
use cannonpile_testkit::answers::ratio;

/// The amounts by which a number is changed.
fn changes() -> [BigRational; 4] {
    [ratio(1, 1), ratio(-1, 1), ratio(1, 1_000_000), ratio(-2, 7)]
}

/// Returns all horizontal contacts above the floor, with and without a force.
pub(super) fn contacts(certificate: &Certificate) -> Vec<HorizontalContact> {
    let shape = certificate.pile.shape();
    let above = shape.sites().filter(|site| site.k < shape.layers() - 1);
    let contacts = above.flat_map(|site| Axis::ALL.map(|axis| HorizontalContact { site, axis }));
    contacts
        .filter(|contact| contact.neighbour().is_some_and(|site| shape.contains(site)))
        .collect()
}

/// If a field proves a bound, or all contacts of an elastic state carry forces, no number of the field is
/// arbitrary.
#[test]
fn changed_field_is_refused() {
    let mut changed = 0;
    for certificate in all() {
        // With c < 0 and all forces positive, the field of the elastic state is unique. In a bound every number
        // changes the work.
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
                    let (condition, text) = violated(&other);
                    assert!(
                        matches!(
                            condition,
                            Condition::Drop | Condition::Compression | Condition::Bound
                        ),
                        "{text}: {other:?}"
                    );
                    changed += 1;
                }
            }
        }
    }
    // Four changes of each of 250 numbers: 173 in certificates made by hand, 77 in the two from files.
    assert_eq!(changed, 1000);
}

/// The forces of least energy are unique, and so are the forces that attain a bound here.
#[test]
fn changed_force_is_refused() {
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
fn changed_claim_is_refused() {
    for certificate in all() {
        for change in changes() {
            let mut other = certificate.clone();
            match &mut other.claim {
                Claim::Least(extreme) | Claim::Greatest(extreme) => {
                    let proved = extreme.normal.clone();
                    extreme.normal += change;
                    let claimed = extreme.normal.clone();
                    let text = format!("the field proves the bound {proved}, not {claimed}");
                    assert_eq!(violated(&other), (Condition::Bound, text));
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

/// If no horizontal contact is closed, the stiffness ratio is arbitrary, but must be positive.
#[test]
fn straight_pile_accepts_every_positive_stiffness_ratio() {
    for (numer, denom) in [(1, 1), (1, 1_000_000), (1_000_000, 1)] {
        let pile = cannonpile::Pile::triangular(5).unwrap();
        assert_eq!(springs(pile, ratio(numer, denom)).check(), Ok(()));
    }
}

/// A field with the opposite sign does not prove the other bound.
#[test]
fn negated_field_does_not_prove_other_bound() {
    for certificate in all() {
        let mut other = certificate.clone();
        let is_only = certificate.pile.layers() == 2;
        other.claim = match certificate.claim.clone() {
            Claim::Least(extreme) if !is_only => Claim::Greatest(extreme),
            Claim::Greatest(extreme) if !is_only => Claim::Least(extreme),
            _ => continue,
        };
        assert!(
            matches!(violated(&other).0, Condition::Drop | Condition::Compression),
            "{other:?}"
        );
    }
}
