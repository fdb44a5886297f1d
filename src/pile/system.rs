//! What the forces of a pile depend on.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::Loading;
use crate::geometry::Vector;
use crate::lattice::Dimension;
use crate::shape::Shape;

/// The system of equations of a pile, paper, (4) and (5): its sites and steps, what an ordinary sphere adds to its three
/// lines, the directions of the lines, weights and loads. Engines solve it and know nothing else of a pile.
#[derive(Clone, Debug)]
pub(crate) struct System<'p> {
    pub(crate) shape: &'p Shape,
    /// Of an ordinary sphere that weighs mg.
    pub(crate) increments: [BigRational; 3],
    /// Under a + step.
    pub(crate) directions: [Vector<BigRational>; 3],
    pub(crate) loading: &'p Loading,
}

impl System<'_> {
    /// Returns the common denominator D of all increments, and of all extra weights and loads times increments.
    pub(crate) fn denominator(&self) -> BigInt {
        let per_line = self.increments.iter();
        let own = per_line.fold(BigInt::one(), |d, w| d.lcm(w.denom()));
        let extras = self.loading.extras();
        own * extras.fold(BigInt::one(), |d, (_, w)| d.lcm(w.denom()))
    }

    /// Returns the greatest increment of an ordinary sphere, and the sum of all extra weights and loads without their
    /// signs, both times the common denominator.
    pub(crate) fn magnitudes(&self) -> [BigInt; 2] {
        let scale = BigRational::from_integer(self.denominator());
        let extras = self.loading.extras().map(|(_, extra)| extra.abs());
        let extras = extras.fold(BigRational::zero(), |sum, extra| sum + extra);
        let per_line = self.increments.iter();
        let greatest = per_line.fold(BigRational::zero(), |most, w| most.max(w.clone()));
        let ordinary = greatest * self.loading.ordinary();
        // Integers: the scale is a multiple of all denominators.
        [ordinary, extras].map(|value| (value * &scale).to_integer())
    }

    /// Whether every direction has a place in a layer: the third line of a disc carries nothing and has none.
    pub(crate) fn fills_its_layers(&self) -> bool {
        self.shape.dimension() == Dimension::Three
    }

    /// Whether there is a change of sign nowhere.
    pub(crate) fn is_straight(&self) -> bool {
        self.shape.stacking().is_straight()
    }

    /// Whether every sphere weighs mg and carries no load of its own, so that a straight pile has few distinct forces.
    pub(crate) fn is_even(&self) -> bool {
        !self.loading.is_weightless() && self.loading.extras().next().is_none()
    }
}
