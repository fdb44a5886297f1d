//! The runs of a pile's stacking, each with the layers it leads from and to.

use super::{Anchor, Shape};
use crate::lattice::Sign;

/// A number of steps of each sign.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Steps {
    pub(super) plus: i128,
    pub(super) minus: i128,
}

impl Steps {
    /// Returns these steps and some more of one sign.
    pub(super) fn and(mut self, sign: Sign, steps: i128) -> Self {
        match sign {
            Sign::Plus => self.plus += steps,
            Sign::Minus => self.minus += steps,
        }
        self
    }
}

/// A [`Run`](crate::stacking::Run) with its place in a pile: the layers it leads from and to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Stretch {
    /// The number of changes of sign before the run.
    pub(crate) index: usize,
    pub(crate) sign: Sign,
    /// The layer above the first step.
    pub(crate) from: i128,
    /// The layer below the last step.
    pub(crate) to: i128,
    /// The steps from the top to `from`.
    pub(super) above: Steps,
}

impl Shape {
    /// The place of the run whose steps lead down to layer k; none for the top.
    #[inline]
    fn run_to(&self, k: i128) -> Option<usize> {
        if let [_] = *self.stretches {
            return (k > 0).then_some(0);
        }
        self.stretches
            .partition_point(|stretch| stretch.from < k)
            .checked_sub(1)
    }

    /// Returns the steps from the top to layer k.
    #[inline]
    pub(super) fn steps_to(&self, k: i128) -> Steps {
        match self.stretch_to(k) {
            Some(run) => run.above.and(run.sign, k - run.from),
            None => Steps::default(),
        }
    }

    /// Returns the number of + steps from the top to layer k less that of − steps: where site (0, 0) of layer k lies,
    /// in units of −ê_a.
    pub(crate) fn shift(&self, k: i128) -> i128 {
        let Steps { plus, minus } = self.steps_to(k);
        plus - minus
    }

    /// Returns the [`shift`](Self::shift) from the site under which x = y = 0.
    #[doc(hidden)]
    #[must_use]
    pub fn shift_from_origin(&self, k: i128) -> i128 {
        match self.anchor {
            Anchor::Top(_) => self.shift(k),
            Anchor::Base(_) => self.shift(k) - (self.whole.plus - self.whole.minus),
        }
    }

    /// Returns the run whose steps lead down to layer k; none for the top.
    #[inline]
    pub(crate) fn stretch_to(&self, k: i128) -> Option<Stretch> {
        self.stretch(self.run_to(k)?)
    }

    /// Returns how many changes of sign lie above layer k, one at k itself not among them.
    pub(crate) fn changes_above(&self, k: i128) -> usize {
        let run = self.run_to(k);
        // Not a default: no run leads to the top, and nothing changes above it.
        run.unwrap_or(0)
    }

    /// Returns the run after this many changes of sign.
    #[inline]
    pub(crate) fn stretch(&self, index: usize) -> Option<Stretch> {
        self.stretches.get(index).copied()
    }

    /// Returns the sign of the step down from layer k; none from the floor.
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
        let inside = (0..self.layers() - 1).contains(&k);
        let run = inside.then(|| self.run_to(k + 1))??;
        self.stretch(run).map(|run| run.sign)
    }
}
