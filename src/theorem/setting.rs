//! Symbols, sums over piles, and what a pile is made of, for the proofs.

use alloc::format;
use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::{Formulas, Step};
use crate::geometry::Vector;
use crate::scalar::{Algebra, Polynomial, Ring, Symbol, TWO};

pub type P = Polynomial;

/// A symbol as a polynomial.
#[must_use]
pub fn symbol(name: &'static str) -> P {
    Symbol(name).into()
}

/// An integer as a polynomial.
#[must_use]
pub fn int(n: i128) -> P {
    P::from_i128(n)
}

/// 1/2.
#[must_use]
pub fn half() -> P {
    int(1).div_int(TWO)
}

/// A pile of L layers with sin φ = s, as its formulas give it.
pub struct Setting {
    /// sin φ.
    pub s: P,
    pub increments: [P; 3],
    /// W.
    pub weight: P,
    pub directions: [Vector<P>; 3],
}

impl Setting {
    /// Any sin φ: the symbol s.
    #[must_use]
    pub fn isosceles(f: &Formulas) -> Self {
        Self::with_sin_phi(f, symbol("s"))
    }

    /// s = 1/2.
    #[must_use]
    pub fn equilateral(f: &Formulas) -> Self {
        Self::with_sin_phi(f, half())
    }

    /// The pile of discs: s = 0, in its own directions.
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

    /// The forces from above on a sphere with so many above it on its lines.
    #[must_use]
    pub fn received(&self, f: &Formulas, [a, b, c]: &[P; 3]) -> [P; 3] {
        let [w_a, w_b, w_c] = &self.increments;
        [
            (f.force)(a.clone(), w_a),
            (f.force)(b.clone(), w_b),
            (f.force)(c.clone(), w_c),
        ]
    }

    /// What a sphere passes on of the forces from above.
    #[must_use]
    pub fn to_below(&self, f: &Formulas, from_above: [P; 3]) -> [P; 3] {
        transmitted(f, from_above, &self.increments)
    }

    /// What a sphere of weight `n` adds to its lines, and that weight in the unit of forces.
    #[must_use]
    pub fn loaded(&self, f: &Formulas, n: &P) -> ([P; 3], P) {
        let own = self.received(f, &[n.clone(), n.clone(), n.clone()]);
        (own, (f.force)(n.clone(), &self.weight))
    }

    /// The unit vectors along contacts under − steps.
    #[must_use]
    pub fn turned_directions(&self, f: &Formulas) -> [Vector<P>; 3] {
        self.directions.clone().map(f.turned_about_z)
    }

    /// What a sphere with so many above it on its lines hands on, by the forces from above and its weight.
    #[must_use]
    pub fn support_load(&self, f: &Formulas, above: &[P; 3]) -> Vector<P> {
        (f.support_load)(&self.received(f, above), &self.directions, &self.weight)
    }

    /// What is left over of all forces on such a sphere.
    #[must_use]
    pub fn unbalanced(&self, f: &Formulas, above: &[P; 3]) -> Vector<P> {
        let from_above = self.received(f, above);
        let to_below = self.to_below(f, from_above.clone());
        let e = &self.directions;
        (f.unbalanced)(&to_below, e, &from_above, e, &self.weight)
    }

    /// The squared horizontal length of a vector, over sin²θ: x² + 4(1−s²)·y².
    #[must_use]
    pub fn horizontal_square(&self, v: &Vector<P>) -> P {
        let across = int(4) * &(P::one() - &(self.s.clone() * &self.s));
        v.x.clone() * &v.x + &(across * &(v.y.clone() * &v.y))
    }
}

/// What a sphere passes on along its three lines, from what it receives and adds.
#[must_use]
pub fn transmitted(f: &Formulas, [a, b, c]: [P; 3], own: &[P; 3]) -> [P; 3] {
    let [own_a, own_b, own_c] = own;
    [
        (f.transmitted)(a, own_a),
        (f.transmitted)(b, own_b),
        (f.transmitted)(c, own_c),
    ]
}

/// One step for each component of two vectors.
#[must_use]
pub fn by_component(claim: &str, left: Vector<P>, right: Vector<P>) -> Vec<Step> {
    let sides = left.into_array().into_iter().zip(right.into_array());
    let sides = ["x", "y", "z"].into_iter().zip(sides);
    sides
        .map(|(axis, (left, right))| Step::equal(format!("{axis}: {claim}"), left, right))
        .collect()
}

/// One step for each component: nothing is left over.
#[must_use]
pub fn nothing_left(claim: &str, left: Vector<P>) -> Vec<Step> {
    by_component(claim, left, Vector::zero())
}

/// One step for each of three lines.
pub fn by_line(claim: &str, left: [P; 3], right: [P; 3]) -> impl Iterator<Item = Step> {
    let sides = left.into_iter().zip(right);
    sides.map(move |(left, right)| Step::equal(claim, left, right))
}

/// The steps that say `claim: left => right`, the two sides being the same polynomial. A claim is a literal, or a text in
/// parentheses.
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

/// The counts of spheres above (i, j, k), all symbols.
#[must_use]
pub fn above(f: &Formulas) -> [P; 3] {
    (f.above)(&symbol("i"), &symbol("j"), &symbol("k"))
}

/// The counts of spheres above (i, j) on the floor of L layers.
#[must_use]
pub fn above_floor(f: &Formulas) -> [P; 3] {
    (f.above)(&symbol("i"), &symbol("j"), &last_layer())
}

/// L − 1.
#[must_use]
pub fn last_layer() -> P {
    symbol("L") - &P::one()
}

/// Σ over the sites (i, j) of layer `k`.
#[must_use]
pub fn sum_over_layer(p: &P, k: &P) -> P {
    let zero = P::zero();
    let row = p.sum(Symbol("i"), &zero, &(k.clone() - &symbol("j")));
    row.sum(Symbol("j"), &zero, k)
}

/// Σ over the bottom layer of L layers.
#[must_use]
pub fn sum_over_base(p: &P) -> P {
    sum_over_layer(p, &last_layer())
}

/// Σ over all spheres of L layers, for a polynomial in i, j, k.
#[must_use]
pub fn sum_over_pile(p: &P) -> P {
    sum_over_layers(p, &last_layer())
}

/// Σ over the spheres that do not touch the floor.
#[must_use]
pub fn sum_off_floor(p: &P) -> P {
    sum_over_layers(p, &(last_layer() - &P::one()))
}

fn sum_over_layers(p: &P, last: &P) -> P {
    sum_over_layer(p, &symbol("k")).sum(Symbol("k"), &P::zero(), last)
}
