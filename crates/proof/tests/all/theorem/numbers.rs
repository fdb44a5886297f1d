//! The theorems of this crate evaluated at numbers. The polynomials take the values of sums on real piles.

mod dimensions;
mod horizontal;
mod loads;

use cannonpile::theorem::{Proof, Theorem};
use cannonpile_proof::Formulas;
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::{evaluated, value};
use cannonpile_testkit::rational::ratio;
use num_rational::BigRational as Q;

fn int(n: i128) -> Q {
    Q::from_integer(n.into())
}

fn find(name: &str) -> &'static Theorem<Formulas> {
    let mut theorems = cannonpile_proof::own();
    let found = theorems.find(|theorem| theorem.name == name);
    found.expect("a theorem")
}

fn prove(name: &str) -> Proof {
    find(name).prove()
}

#[test]
fn sides_agree_at_every_point() {
    let theorems: Vec<_> = cannonpile_proof::own().collect();
    proofs::sides_agree_at_every_point(&theorems);
}
