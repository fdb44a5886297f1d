//! Theorems evaluated at numbers: energy and settlement of the elastic state, compared with its certificate.

use cannonpile::Pile;
use cannonpile::lattice::Site;
use cannonpile::scalar::Ring;
use cannonpile::shape::Selection;
use cannonpile_horizontal::elastic;
use cannonpile_horizontal::theorem;
use cannonpile_horizontal::theorem::{Formulas, Theorem};
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::value;
use num_rational::BigRational as Q;

const RIGHT: Formulas = Formulas::LIBRARY;

fn int(n: i128) -> Q {
    Q::from_i128(n)
}

fn find(name: &str) -> &'static Theorem {
    let mut theorems = theorem::all();
    let found = theorems.find(|theorem| theorem.name == name);
    found.expect("a theorem")
}

/// Returns the straight piles of 1 to `layers` layers.
fn piles(layers: i128) -> impl Iterator<Item = Pile> {
    (1..=layers).map(|l| Pile::triangular(l).expect("a pile"))
}

#[test]
fn sides_agree_at_every_point() {
    let theorems: Vec<_> = theorem::all().collect();
    proofs::sides_agree_at_every_point(&theorems);
}

#[test]
fn energy() {
    let proof = find("elastic-energy").prove();
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
    let proof = find("settlement").prove();
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
