//! The data that determine the forces of a pile.

use alloc::borrow::Cow;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::Loading;
use crate::each::Each;
use crate::formula;
use crate::geometry::{Load, Vector};
use crate::lattice::{Dimension, Sign, Site};
use crate::scalar::{Ring, common_denominator, common_multiple};
use crate::shape::Shape;

/// The system of equations of a pile (paper, (4) and (5)): sites and steps, increments of an ordinary sphere,
/// directions of the lines, weights and loads. This is all that an engine reads of a pile.
#[derive(Clone, Debug)]
pub(crate) struct System<'p> {
    pub(crate) shape: &'p Shape,
    pub(crate) sin_phi: &'p BigRational,
    /// The increments of a sphere of weight mg under vertical gravity.
    pub(crate) increments: [BigRational; 3],
    /// W, their sum.
    pub(crate) increment_sum: BigRational,
    /// The directions under a + step.
    pub(crate) directions: [Vector<BigRational>; 3],
    pub(crate) loading: Cow<'p, Loading>,
    /// Whether loads or a tilt in the scalar of the forces act on the pile as well.
    pub(crate) has_scalar_loads: bool,
}

/// The force on a sphere, less gravity on an ordinary one.
pub(crate) struct Extra {
    pub(crate) site: Site,
    pub(crate) load: Load,
    /// The additional forces along its lines, by direction.
    pub(crate) lines: [BigRational; 3],
}

impl System<'_> {
    /// Returns what a sphere with a load adds to its lines above a step of the given sign.
    pub(crate) fn load_increments(&self, load: &Load, sign: Sign) -> [BigRational; 3] {
        if load.is_vertical() {
            let own = |w| formula::force(load.down.clone(), w);
            return self.increments.each_ref().each(own);
        }
        self.load_increments_of(load, self.sin_phi, sign)
    }

    /// Returns what a sphere adds to its lines, in the ring of its load, which contains `s`, the value of sin φ.
    pub(crate) fn load_increments_of<N: Ring>(&self, load: &Load<N>, s: &N, sign: Sign) -> [N; 3] {
        match self.shape.dimension() {
            Dimension::Two => formula::disc_load_increments(load, sign),
            Dimension::Three => formula::load_increments(load, s, sign),
        }
    }

    /// Returns the increments of an ordinary sphere above a step of the given sign.
    pub(crate) fn ordinary(&self, sign: Sign) -> [BigRational; 3] {
        self.load_increments(&self.loading.ordinary(), sign)
    }

    /// Returns the spheres on which the force differs from gravity on an ordinary one, in their order.
    pub(crate) fn extras(&self) -> impl Iterator<Item = Extra> {
        self.loading.extras().map(|(site, load, pushes)| {
            // The sphere below which there is no step is on the floor, and its lines carry nothing.
            let sign = self.shape.sign_below(site.k).unwrap_or(Sign::Plus);
            let mut lines = self.load_increments(&load, sign);
            for (line, push) in lines.iter_mut().zip(pushes.into_iter().flatten()) {
                *line += push;
            }
            Extra { site, load, lines }
        })
    }

    /// Returns a common denominator D of all increments, and of W times all loads. It is the denominator of 2s, times the
    /// common denominator of tilt, loads and horizontal forces. It need not be the least one.
    pub(crate) fn denominator(&self) -> BigInt {
        let horizontal = self.loading.horizontal();
        let horizontal = horizontal.into_iter().map(|(_, force)| force);
        let given = common_denominator(self.loading.tilt().iter().chain(horizontal));
        let given = self.loading.extras().fold(given, |common, (_, load, _)| {
            let denominators = [&load.down, &load.x, &load.y].each(BigRational::denom);
            denominators.into_iter().fold(common, common_multiple)
        });
        common_denominator(&self.increments) * given
    }

    /// Returns two magnitudes, times the common denominator. The first is the largest increment of an ordinary sphere.
    /// The second is the sum, over all other spheres, of the largest absolute value that they add to a line beyond
    /// this.
    pub(crate) fn magnitudes(&self) -> [BigInt; 2] {
        let denominator = self.denominator();
        // The results are integers, because the denominator is a multiple of all denominators.
        let over = |value: &BigRational| value.numer().abs() * (&denominator / value.denom());
        let greatest =
            |lines: &[BigRational; 3]| lines.iter().map(over).fold(BigInt::zero(), BigInt::max);
        let ordinary = [Sign::Plus, Sign::Minus].each(|sign| greatest(&self.ordinary(sign)));
        let extras = self.extras().map(|extra| greatest(&extra.lines)).sum();
        let [plus, minus] = ordinary;
        [plus.max(minus), extras]
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

    /// Returns whether every sphere has the weight mg and carries no load or horizontal contact force. Then a straight
    /// pile has few distinct forces.
    pub(crate) fn has_unit_weights(&self) -> bool {
        !self.loading.is_weightless() && self.has_no_loads()
    }

    /// Returns whether every sphere has the ordinary weight and carries no load or horizontal contact force.
    pub(crate) fn has_no_loads(&self) -> bool {
        !self.has_scalar_loads && self.loading.has_no_loads()
    }

    /// Returns whether gravity on ordinary spheres is vertical.
    pub(crate) fn gravity_is_vertical(&self) -> bool {
        !self.has_scalar_loads && self.loading.ordinary().is_vertical()
    }
}
