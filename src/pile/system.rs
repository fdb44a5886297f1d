//! What the forces of a pile depend on.

use alloc::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::Loading;
use crate::formula;
use crate::geometry::Vector;
use crate::lattice::{Dimension, Site};
use crate::scalar::{common_denominator, common_multiple};
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

/// What acts on a sphere beside an ordinary weight.
pub(crate) struct Extra {
    pub(crate) site: Site,
    /// In mg.
    pub(crate) weight: BigRational,
    /// On its lines, by direction.
    pub(crate) lines: [BigRational; 3],
}

impl System<'_> {
    /// Returns what acts on spheres beside an ordinary weight, in no order.
    pub(crate) fn extras(&self) -> impl Iterator<Item = Extra> {
        let pushes = self.loading.pushes();
        let mut weights: BTreeMap<Site, BigRational> = self.loading.extras().collect();
        for site in pushes.keys() {
            weights.entry(*site).or_default();
        }
        weights.into_iter().map(move |(site, weight)| {
            let own = |w: &BigRational| formula::force(weight.clone(), w);
            let mut lines = self.increments.each_ref().map(own);
            for (line, push) in lines
                .iter_mut()
                .zip(pushes.get(&site).into_iter().flatten())
            {
                *line += push;
            }
            Extra {
                site,
                weight,
                lines,
            }
        })
    }

    /// Returns the common denominator D of all increments, and of all extra weights and loads times increments and forces of
    /// horizontal contacts.
    pub(crate) fn denominator(&self) -> BigInt {
        let own = common_denominator(&self.increments);
        let forces = self.loading.horizontal().map(|(_, force)| force);
        let extras = self.loading.extras();
        own * extras.fold(common_denominator(forces), |common, (_, weight)| {
            common_multiple(common, weight.denom())
        })
    }

    /// Returns the greatest increment of an ordinary sphere, and the sum of all extra weights and loads, and of what
    /// horizontal contacts add to lines, without their signs, both times the common denominator.
    pub(crate) fn magnitudes(&self) -> [BigInt; 2] {
        let denominator = self.denominator();
        // Integers: the denominator is a multiple of all.
        let over = |value: &BigRational| value.numer().abs() * (&denominator / value.denom());
        let weights = self.loading.extras().map(|(_, extra)| over(&extra));
        let pushes = self.loading.pushes().values().flatten().map(over);
        let extras = weights.chain(pushes).sum();
        let per_line = self.increments.iter();
        let ordinary = per_line.map(|w| over(&formula::force(self.loading.ordinary(), w)));
        [ordinary.fold(BigInt::zero(), BigInt::max), extras]
    }

    /// Whether every direction has a place in a layer: the third line of a disc carries nothing and has none.
    pub(crate) fn fills_its_layers(&self) -> bool {
        self.shape.dimension() == Dimension::Three
    }

    /// Whether there is a change of sign nowhere.
    pub(crate) fn is_straight(&self) -> bool {
        self.shape.stacking().is_straight()
    }

    /// Whether every sphere weighs mg and nothing else acts on it, so that a straight pile has few distinct forces.
    pub(crate) fn is_even(&self) -> bool {
        !self.loading.is_weightless() && self.loading.is_ordinary()
    }
}
