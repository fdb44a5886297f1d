//! A theorem of one's own: how much energy do the contacts of a cannonball stack store?
//!
//! The energy of a linear spring is proportional to the square of its force. This program runs the force formula on
//! symbols, squares it and sums over the pile, so the result holds for every number of layers. Run it with
//! `cargo run --example own_theorem`.

use core::num::NonZeroI64;

use cannonpile::formula::{force, increments, passed_on};
use cannonpile::lattice::count;
use cannonpile::scalar::{Algebra, Polynomial, Ring, Symbol};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::{One, Zero};

type P = Polynomial;

/// sin φ is 1/2 on an equilateral base.
const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();

fn symbol(name: &'static str) -> P {
    Symbol(name).into()
}

/// Σ f² over the contacts of L layers, in f₀² = (mg/(3 cosθ))².
fn energy() -> P {
    let [i, j, k, layers] = ["i", "j", "k", "L"].map(symbol);
    let half = P::one().div_int(TWO);
    let lines = count::above(&i, &j, &k).into_iter().zip(increments(&half));
    // A sphere with n others above it on a line receives n increments along it, and passes one more on.
    let forces = lines.map(|(n, own)| passed_on(force(n, &own), &own));
    let squares = forces.fold(P::zero(), |sum, f| sum + &(f.clone() * &f));
    // The sites of layer k are 0 ≤ j ≤ k, 0 ≤ i ≤ k − j; those of layer L − 1 have the floor below.
    let zero = P::zero();
    let row = squares.sum(Symbol("i"), &zero, &(k.clone() - &j));
    let layer = row.sum(Symbol("j"), &zero, &k);
    layer.sum(Symbol("k"), &zero, &(layers - &P::from_i128(2)))
}

/// Returns (L−1) L (L+1) (L+2) (2L+1), forty times the energy.
fn claimed() -> P {
    let layers = symbol("L");
    let plus = |n| layers.clone() + &P::from_i128(n);
    plus(-1) * &plus(0) * &plus(1) * &plus(2) * &(layers.clone() + &plus(1))
}

fn main() -> Result<(), Error> {
    let energy = energy();
    println!("Theorem. The squares of all contact forces of a stack of L layers sum to");
    println!("(L-1) L (L+1) (L+2) (2L+1) / 40 in units of (mg/(3 cosθ))^2.\n");
    println!("Proof. Summed over the pile, the formulas give\n  {energy}");
    // Two polynomials are equal if and only if they are the same function: this is the proof.
    assert_eq!(energy.clone() * &P::from_i128(40), claimed());
    println!("which, times 40, is\n  {}\nas claimed.\n", claimed());

    // Nearly right is not right.
    let nearly = claimed() + &(symbol("L") - &P::one());
    assert_ne!(energy.clone() * &P::from_i128(40), nearly);

    // Nobody has to believe it: piles of numbers agree.
    println!("   L   sum of squares");
    for layers in 1..=12 {
        let pile = Pile::triangular(layers)?;
        let contacts = pile.forces::<BigRational>().contacts(Selection::All)?;
        let sum = contacts
            .map(|contact| contact.map(|c| &c.force * &c.force))
            .sum::<Result<BigRational, _>>()?;
        println!("{layers:>4}   {sum}");
        let value = BigRational::from_integer(layers.into());
        assert_eq!(energy.evaluate(&[(Symbol("L"), value)]), Some(sum));
    }
    Ok(())
}
