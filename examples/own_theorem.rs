//! A new theorem: the elastic energy of the contacts of a straight pile.
//!
//! If every contact is a linear spring, its energy is proportional to the square of its force. This program evaluates the
//! formula of the forces with symbols, squares it, and sums it over the pile. The result holds for every number of layers,
//! without a fit. Run it with `cargo run --example own_theorem`.

use core::num::NonZeroI64;

use cannonpile::formula::{force, increments, transmitted};
use cannonpile::lattice::count;
use cannonpile::scalar::{Algebra, Polynomial, Ring, Symbol};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::{One, Zero};

type P = Polynomial;

/// The denominator of sin φ = 1/2, an equilateral base.
const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();

fn symbol(name: &'static str) -> P {
    Symbol(name).into()
}

/// Returns Σ f² over the contacts of L layers, in f₀² = (mg/(3 cosθ))².
fn energy() -> P {
    let [i, j, k, layers] = ["i", "j", "k", "L"].map(symbol);
    let half = P::one().div_int(TWO);
    let lines = count::above(&i, &j, &k).into_iter().zip(increments(&half));
    // A sphere with n others above it on a contact line receives n increments and transmits n + 1.
    let forces = lines.map(|(n, own)| transmitted(force(n, &own), &own));
    let squares = forces.fold(P::zero(), |sum, f| sum + &(f.clone() * &f));
    // The sites of layer k are 0 ≤ j ≤ k, 0 ≤ i ≤ k − j. The sum ends at layer L − 2, because layer L − 1 is on the floor.
    let zero = P::zero();
    let row = squares.sum(Symbol("i"), &zero, &(k.clone() - &j));
    let layer = row.sum(Symbol("j"), &zero, &k);
    layer.sum(Symbol("k"), &zero, &(layers - &P::from_integer(2)))
}

/// Returns (L−1) L (L+1) (L+2) (2L+1), which is 40 times the energy.
fn claimed() -> P {
    let layers = symbol("L");
    let plus = |n| layers.clone() + &P::from_integer(n);
    plus(-1) * &plus(0) * &plus(1) * &plus(2) * &(layers.clone() + &plus(1))
}

fn main() -> Result<(), Error> {
    let energy = energy();
    println!("Theorem. The squares of all contact forces of a straight pile of L layers sum to");
    println!("(L-1) L (L+1) (L+2) (2L+1) / 40 in units of (mg/(3 cosθ))^2.\n");
    println!("Proof. Summed over the pile, the formulas give\n  {energy}");
    // Polynomials that are equal are equal for every L, so this line is the proof.
    assert_eq!(energy.clone() * &P::from_integer(40), claimed());
    println!("which, times 40, is\n  {}\nas claimed.\n", claimed());

    // The comparison rejects a slightly different polynomial.
    let nearly = claimed() + &(symbol("L") - &P::one());
    assert_ne!(energy.clone() * &P::from_integer(40), nearly);

    // Numerical piles agree with the theorem.
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
