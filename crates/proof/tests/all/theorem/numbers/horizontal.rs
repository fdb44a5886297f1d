//! Energy and settlement of the elastic state, compared with its certificate.

use cannonpile::Pile;
use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile_horizontal::elastic;
use cannonpile_proof::Formulas;
use cannonpile_testkit::proofs::value;
use num_rational::BigRational as Q;

use super::{find, int, prove};

const RIGHT: Formulas = Formulas::LIBRARY;

/// Returns the straight piles of 1 to `layers` layers.
fn piles(layers: i128) -> impl Iterator<Item = Pile> {
    (1..=layers).map(|l| Pile::triangular(l).expect("a pile"))
}

#[test]
fn energy() {
    let proof = prove("elastic-energy");
    for pile in piles(7) {
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

#[test]
fn settlement() {
    let proof = prove("settlement");
    for pile in piles(7).skip(1) {
        let elastic = elastic(&pile, &int(1)).expect("a state");
        let field = &elastic.certificate().expect("a certificate").field;
        let sum: Q = field[&Site::APEX].iter().sum();
        let at = [("L", int(pile.layers()))];
        assert_eq!(value(&proof, "the apex", &at), sum * int(2) / int(3));
    }
}

/// The theorem does not depend on the labels of the coordinates: i and j can be exchanged.
#[test]
fn exchanged_coordinates_give_same_elastic_state() {
    let exchanged = cannonpile::theorem::Formulas {
        above: |i, j, k| (RIGHT.core.above)(j, i, k),
        descent: |sign, direction| {
            let [i, j] = (RIGHT.core.descent)(sign, direction);
            [j, i]
        },
        ..RIGHT.core
    };
    let theorem = find("elastic-straight");
    let proof_of = |core| theorem.prove_for(&Formulas { core, ..RIGHT });
    let proof = proof_of(exchanged);
    assert!(proof.holds(), "{proof:?}");
    // If only one formula is changed, contacts connect the wrong sites.
    for mixed in [
        cannonpile::theorem::Formulas {
            above: RIGHT.core.above,
            ..exchanged
        },
        cannonpile::theorem::Formulas {
            descent: RIGHT.core.descent,
            ..exchanged
        },
    ] {
        assert!(!proof_of(mixed).holds());
    }
}
