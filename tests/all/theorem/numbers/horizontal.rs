//! Energy and settlement of the elastic state, as its certificate has them.

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::theorem::{Formulas, find};
use num_rational::BigRational as Q;

use super::{RIGHT, equilateral_piles, int, prove, value};

#[test]
fn energy() {
    let proof = prove("elastic-energy");
    for pile in equilateral_piles(7) {
        let forces = pile.forces::<Q>();
        let contacts = forces.contacts(Selection::All).expect("all");
        let squares: Q = contacts
            .map(|contact| contact.expect("a force").force)
            .map(|force| &force * &force)
            .sum();
        let at = [("L", int(pile.layers()))];
        assert_eq!(value(&proof, "Σf² = Σφ", &at), squares);
    }
}

#[cfg(feature = "horizontal")]
#[test]
fn settlement() {
    let proof = prove("settlement");
    for pile in equilateral_piles(7).skip(1) {
        let elastic = pile.elastic(&int(1)).expect("a state");
        let field = &elastic.certificate().expect("a certificate").field;
        let sum: Q = field[&Site::APEX].iter().sum();
        let at = [("L", int(pile.layers()))];
        assert_eq!(value(&proof, "the apex", &at), sum * int(2) / int(3));
    }
}

/// Sites may be named the other way round, with i and j exchanged.
#[test]
fn the_elastic_state_is_the_same_whatever_the_names_of_sites() {
    let exchanged: Formulas = Formulas {
        above: |i, j, k| (RIGHT.above)(j, i, k),
        descent: |sign, direction| {
            let [i, j] = (RIGHT.descent)(sign, direction);
            [j, i]
        },
        ..RIGHT
    };
    let theorem = find("elastic-straight").expect("a theorem");
    let proof = theorem.prove_for(&exchanged);
    assert!(proof.holds(), "{proof:?}");
    // With one exchanged alone a contact leads elsewhere.
    for mixed in [
        Formulas {
            above: RIGHT.above,
            ..exchanged
        },
        Formulas {
            descent: RIGHT.descent,
            ..exchanged
        },
    ] {
        assert!(!theorem.prove_for(&mixed).holds());
    }
}
