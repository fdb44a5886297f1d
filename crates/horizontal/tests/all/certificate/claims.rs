//! Claims that are accepted.

use cannonpile::Pile;
use cannonpile::lattice::{Axis, Site};
use cannonpile_horizontal::certificate::{Claim, Condition, Refusal};
use num_bigint::BigInt;
use num_rational::BigRational;

use super::{
    all, along, apart, at, bare, corner, extreme, held_together, own_weight, springs, straight,
    violated,
};
use cannonpile_testkit::answers::ratio;

#[test]
fn valid_certificates_are_accepted() {
    for certificate in all() {
        assert_eq!(certificate.check(), Ok(()), "{certificate:?}");
    }
}

#[test]
fn spreading_pile_is_unstable() {
    // A load of at most three times the weight is stable, with zero forces at the limit.
    let text = "the virtual work of the weights must be positive, not 0".to_owned();
    assert_eq!(violated(&apart(2)), (Condition::Work, text));
    let mut stable = apart(2);
    stable.claim = Claim::Stands;
    assert_eq!(stable.check(), Ok(()));
    let mut unstable = apart(3);
    unstable.claim = Claim::Stands;
    assert_eq!(violated(&unstable).0, Condition::Tension);
}

#[test]
fn horizontal_forces_stabilise_pile() {
    let text = "the contact (0,0,1) alpha is tensile: its force is -2/3".to_owned();
    let without = held_together(8, (0, 1));
    assert_eq!(violated(&without), (Condition::Tension, text));
    for (push, stands) in [
        ((1, 4), false),
        ((1, 3), true),
        ((2, 3), true),
        ((3, 4), false),
    ] {
        let certificate = held_together(8, push);
        assert_eq!(certificate.check().is_ok(), stands, "{push:?}");
    }
    let mut pulled = held_together(8, (1, 2));
    let contact = along(Axis::AlphaBeta, at(-1, 0, 1));
    pulled.horizontal.insert(contact, ratio(-1, 2));
    let text = format!("the horizontal contact {contact} is tensile: its force is -1/2");
    assert_eq!(violated(&pulled), (Condition::HorizontalTension, text));
}

/// Forces without horizontal contacts lie between the bounds.
#[test]
fn isostatic_force_lies_between_bounds() {
    for layers in 2..=6 {
        let certificate = corner(layers);
        let Claim::Greatest(greatest) = &certificate.claim else {
            panic!("the claim is an upper bound");
        };
        let forces = certificate.pile.forces::<BigRational>();
        let isostatic = forces.on_floor(greatest.site).unwrap().normal;
        assert_eq!(isostatic, ratio((layers + 2).try_into().unwrap(), 3));
        assert!(isostatic <= greatest.normal);
        assert_eq!(isostatic == greatest.normal, layers == 2);
    }
}

#[test]
fn certificate_must_match_its_pile() {
    let mut no_contact = straight(4);
    for (axis, site) in [
        // The spheres of the floor are fixed.
        (Axis::AlphaBeta, at(0, 0, 3)),
        (Axis::AlphaBeta, at(2, 0, 2)),
        (Axis::GammaBeta, at(0, 0, 2)),
        (Axis::AlphaBeta, Site::APEX),
        (Axis::AlphaGamma, at(0, 0, -1)),
        (Axis::AlphaGamma, at(0, i128::MAX, 2)),
    ] {
        let contact = along(axis, site);
        no_contact.horizontal = [(contact, ratio(1, 1))].into();
        let text = format!("there is no horizontal contact {contact} above the floor");
        assert_eq!(violated(&no_contact), (Condition::Place, text));
    }
    let mut no_sphere = own_weight(at(1, 1, 3));
    for site in [at(1, 1, 3), at(3, 0, 2), at(0, 0, 4), at(0, 0, -1)] {
        no_sphere.field = [(site, [ratio(0, 1), ratio(0, 1), ratio(0, 1)])].into();
        let text = format!("there is no sphere {site} above the floor");
        assert_eq!(violated(&no_sphere), (Condition::Place, text));
    }
    for site in [at(0, 0, 2), at(4, 0, 3), at(0, 0, 4)] {
        let pile = Pile::triangular(4).unwrap();
        let claim = Claim::Least(extreme(site, ratio(1, 1), false));
        let text = format!("there is no sphere {site} on the floor");
        assert_eq!(violated(&bare(pile, claim)), (Condition::Place, text));
    }
    let sharp = Pile::isosceles(4, ratio(1, 3)).unwrap();
    let (condition, text) = violated(&bare(sharp, Claim::Stands));
    assert_eq!(condition, Condition::Pile);
    assert!(text.ends_with("only if sin phi is 1/2, not 1/3"), "{text}");
    for given in [ratio(0, 1), ratio(-1, 2)] {
        let text = format!("the stiffness ratio must be positive, not {given}");
        let certificate = springs(Pile::triangular(3).unwrap(), given);
        assert_eq!(violated(&certificate), (Condition::Stiffness, text));
    }
}

#[test]
fn oversized_checks_are_refused() {
    let is_refused = |pile: Pile| {
        let refusal = bare(pile, Claim::Stands).check();
        matches!(
            refusal,
            Err(Refusal::Pile(cannonpile::Error::TooLarge { .. }))
        )
    };
    assert!(is_refused(Pile::triangular(10_i128.pow(30)).unwrap()));
    // Sums of fractions with coprime denominators are as long as all denominators together.
    let mut pile = Pile::triangular(60).unwrap();
    for load in [1, 3] {
        let denominator = BigInt::from(10).pow(4_998) + BigInt::from(load);
        let load = BigRational::new(1.into(), denominator);
        pile = pile.with_load(Site::APEX, load).unwrap();
    }
    assert!(is_refused(pile));
}

#[test]
fn refusals_state_the_relation() {
    let mut least = own_weight(at(1, 1, 3));
    least.field = [(Site::APEX, [ratio(2, 1), ratio(0, 1), ratio(0, 1)])].into();
    let (condition, text) = violated(&least);
    assert_eq!(condition, Condition::Drop);
    assert!(text.ends_with("is 2, but must be at most 0"), "{text}");
    let mut elastic = springs(Pile::triangular(3).unwrap(), ratio(1, 1));
    elastic.field.clear();
    let (condition, text) = violated(&elastic);
    assert_eq!(condition, Condition::Drop);
    assert!(text.ends_with("is 0, but must be equal to 1"), "{text}");
    let mut greatest = corner(4);
    greatest.field.clear();
    let (condition, text) = violated(&greatest);
    assert_eq!(condition, Condition::Drop);
    assert!(text.ends_with("is 0, but must be at least 1"), "{text}");
}

/// A number of 5,000 digits does not fill the terminal.
#[test]
fn long_numbers_of_refusals_are_shortened() {
    let mut least = own_weight(at(1, 1, 3));
    let long = BigRational::from_integer(BigInt::from(10).pow(4_999));
    least.field = [(Site::APEX, [long, ratio(0, 1), ratio(0, 1)])].into();
    let (_, text) = violated(&least);
    assert!(text.len() < 200, "{text}");
}
