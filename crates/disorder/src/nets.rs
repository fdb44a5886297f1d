//! Net numbers of steps: the number of + steps minus the number of − steps.

use cannonpile::lattice::{Region, Sign};

use super::number::{Number, add, times, tripled};
use super::place::Place;
use crate::error::bug;
use crate::{Each, Error};

/// Both signs, in the order of every pair that is indexed by sign.
pub(super) const SIGNS: [Sign; 2] = [Sign::Plus, Sign::Minus];

/// The numbers, or probabilities, of the beginnings of stackings. They are sorted by class (the number of faults), by the
/// sign of the next step, and by the net number s of steps.
///
/// Under a top layer s counts the steps from the top. On a base it counts the steps down to the base.
#[derive(Clone, Debug)]
pub(super) struct NetCounts<T> {
    /// By class, next sign, and s from −n on. `None` stands for zero everywhere.
    counts: Vec<[Option<Vec<T>>; 2]>,
    steps: usize,
    /// The change of s by a + step.
    plus: isize,
}

impl<T: Number> NetCounts<T> {
    /// Returns the counts at the top layer: one for each of the given s and first signs.
    pub(super) fn new(
        classes: usize,
        steps: usize,
        plus: isize,
        first: &[Sign],
        starts: impl Iterator<Item = isize>,
    ) -> Result<Self, Error> {
        let mut counts = vec![[None, None]; classes];
        let mut row = vec![T::zero(); 2 * steps + 1];
        for start in starts {
            let count = steps
                .checked_add_signed(start)
                .and_then(|at| row.get_mut(at));
            *count.ok_or_else(|| bug("no more steps are left than there are"))? = T::one();
        }
        let signs = counts.first_mut().ok_or_else(|| bug("there is a class"))?;
        *signs = SIGNS.each(|sign| first.contains(&sign).then(|| row.clone()));
        Ok(Self {
            counts,
            steps,
            plus,
        })
    }

    /// Takes the next step. The sign of the following step is chosen separately.
    pub(super) fn step(&mut self) {
        for class in &mut self.counts {
            for (sign, counts) in SIGNS.iter().zip(class) {
                // On a base a count may leave the range at one end and return at the other. There |s| exceeds the
                // number of steps that are left, so the count is never read.
                match (counts, (*sign == Sign::Plus) == (self.plus > 0)) {
                    (Some(counts), true) => counts.rotate_right(1),
                    (Some(counts), false) => counts.rotate_left(1),
                    (None, _) => {}
                }
            }
        }
    }

    /// Chooses the sign of the next step: the same sign, or the other sign after a fault. Counts after a fault are
    /// tripled, as forces are.
    pub(super) fn choose(
        &mut self,
        [same, change]: [Option<&T>; 2],
        before: impl Fn(usize) -> Option<usize>,
    ) {
        let moved = core::mem::take(&mut self.counts);
        let of = |class: Option<usize>, sign: usize| -> Option<&Vec<T>> {
            moved.get(class?)?.get(sign)?.as_ref()
        };
        let chosen = (0..moved.len()).map(|class| {
            [0, 1].each(|sign| {
                let straight = of(Some(class), sign);
                let turned = of(before(class), 1 - sign);
                if straight.is_none() && turned.is_none() {
                    return None;
                }
                let mut row = vec![T::zero(); 2 * self.steps + 1];
                for (to, from) in row.iter_mut().zip(straight.into_iter().flatten()) {
                    *to = times(from.clone(), same);
                }
                for (to, from) in row.iter_mut().zip(turned.into_iter().flatten()) {
                    add(to, &times(tripled(from), change));
                }
                Some(row)
            })
        });
        self.counts = chosen.collect();
    }

    /// Returns the counts of a class and next sign, by s from −n on. `None` stands for zero everywhere.
    pub(super) fn of(&self, class: usize, sign: usize) -> Option<&[T]> {
        self.counts.get(class)?.get(sign)?.as_deref()
    }

    /// Returns the counts of a class after the last step, by s from −n on. They are sums over both signs of that step.
    pub(super) fn of_both(&self, class: usize) -> Vec<T> {
        let mut sum = vec![T::zero(); 2 * self.steps + 1];
        for counts in (0..2).filter_map(|sign| self.of(class, sign)) {
            let pairs = sum.iter_mut().zip(counts);
            pairs.for_each(|(sum, count)| add(sum, count));
        }
        sum
    }
}

/// A set of net numbers: every sixth number of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Nets {
    least: i128,
    greatest: i128,
}

impl Nets {
    /// Returns the set of a single number.
    pub(super) const fn only(net: i128) -> Self {
        Self {
            least: net,
            greatest: net,
        }
    }

    /// Returns the net numbers s for which layer `k` has a sphere at a place. The pile grows down from a top layer, or
    /// fills the plane.
    ///
    /// With p + m = k and p − m = s the layer is the top layer with p + steps and m − steps added. So x₀ − m ≤ i ≤ x₁ +
    /// p, and likewise for j and i + j. By 3i = 2a − b + s, 3j = 2b − a + s and 3(i+j) = a + b + 2s these inequalities
    /// bound s from both sides. In addition s ≡ k (mod 2) and s ≡ a + b (mod 3).
    pub(super) fn of(place: Place, k: i128, top: Option<&Region>, within: (i128, i128)) -> Self {
        let Place { a, b } = place;
        let (mut least, mut greatest) = within;
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

    /// Returns the sum of the counts of these numbers. The list of counts begins at s = −n.
    ///
    /// # Errors
    /// [`Bug`](cannonpile::Error::Bug).
    pub(super) fn sum<T: Number>(&self, counts: &[T], steps: usize) -> Result<T, Error> {
        if self.is_empty() {
            return Ok(T::zero());
        }
        let index = |net: i128| usize::try_from(net + steps as i128).ok();
        let range = index(self.least).zip(index(self.greatest));
        let listed = range.and_then(|(least, greatest)| counts.get(least..=greatest));
        let listed = listed.ok_or_else(|| bug("no layer has more net steps than steps"))?;
        Ok(listed
            .iter()
            .step_by(6)
            .fold(T::zero(), |sum, count| sum + count))
    }
}
