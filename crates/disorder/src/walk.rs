//! How many steps a layer lies below the top, net: how many stackings, or with which probability.

use core::ops::RangeInclusive;

use cannonpile::lattice::{Region, Sign};

use super::number::{Number, Share, add, tripled};
use super::place::Place;
use crate::Error;
use crate::error::bug;

/// Both signs, in the order of every pair indexed by sign.
pub(super) const SIGNS: [Sign; 2] = [Sign::Plus, Sign::Minus];

/// The beginnings of stackings by their net number of steps, the sign of the next step, and their faults or in one class.
///
/// Under a top layer s counts down from it, 0 there; on a base it is what is left down to the base, 0 there.
#[derive(Clone, Debug)]
pub(super) struct Walk<T> {
    /// By class and next sign; `None` where no stacking is. From s = −n on.
    counts: Vec<[Option<Vec<T>>; 2]>,
    steps: usize,
    /// What a + step adds to s.
    plus: isize,
}

impl<T: Number> Walk<T> {
    /// Returns the beginnings of no step: one for each of these s and first signs.
    pub(super) fn new(
        classes: usize,
        steps: usize,
        plus: isize,
        first: &[Sign],
        starts: impl Iterator<Item = isize>,
    ) -> Result<Self, Error> {
        let mut walk = Self {
            counts: vec![[None, None]; classes],
            steps,
            plus,
        };
        let mut row = walk.row();
        for start in starts {
            let at = walk.index(start).and_then(|at| row.get_mut(at));
            *at.ok_or_else(|| bug("no more steps are left than there are"))? = T::one();
        }
        let begun = walk.counts.first_mut();
        let begun = begun.ok_or_else(|| bug("there is a class"))?;
        for (sign, counts) in SIGNS.iter().zip(begun) {
            if first.contains(sign) {
                *counts = Some(row.clone());
            }
        }
        Ok(walk)
    }

    fn row(&self) -> Vec<T> {
        vec![T::zero(); 2 * self.steps + 1]
    }

    fn index(&self, net: isize) -> Option<usize> {
        self.steps.checked_add_signed(net)
    }

    /// Takes the next step; sums over the sign after it are left to be made.
    pub(super) fn step(&mut self) {
        for class in &mut self.counts {
            for (sign, counts) in SIGNS.iter().zip(class) {
                // On a base a number beyond n leads on at the other end. There it is as far from 0 as here: farther than
                // steps are left, so that no one looks at it.
                match (counts, (*sign == Sign::Plus) == (self.plus > 0)) {
                    (Some(counts), true) => counts.rotate_right(1),
                    (Some(counts), false) => counts.rotate_left(1),
                    (None, _) => {}
                }
            }
        }
    }

    /// Chooses the sign of the next step: the same one, or at a fault the other, tripled as forces are.
    pub(super) fn choose(
        &mut self,
        same: &impl Share<T>,
        change: &impl Share<T>,
        before: impl Fn(usize) -> Option<usize>,
    ) {
        let moved = core::mem::take(&mut self.counts);
        let of = |class: Option<usize>, sign: usize| -> Option<&Vec<T>> {
            moved.get(class?)?.get(sign)?.as_ref()
        };
        let chosen = (0..moved.len()).map(|class| {
            [0, 1].map(|sign| {
                let straight = of(Some(class), sign);
                let turned = of(before(class), 1 - sign);
                if straight.is_none() && turned.is_none() {
                    return None;
                }
                let mut row = vec![T::zero(); 2 * self.steps + 1];
                for (to, from) in row.iter_mut().zip(straight.into_iter().flatten()) {
                    *to = same.of(from.clone());
                }
                for (to, from) in row.iter_mut().zip(turned.into_iter().flatten()) {
                    add(to, &change.of(tripled(from)));
                }
                Some(row)
            })
        });
        self.counts = chosen.collect();
    }

    /// The beginnings of a class with a next sign, by s from −n on; `None` where there are none.
    pub(super) fn of(&self, class: usize, sign: usize) -> Option<&[T]> {
        self.counts.get(class)?.get(sign)?.as_deref()
    }

    /// The beginnings of a class, whatever the sign of the step just taken, by s from −n on.
    pub(super) fn of_both(&self, class: usize) -> Vec<T> {
        let mut sum = self.row();
        for counts in (0..2).filter_map(|sign| self.of(class, sign)) {
            sum.iter_mut()
                .zip(counts)
                .for_each(|(sum, count)| add(sum, count));
        }
        sum
    }

    /// The place in such a row of a number of net steps.
    pub(super) fn place_of(&self, net: isize) -> Option<usize> {
        self.index(net)
    }
}

/// The numbers of net steps at which a layer has a sphere at a place: every sixth of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Nets {
    least: i128,
    greatest: i128,
}

impl Nets {
    /// Those of layer `k` of piles that grow down from a top layer, or fill the plane.
    ///
    /// With p + m = k and p − m = s the layer is the top layer with p + steps and m − steps: x₀ − m ≤ i ≤ x₁ + p, and so for j
    /// and i + j. With 3i = 2a − b + s, 3j = 2b − a + s and 3(i+j) = a + b + 2s each of these bounds s from both sides.
    /// And s ≡ k (mod 2), s ≡ a + b (mod 3).
    pub(super) fn of(
        place: Place,
        k: i128,
        top: Option<&Region>,
        within: RangeInclusive<i128>,
    ) -> Self {
        let Place { a, b } = place;
        let (mut least, mut greatest) = (*within.start(), *within.end());
        if let Some(top) = top {
            for (twice, bounds) in [(2 * (2 * a - b), top.x()), (2 * (2 * b - a), top.y())] {
                least = least.max(twice - 6 * bounds.end() - 3 * k);
                greatest = greatest.min(twice - 6 * bounds.start() + 3 * k);
            }
            let (twice, bounds) = (2 * (a + b), top.s());
            least = least.max(6 * bounds.start() - 3 * k - twice);
            greatest = greatest.min(6 * bounds.end() + 3 * k - twice);
        }
        let residue = 3 * k + 4 * (a + b);
        Self {
            least: least + (residue - least).rem_euclid(6),
            greatest,
        }
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.least > self.greatest
    }

    /// The sum over these numbers of what is listed from s = −n on.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(super) fn sum<T: Number>(&self, counts: &[T], steps: usize) -> Result<T, Error> {
        let mut sum = T::zero();
        if self.is_empty() {
            return Ok(sum);
        }
        // Bounded by the number of steps, which is that of a list in memory.
        let index = |net: i128| usize::try_from(net + steps as i128).ok();
        let listed = match (index(self.least), index(self.greatest)) {
            (Some(least), Some(greatest)) => counts.get(least..=greatest),
            _ => None,
        };
        let listed = listed.ok_or_else(|| bug("no layer has more net steps than steps"))?;
        for count in listed.iter().step_by(6) {
            sum = sum + count;
        }
        Ok(sum)
    }
}
