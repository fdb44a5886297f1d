//! Symbols, sums over piles, and the constants of a pile, for the proofs.

use alloc::format;
use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::{Formulas, Step};
use crate::each::Each;
use crate::geometry::Vector;
use crate::scalar::{Algebra, Polynomial, Ring, Symbol, TWO};

pub type P = Polynomial;

/// Returns a symbol as a polynomial.
#[must_use]
pub fn symbol(name: &'static str) -> P {
    Symbol(name).into()
}

/// Returns an integer as a polynomial.
#[must_use]
pub fn int(n: i128) -> P {
    P::from_integer(n)
}

/// Returns 1/2.
#[must_use]
pub fn half() -> P {
    int(1).div_int(TWO)
}

/// The constants of a pile of L layers with sin φ = s, computed with given formulas.
pub struct Setting {
    /// sin φ.
    pub s: P,
    pub increments: [P; 3],
    /// W.
    pub weight: P,
    pub directions: [Vector<P>; 3],
}

impl Setting {
    /// Returns the constants for any sin φ: the symbol s.
    #[must_use]
    pub fn isosceles(f: &Formulas) -> Self {
        Self::with_sin_phi(f, symbol("s"))
    }

    /// Returns the constants for s = 1/2.
    #[must_use]
    pub fn equilateral(f: &Formulas) -> Self {
        Self::with_sin_phi(f, half())
    }

    /// Returns the constants of the pile of discs: s = 0, with the directions of discs.
    #[must_use]
    pub fn discs(f: &Formulas) -> Self {
        Self {
            directions: (f.disc_directions)(),
            ..Self::with_sin_phi(f, P::zero())
        }
    }

    fn with_sin_phi(f: &Formulas, s: P) -> Self {
        let increments = (f.increments)(&s);
        Self {
            weight: (f.weight)(&increments),
            increments,
            directions: (f.directions)(&s),
            s,
        }
    }

    /// Returns the forces from above on a sphere, from the number of spheres above on each line.
    #[must_use]
    pub fn received(&self, f: &Formulas, counts: &[P; 3]) -> [P; 3] {
        on_lines(f.force, counts.clone(), &self.increments)
    }

    /// Returns the forces that a sphere transmits below, from the forces from above.
    #[must_use]
    pub fn to_below(&self, f: &Formulas, from_above: [P; 3]) -> [P; 3] {
        transmitted(f, from_above, &self.increments)
    }

    /// Returns the increments of a sphere of weight `n`, and the weight in the unit of forces.
    #[must_use]
    pub fn loaded(&self, f: &Formulas, n: &P) -> ([P; 3], P) {
        let own = self.received(f, &[n.clone(), n.clone(), n.clone()]);
        (own, (f.force)(n.clone(), &self.weight))
    }

    /// Returns the unit vectors along contacts under − steps.
    #[must_use]
    pub fn turned_directions(&self, f: &Formulas) -> [Vector<P>; 3] {
        self.directions.clone().each(f.turned_about_z)
    }

    /// Returns the load of a sphere on its supports, from its weight and the number of spheres above on each line.
    #[must_use]
    pub fn support_load(&self, f: &Formulas, above: &[P; 3]) -> Vector<P> {
        (f.support_load)(&self.received(f, above), &self.directions, &self.weight)
    }

    /// Returns the sum of all forces on a sphere, from the number of spheres above on each line.
    #[must_use]
    pub fn unbalanced(&self, f: &Formulas, above: &[P; 3]) -> Vector<P> {
        let from_above = self.received(f, above);
        let to_below = self.to_below(f, from_above.clone());
        let e = &self.directions;
        (f.unbalanced)(&to_below, e, &from_above, e, &self.weight)
    }

    /// Returns the squared horizontal length of a vector, over sin²θ: x² + 4(1−s²)·y².
    #[must_use]
    pub fn horizontal_square(&self, v: &Vector<P>) -> P {
        let across = int(4) * &(P::one() - &(self.s.clone() * &self.s));
        v.x.clone() * &v.x + &(across * &(v.y.clone() * &v.y))
    }
}

/// Returns the forces that a sphere transmits along its three lines, from the received forces and its increments.
#[must_use]
pub fn transmitted(f: &Formulas, forces: [P; 3], own: &[P; 3]) -> [P; 3] {
    on_lines(f.transmitted, forces, own)
}

fn on_lines(formula: fn(P, &P) -> P, [a, b, c]: [P; 3], [x, y, z]: &[P; 3]) -> [P; 3] {
    [formula(a, x), formula(b, y), formula(c, z)]
}

/// Returns the cross product, with one factor for each component from the units of the vectors.
#[must_use]
pub fn cross(v: &Vector<P>, w: &Vector<P>) -> Vector<P> {
    Vector {
        x: v.y.clone() * &w.z - &(v.z.clone() * &w.y),
        y: v.z.clone() * &w.x - &(v.x.clone() * &w.z),
        z: v.x.clone() * &w.y - &(v.y.clone() * &w.x),
    }
}

/// Returns one step for each component of two vectors.
#[must_use]
pub fn by_component(claim: &str, left: Vector<P>, right: Vector<P>) -> Vec<Step> {
    let sides = left.into_array().into_iter().zip(right.into_array());
    let sides = ["x", "y", "z"].into_iter().zip(sides);
    sides
        .map(|(axis, (left, right))| Step::equal(format!("{axis}: {claim}"), left, right))
        .collect()
}

/// Returns one step for each component of a vector, with the claim that it is zero.
#[must_use]
pub fn nothing_left(claim: &str, left: Vector<P>) -> Vec<Step> {
    by_component(claim, left, Vector::zero())
}

/// Returns one step for each of three lines.
pub fn by_line(claim: &str, left: [P; 3], right: [P; 3]) -> impl Iterator<Item = Step> {
    let sides = left.into_iter().zip(right);
    sides.map(move |(left, right)| Step::equal(claim, left, right))
}

/// Returns the steps `claim: left => right`, where both sides are the same polynomial. A claim is a literal, or a text
/// in parentheses.
#[doc(hidden)]
#[macro_export]
macro_rules! equations {
    ($($claim:literal: $left:expr => $right:expr),+ $(,)?) => {
        $crate::theorem::setting::equations! { $(($claim): $left => $right),+ }
    };
    ($(($claim:expr): $left:expr => $right:expr),+ $(,)?) => {
        $crate::theorem::setting::listed([$($crate::theorem::Step::equal($claim, $left, $right)),+])
    };
}

pub use equations;

/// Returns the steps as a list.
#[must_use]
pub fn listed<const N: usize>(steps: [Step; N]) -> Vec<Step> {
    steps.into()
}

/// Returns the counts of spheres above (i, j, k), all symbols.
#[must_use]
pub fn above(f: &Formulas) -> [P; 3] {
    (f.above)(&symbol("i"), &symbol("j"), &symbol("k"))
}

/// Returns the counts of spheres above (i, j) on the floor of L layers.
#[must_use]
pub fn above_floor(f: &Formulas) -> [P; 3] {
    (f.above)(&symbol("i"), &symbol("j"), &last_layer())
}

/// Returns L − 1.
#[must_use]
pub fn last_layer() -> P {
    symbol("L") - &P::one()
}

/// Returns the sum over the sites (i, j) of layer `k`.
#[must_use]
pub fn sum_over_layer(p: &P, k: &P) -> P {
    let zero = P::zero();
    let row = p.sum(Symbol("i"), &zero, &(k.clone() - &symbol("j")));
    row.sum(Symbol("j"), &zero, k)
}

/// Returns the sum over the bottom layer of L layers.
#[must_use]
pub fn sum_over_base(p: &P) -> P {
    sum_over_layer(p, &last_layer())
}

/// Returns the sum over all spheres of L layers, for a polynomial in i, j, k.
#[must_use]
pub fn sum_over_pile(p: &P) -> P {
    sum_over_layers(p, &last_layer())
}

/// Returns the sum over the spheres above the floor.
#[must_use]
pub fn sum_off_floor(p: &P) -> P {
    sum_over_layers(p, &(last_layer() - &P::one()))
}

fn sum_over_layers(p: &P, last: &P) -> P {
    sum_over_layer(p, &symbol("k")).sum(Symbol("k"), &P::zero(), last)
}
