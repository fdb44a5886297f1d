//! The data that determine the forces of a pile.

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

/// The system of equations of a pile (paper, (4) and (5)): sites and steps, increments of an ordinary sphere,
/// directions of the lines, weights and loads. This is all that an engine reads of a pile.
#[derive(Clone, Debug)]
pub(crate) struct System<'p> {
    pub(crate) shape: &'p Shape,
    /// The increments of an ordinary sphere of weight mg.
    pub(crate) increments: [BigRational; 3],
    /// The directions under a + step.
    pub(crate) directions: [Vector<BigRational>; 3],
    pub(crate) loading: &'p Loading,
}

/// The force on a sphere in addition to an ordinary weight.
pub(crate) struct Extra {
    pub(crate) site: Site,
    /// The additional weight, in mg.
    pub(crate) weight: BigRational,
    /// The additional forces along its lines, by direction.
    pub(crate) lines: [BigRational; 3],
}

impl System<'_> {
    /// Returns the forces on spheres in addition to ordinary weights, in any order.
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

    /// Returns the common denominator D of all increments, of all extra weights and loads times increments, and of the
    /// forces of horizontal contacts.
    pub(crate) fn denominator(&self) -> BigInt {
        let own = common_denominator(&self.increments);
        let forces = self.loading.horizontal().map(|(_, force)| force);
        let extras = self.loading.extras();
        own * extras.fold(common_denominator(forces), |common, (_, weight)| {
            common_multiple(common, weight.denom())
        })
    }

    /// Returns two magnitudes, times the common denominator. The first is the largest increment of an ordinary sphere.
    /// The second is the sum of the absolute values of all extra weights, loads and forces that horizontal contacts add
    /// to lines.
    pub(crate) fn magnitudes(&self) -> [BigInt; 2] {
        let denominator = self.denominator();
        // The results are integers, because the denominator is a multiple of all denominators.
        let over = |value: &BigRational| value.numer().abs() * (&denominator / value.denom());
        let weights = self.loading.extras().map(|(_, extra)| over(&extra));
        let pushes = self.loading.pushes().values().flatten().map(over);
        let extras = weights.chain(pushes).sum();
        let per_line = self.increments.iter();
        let ordinary = per_line.map(|w| over(&formula::force(self.loading.ordinary(), w)));
        [ordinary.fold(BigInt::zero(), BigInt::max), extras]
    }

    /// Returns whether each of the three directions has contacts in a layer. In a pile of discs the third line carries
    /// no force.
    pub(crate) fn fills_its_layers(&self) -> bool {
        self.shape.dimension() == Dimension::Three
    }

    /// Returns whether the stacking has no sign change.
    pub(crate) fn is_straight(&self) -> bool {
        self.shape.stacking().is_straight()
    }

    /// Returns whether every sphere has the weight mg and carries no load or horizontal force. Then a straight pile has
    /// few distinct forces.
    pub(crate) fn is_even(&self) -> bool {
        !self.loading.is_weightless() && self.loading.is_ordinary()
    }
}
