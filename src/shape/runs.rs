//! The runs of a stacking, each with its first and last layer.

use super::{Anchor, RunLayers, Shape, Steps};
use crate::lattice::Sign;

impl Shape {
    /// Returns the index of the run whose steps lead down to layer k, or `None` for the top layer.
    #[inline]
    fn index_of_run_to(&self, k: i128) -> Option<usize> {
        if let [_] = *self.runs {
            return (k > 0).then_some(0);
        }
        self.runs.partition_point(|run| run.from < k).checked_sub(1)
    }

    /// Returns the steps from the top to layer k.
    #[inline]
    pub(super) fn steps_to(&self, k: i128) -> Steps {
        match self.run_to(k) {
            Some(run) => run.above.and(run.sign, k - run.from),
            None => Steps::default(),
        }
    }

    /// Returns the number of + steps minus the number of − steps from the top to layer k. This is the horizontal offset
    /// of site (0, 0) of layer k, in units of −ê_a.
    pub(crate) fn shift(&self, k: i128) -> i128 {
        let Steps { plus, minus } = self.steps_to(k);
        plus - minus
    }

    /// Returns the [`shift`](Self::shift) relative to the layer whose site (0, 0) has x = y = 0.
    #[doc(hidden)]
    #[must_use]
    pub fn shift_from_origin(&self, k: i128) -> i128 {
        match self.anchor {
            Anchor::Top(_) => self.shift(k),
            Anchor::Base(_) => self.shift(k) - (self.whole.plus - self.whole.minus),
        }
    }

    /// Returns the run whose steps lead down to layer k, or `None` for the top layer.
    #[inline]
    pub(crate) fn run_to(&self, k: i128) -> Option<RunLayers> {
        self.run(self.index_of_run_to(k)?)
    }

    /// Returns the number of sign changes above layer k. A sign change at layer k itself does not count.
    pub(crate) fn changes_above(&self, k: i128) -> usize {
        let run = self.index_of_run_to(k);
        // The top layer has no run and no sign change above it.
        run.unwrap_or(0)
    }

    /// Returns the run with this many sign changes above it.
    #[inline]
    pub(crate) fn run(&self, index: usize) -> Option<RunLayers> {
        self.runs.get(index).copied()
    }

    /// Returns the sign of the step down from layer k, or `None` for the bottom layer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Region, Sign};
    /// use cannonpile::shape::Shape;
    ///
    /// let shape = Shape::under(Region::SITE, "++-".parse()?)?;
    /// assert_eq!(shape.sign_below(1), Some(Sign::Plus));
    /// assert_eq!(shape.sign_below(2), Some(Sign::Minus));
    /// assert_eq!(shape.sign_below(3), None);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    #[inline]
    pub fn sign_below(&self, k: i128) -> Option<Sign> {
        self.run_below(k).map(|run| run.sign)
    }

    /// Returns the run of the step down from layer k, or `None` for the bottom layer.
    #[inline]
    pub(crate) fn run_below(&self, k: i128) -> Option<RunLayers> {
        let inside = (0..self.layers() - 1).contains(&k);
        inside.then(|| self.run_to(k + 1))?
    }
}
