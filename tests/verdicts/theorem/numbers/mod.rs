//! Theorems evaluated at numbers. The polynomials take the values of counts and sums on real piles.

mod balance;
mod base;
mod counts;

use cannonpile::Pile;
use cannonpile::lattice::Site;
use cannonpile::theorem;
use cannonpile::theorem::{Formulas, Proof};
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::{evaluated, value};
use cannonpile_testkit::rational::ratio;
use num_rational::BigRational as Q;

const RIGHT: Formulas = Formulas::LIBRARY;

fn int(n: i128) -> Q {
    Q::from_integer(n.into())
}

fn prove(name: &str) -> Proof {
    theorem::find(name).expect("a theorem").prove()
}

/// The values of the symbols i, j, k.
fn at_site(Site { i, j, k }: Site) -> Vec<(&'static str, Q)> {
    vec![("i", int(i)), ("j", int(j)), ("k", int(k))]
}

/// Values of sin φ: that of the equilateral base, values on both sides of it, and one close to zero.
fn sines() -> [Q; 5] {
    [(1, 2), (1, 3), (2, 5), (7, 9), (1, 1000)].map(|(n, d)| ratio(n, d))
}

/// Piles of 1 to `layers` layers on every base.
fn piles(layers: i128) -> impl Iterator<Item = Pile> {
    let of_one_base =
        move |s: Q| (1..=layers).map(move |l| Pile::isosceles(l, s.clone()).expect("a pile"));
    sines().into_iter().flat_map(of_one_base)
}

/// Piles of 1 to `layers` layers on an equilateral base.
fn equilateral_piles(layers: i128) -> impl Iterator<Item = Pile> {
    (1..=layers).map(|l| Pile::triangular(l).expect("a pile"))
}

#[test]
fn sides_agree_at_every_point() {
    let theorems: Vec<_> = theorem::all().collect();
    proofs::sides_agree_at_every_point(&theorems);
}
