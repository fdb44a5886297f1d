//! The runs of a pile's stacking, by layer.

use super::{Anchor, Shape};
use crate::lattice::Sign;

/// How many steps of each sign lead from one layer to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Descent {
    pub(super) plus: i128,
    pub(super) minus: i128,
}

impl Descent {
    pub(super) fn further(self, sign: Sign, steps: i128) -> Self {
        let Self { plus, minus } = self;
        match sign {
            Sign::Plus => Self {
                plus: plus + steps,
                minus,
            },
            Sign::Minus => Self {
                plus,
                minus: minus + steps,
            },
        }
    }
}

/// The layer above the first step of a run, and the way there from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Start {
    pub(super) layer: i128,
    pub(super) sign: Sign,
    pub(super) descent: Descent,
}

/// A run of steps of one sign, and the layers it leads from and to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stretch {
    /// The place of the run in the stacking: how often the sign changes before it.
    pub(crate) index: usize,
    pub(crate) sign: Sign,
    /// The layer above the first step.
    pub(crate) from: i128,
    /// The layer below the last step.
    pub(crate) to: i128,
}

impl Shape {
    /// The place of the run whose steps lead down to layer k; none for the top.
    #[inline]
    fn run_to(&self, k: i128) -> Option<usize> {
        if let [_] = *self.starts {
            return (k > 0).then_some(0);
        }
        self.starts
            .partition_point(|start| start.layer < k)
            .checked_sub(1)
    }

    /// The steps from the top to layer k.
    #[inline]
    pub(super) fn descent(&self, k: i128) -> Descent {
        match self.run_to(k).and_then(|run| self.starts.get(run)) {
            Some(start) => start.descent.further(start.sign, k - start.layer),
            None => Descent::default(),
        }
    }

    /// The net number of + steps from the top to layer k: where site (0, 0) of layer k lies, in units of −ê_a.
    pub(crate) fn shift(&self, k: i128) -> i128 {
        let Descent { plus, minus } = self.descent(k);
        plus - minus
    }

    /// The net number of + steps above layer k, from the site under which x = y = 0.
    pub(crate) fn shift_from_origin(&self, k: i128) -> i128 {
        match self.anchor {
            Anchor::Top(_) => self.shift(k),
            Anchor::Base(_) => self.shift(k) - (self.whole.plus - self.whole.minus),
        }
    }

    /// The run whose steps lead down to layer k; none for the top.
    #[inline]
    pub(crate) fn stretch_to(&self, k: i128) -> Option<Stretch> {
        self.stretch(self.run_to(k)?)
    }

    /// The run of a place in the stacking.
    #[inline]
    pub(crate) fn stretch(&self, index: usize) -> Option<Stretch> {
        let start = self.starts.get(index)?;
        let next = self.starts.get(index + 1);
        Some(Stretch {
            index,
            sign: start.sign,
            from: start.layer,
            to: next.map_or(self.layers() - 1, |next| next.layer),
        })
    }

    /// The sign of the step down from layer k; none from the floor.
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
        self.starts.get(run).map(|start| start.sign)
    }
}
