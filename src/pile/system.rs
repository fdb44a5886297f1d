//! The system of equations of a pile (paper, (4) and (5)): what each sphere adds to its lines, as rationals.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::Pile;
use crate::each::Each;
use crate::formula;
use crate::geometry::Load;
use crate::lattice::{Dimension, Sign, Site};
use crate::scalar::{Ring, common_denominator, common_multiple};

/// The force on a sphere, less gravity on an ordinary one.
pub(crate) struct Extra {
    pub(crate) site: Site,
    pub(crate) load: Load,
    /// The additional forces along its lines, by direction.
    pub(crate) lines: [BigRational; 3],
}

impl Pile {
    /// Returns the increments of a sphere of weight mg under vertical gravity.
    fn increments(&self) -> [BigRational; 3] {
        formula::increments(&self.sin_phi)
    }

    /// Returns W, their sum.
    pub(crate) fn increment_sum(&self) -> BigRational {
        formula::weight(&self.increments())
    }

    /// Returns what a sphere with a load adds to its lines above a step of the given sign.
    pub(crate) fn load_increments(&self, load: &Load, sign: Sign) -> [BigRational; 3] {
        if load.is_vertical() {
            let own = |w| formula::force(w, &load.down);
            return self.increments().each(own);
        }
        self.load_increments_of(load, &self.sin_phi, sign)
    }

    /// Returns what a sphere adds to its lines, in the ring of its load, which contains `s`, the value of sin φ.
    pub(crate) fn load_increments_of<N: Ring>(&self, load: &Load<N>, s: &N, sign: Sign) -> [N; 3] {
        match self.dimension() {
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
    #[doc(hidden)]
    #[must_use]
    pub fn denominator(&self) -> BigInt {
        let horizontal = self.loading.horizontal();
        let horizontal = horizontal.into_iter().map(|(_, force)| force);
        let given = common_denominator(self.loading.tilt().iter().chain(horizontal));
        let given = self.loading.extras().fold(given, |common, (_, load, _)| {
            let denominators = [&load.down, &load.x, &load.y].each(BigRational::denom);
            denominators.into_iter().fold(common, common_multiple)
        });
        common_denominator(&self.increments()) * given
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

    /// Returns whether every sphere has the ordinary weight and carries no load or horizontal contact force.
    pub(crate) fn has_no_loads(&self) -> bool {
        self.loading.extras().next().is_none()
    }

    /// Returns whether every sphere has the weight mg and carries no load or horizontal contact force. Then a straight
    /// pile has few distinct forces.
    pub(crate) fn has_unit_weights(&self) -> bool {
        !self.is_weightless() && self.has_no_loads()
    }

    /// Returns whether gravity on ordinary spheres is vertical.
    pub(crate) fn gravity_is_vertical(&self) -> bool {
        self.is_weightless() || self.tilt().iter().all(Zero::is_zero)
    }
}
