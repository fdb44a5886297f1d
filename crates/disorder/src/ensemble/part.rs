//! Which stackings are walked, and which of them go on from a beginning.

use cannonpile::lattice::Sign;

use super::order::Order;
use crate::Error;
use crate::error::bug;

/// Which stackings are walked.
pub(super) enum Walked {
    /// Those of a range of all, in order.
    Range(core::ops::Range<u64>),
    /// These, in order; some may be there several times.
    Listed(Vec<Vec<Sign>>),
}

/// The stackings of a part that go on from a beginning.
#[derive(Clone, Copy)]
pub(super) enum Part {
    /// Of `size` stackings, of which `base` come before the first, those from `start` to before `end`.
    Range {
        base: u64,
        size: u64,
        start: u64,
        end: u64,
    },
    /// These places of the list.
    Listed { from: usize, to: usize },
}

/// How many stackings go on from a beginning, and the first of them, by their faults.
#[derive(Clone, Default)]
pub(super) struct Onward(pub(super) Vec<(u64, u64)>);

impl Onward {
    pub(super) fn clear(&mut self) {
        self.0.iter_mut().for_each(|entry| *entry = (0, 0));
    }

    /// Adds those that come after.
    pub(super) fn add(&mut self, other: &Self) {
        for (entry, (count, first)) in self.0.iter_mut().zip(&other.0) {
            if entry.0 == 0 {
                entry.1 = *first;
            }
            entry.0 += count;
        }
    }

    /// Those there are: faults, count, first.
    pub(super) fn entries(&self) -> impl Iterator<Item = (usize, u64, u64)> + '_ {
        let entries = self.0.iter().enumerate();
        entries
            .map(|(faults, (count, first))| (faults, *count, *first))
            .filter(|(_, count, _)| *count > 0)
    }
}

impl Part {
    /// What of a part goes on with a sign from a beginning of k; `None` if nothing does.
    pub(super) fn going_on(
        self,
        walked: &Walked,
        order: &Order,
        k: usize,
        sign: Sign,
    ) -> Result<Option<Self>, Error> {
        Ok(match self {
            Self::Range { .. } if k == 0 && order.first().is_some() => {
                Some(self).filter(|_| order.first() == Some(sign))
            }
            Self::Range {
                base,
                size,
                start,
                end,
            } => {
                let half = size / 2;
                let (base, start, end) = match sign {
                    Sign::Plus => (base, start, end.min(half)),
                    Sign::Minus => (base + half, start.max(half) - half, end.max(half) - half),
                };
                let size = half;
                let part = Self::Range {
                    base,
                    size,
                    start,
                    end,
                };
                Some(part).filter(|_| start < end)
            }
            Self::Listed { from, to } => {
                let listed = match walked {
                    Walked::Listed(list) => list.get(from..to),
                    Walked::Range(_) => None,
                };
                let listed = listed.ok_or_else(|| bug("places of a list are in it"))?;
                let is_plus = |signs: &Vec<Sign>| signs.get(k) == Some(&Sign::Plus);
                let middle = from + listed.partition_point(is_plus);
                let (from, to) = match sign {
                    Sign::Plus => (from, middle),
                    Sign::Minus => (middle, to),
                };
                Some(Self::Listed { from, to }).filter(|_| from < to)
            }
        })
    }

    /// Whether every stacking that goes on belongs to it.
    pub(super) const fn is_whole(&self) -> bool {
        matches!(self, Self::Range { size, start: 0, end, .. } if *size == *end)
    }

    /// How many stackings it has, and which is the first.
    pub(super) const fn entry(&self) -> (u64, u64) {
        match self {
            Self::Range {
                base, start, end, ..
            } => (*end - *start, *base + *start),
            Self::Listed { from, to } => ((*to - *from) as u64, *from as u64),
        }
    }
}

/// The signs of a stacking by its place in the order, or in the list.
pub(super) fn signs_of(order: &Order, walked: &Walked, place: u64) -> Result<Vec<Sign>, Error> {
    match walked {
        Walked::Range(_) => Ok(order.signs(place)),
        Walked::Listed(list) => {
            let place = usize::try_from(place).ok();
            let signs = place.and_then(|place| list.get(place));
            signs
                .cloned()
                .ok_or_else(|| bug("places of a list are in it"))
        }
    }
}

/// The first stacking that goes on from these signs with `left` more, of which `changes` differ from the one before.
pub(super) fn completed(signs: &[Sign], left: usize, changes: usize) -> Vec<Sign> {
    let mut signs = signs.to_vec();
    let mut changes = changes;
    for after in (0..left).rev() {
        // Not a default: a beginning has a sign.
        let last = signs.last().copied().unwrap_or(Sign::Plus);
        let needs = usize::from(last == Sign::Minus);
        // With + next the other changes must fit in what is left.
        let is_plus = needs <= changes && changes - needs <= after;
        let sign = if is_plus { Sign::Plus } else { Sign::Minus };
        changes -= usize::from(sign != last);
        signs.push(sign);
    }
    signs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_entered_at_its_start() {
        let range = Part::Range {
            base: 10,
            size: 8,
            start: 2,
            end: 5,
        };
        assert_eq!(range.entry(), (3, 12));
        assert_eq!(Part::Listed { from: 3, to: 9 }.entry(), (6, 3));
    }

    #[test]
    fn the_first_completion_comes_before_all_others() {
        for left in 0..6_usize {
            for first in [Sign::Plus, Sign::Minus] {
                for changes in 0..=left {
                    let all = (0..1_u32 << left).map(|bits| {
                        let rest = (0..left).rev().map(|bit| match bits >> bit & 1 {
                            0 => Sign::Plus,
                            _ => Sign::Minus,
                        });
                        core::iter::once(first).chain(rest).collect::<Vec<_>>()
                    });
                    let is_such = |signs: &Vec<Sign>| {
                        signs.windows(2).filter(|pair| pair[0] != pair[1]).count() == changes
                    };
                    let text = |signs: Vec<Sign>| signs.iter().map(|s| s.symbol()).collect();
                    let expected: Option<String> = all.filter(is_such).min().map(text);
                    assert_eq!(Some(text(completed(&[first], left, changes))), expected);
                }
            }
        }
    }
}
