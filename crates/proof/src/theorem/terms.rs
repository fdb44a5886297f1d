//! Sums and products of polynomials, and the transfer of forces, for the theorems of this crate.

use core::num::NonZeroI64;

use cannonpile::each::Each;
use cannonpile::lattice::{Direction, Sign};
use cannonpile::theorem;
use cannonpile::theorem::Formulas;
use cannonpile::theorem::setting::{P, int, symbol};
use num_traits::{One, Zero};

/// A theorem of this crate.
pub(super) type Theorem = theorem::Theorem<crate::Formulas>;

// The compiler evaluates each `unwrap`, and rejects zero.
pub(super) const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();
pub(super) const THREE: NonZeroI64 = NonZeroI64::new(3).unwrap();

/// The Hägg signs, as claims write them.
pub(super) const SIGNS: [(&str, Sign); 2] = [("+", Sign::Plus), ("−", Sign::Minus)];

pub(super) fn symbols(names: [&'static str; 3]) -> [P; 3] {
    names.each(symbol)
}

pub(super) fn sum(terms: impl IntoIterator<Item = P>) -> P {
    terms.into_iter().fold(P::zero(), |sum, term| sum + &term)
}

pub(super) fn square(x: &P) -> P {
    x.clone() * x
}

pub(super) fn power(x: &P, n: usize) -> P {
    (0..n).fold(P::one(), |power, _| power * x)
}

/// Returns 1 for one line, and 0 for the others.
pub(super) fn unit(line: usize) -> [P; 3] {
    [0, 1, 2].each(|other: usize| int(i128::from(other == line)))
}

/// Returns T g: the half-turn of g if the sign changes, otherwise g.
pub(super) fn transferred(f: &Formulas, changes: bool, g: &[P; 3]) -> [P; 3] {
    if changes { (f.half_turn)(g) } else { g.clone() }
}

/// Returns a value on one line, and 0 on the others.
pub(super) fn on(line: Direction, value: &P) -> [P; 3] {
    unit(line.index()).each(|one| one * value)
}

/// Returns the same value on all three lines.
pub(super) fn each(value: i128) -> [P; 3] {
    [value; 3].each(int)
}

pub(super) fn plus([a, b, c]: [P; 3], [x, y, z]: &[P; 3]) -> [P; 3] {
    [a + x, b + y, c + z]
}

/// Returns the forces that a sphere transmits, with `g` from above and the sum H of its horizontal forces.
pub(super) fn beside(f: &Formulas, g: &[P; 3], own: &P, pushed: &[P; 3], sign: Sign) -> [P; 3] {
    [0, 1, 2].each(|l: usize| (f.beside)(g[l].clone(), own, &pushed[l], sign))
}
