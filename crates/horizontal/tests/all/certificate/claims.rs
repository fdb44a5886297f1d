//! Claims that are accepted.

use cannonpile::Pile;
use cannonpile::lattice::{Axis, Direction, Site};
use cannonpile_horizontal::certificate::{Claim, Refusal};
use num_bigint::BigInt;
use num_rational::BigRational;

use super::{
    all, along, apart, at, bare, corner, extreme, held_together, own_weight, springs, straight,
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
    assert_eq!(
        *apart(2).check().unwrap_err(),
        Refusal::Work { work: ratio(0, 1) }
    );
    let mut stable = apart(2);
    stable.claim = Claim::Stands;
    assert_eq!(stable.check(), Ok(()));
    let mut unstable = apart(3);
    unstable.claim = Claim::Stands;
    assert!(matches!(
        *unstable.check().unwrap_err(),
        Refusal::Tension { .. }
    ));
}

#[test]
fn horizontal_forces_stabilise_pile() {
    let without = held_together(8, (0, 1)).check().unwrap_err();
    let refusal = Refusal::Tension {
        site: at(0, 0, 1),
        direction: Direction::Alpha,
        force: ratio(-2, 3),
    };
    assert_eq!(*without, refusal);
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
    let force = ratio(-1, 2);
    assert_eq!(
        *pulled.check().unwrap_err(),
        Refusal::HorizontalTension { contact, force }
    );
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
        assert_eq!(
            *no_contact.check().unwrap_err(),
            Refusal::NoContact { contact }
        );
    }
    let mut no_sphere = own_weight(at(1, 1, 3));
    for site in [at(1, 1, 3), at(3, 0, 2), at(0, 0, 4), at(0, 0, -1)] {
        no_sphere.field = [(site, [ratio(0, 1), ratio(0, 1), ratio(0, 1)])].into();
        assert_eq!(*no_sphere.check().unwrap_err(), Refusal::NoSphere { site });
    }
    for site in [at(0, 0, 2), at(4, 0, 3), at(0, 0, 4)] {
        let pile = Pile::triangular(4).unwrap();
        let claim = Claim::Least(extreme(site, ratio(1, 1), false));
        let refusal = *bare(pile, claim).check().unwrap_err();
        assert_eq!(refusal, Refusal::NotOnFloor { site });
    }
    let sharp = Pile::isosceles(4, ratio(1, 3)).unwrap();
    let sin_phi = ratio(1, 3);
    assert_eq!(
        *bare(sharp, Claim::Stands).check().unwrap_err(),
        Refusal::NoTouchingNeighbours { sin_phi }
    );
    for given in [ratio(0, 1), ratio(-1, 2)] {
        let certificate = springs(Pile::triangular(3).unwrap(), given.clone());
        let refusal = *certificate.check().unwrap_err();
        assert_eq!(refusal, Refusal::Stiffness { given });
    }
}

#[test]
fn oversized_checks_are_refused() {
    let is_refused = |pile: Pile| {
        let refusal = bare(pile, Claim::Stands).check();
        matches!(
            refusal.map_err(|refusal| *refusal),
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
fn relations_are_printed_in_words() {
    use cannonpile_horizontal::certificate::Relation;

    let written = [Relation::AtMost, Relation::Equal, Relation::AtLeast].map(|r| r.to_string());
    assert_eq!(written, ["at most", "equal to", "at least"]);
}
