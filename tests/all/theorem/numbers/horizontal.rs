//! Energy and settlement of the elastic state, as its certificate has them.

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use num_rational::BigRational as Q;

use super::{equilateral_piles, int, prove, value};

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
