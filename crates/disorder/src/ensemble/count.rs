//! What is counted on the way: bins, extremes and sums, in machine integers that are wide enough.

use core::cmp::Ordering;

use cannonpile::lattice::Sign;

use super::layer::{Numerator, Planes};
use crate::Error;
use crate::error::bug;

/// Counts of numbers by bins, from the least bin that was met to the greatest.
#[derive(Clone, Debug, Default)]
pub(super) struct Bins {
    pub(super) first: i64,
    pub(super) counts: Vec<u64>,
}

impl Bins {
    /// Counts numbers, each so many times: of x the bin is ⌊x/width⌋. Their least and greatest are `ends`.
    pub(super) fn count<'t, T: Numerator + 't>(
        &mut self,
        numbers: impl IntoIterator<Item = &'t T>,
        width: &T,
        ends: &[T; 2],
        times: u64,
    ) -> Result<(), Error> {
        let bin = |x: &T| x.div_floor(width).to_i64();
        let [first, last] = ends.each_ref().map(bin);
        let ends = first.zip(last).ok_or_else(beyond)?;
        self.cover(ends)?;
        for x in numbers {
            let place = bin(x).and_then(|bin| usize::try_from(bin - self.first).ok());
            let count = place.and_then(|place| self.counts.get_mut(place));
            *count.ok_or_else(beyond)? += times;
        }
        Ok(())
    }

    /// Makes room from one bin to another.
    fn cover(&mut self, (first, last): (i64, i64)) -> Result<(), Error> {
        if self.counts.is_empty() {
            self.first = first;
        }
        let before = usize::try_from(self.first - first);
        if let Ok(before @ 1..) = before {
            self.counts.splice(0..0, core::iter::repeat_n(0, before));
            self.first = first;
        }
        let length = usize::try_from(last - self.first + 1).map_err(|_| beyond())?;
        if length > self.counts.len() {
            self.counts.resize(length, 0);
        }
        Ok(())
    }

    /// Adds other counts, each so many times.
    fn absorb(&mut self, other: &Self, times: u64) -> Result<(), Error> {
        let Some(more) = other.counts.len().checked_sub(1) else {
            return Ok(());
        };
        let last = other.first + i64::try_from(more).map_err(|_| beyond())?;
        self.cover((other.first, last))?;
        let before = usize::try_from(other.first - self.first).map_err(|_| beyond())?;
        let counts = self.counts.iter_mut().skip(before);
        counts
            .zip(&other.counts)
            .for_each(|(count, more)| *count += more * times);
        Ok(())
    }

    fn clear(&mut self) {
        self.counts.clear();
    }
}

fn beyond() -> Error {
    bug("a number lies between the least and the greatest of its layer")
}

/// The least or the greatest number that was met, and the signs of the first stacking that has it.
#[derive(Clone, Debug)]
pub(super) struct Extreme<T> {
    pub(super) value: T,
    pub(super) signs: Vec<Sign>,
}

/// The least and the greatest.
#[derive(Clone, Debug)]
pub(super) struct Ends<T> {
    pub(super) least: Option<Extreme<T>>,
    pub(super) greatest: Option<Extreme<T>>,
}

impl<T: Numerator> Ends<T> {
    const NONE: Self = Self {
        least: None,
        greatest: None,
    };

    pub(super) fn meet(&mut self, [least, greatest]: &[T; 2], signs: impl Fn() -> Vec<Sign>) {
        meet(&mut self.least, Ordering::Less, least.clone(), &signs);
        let greatest = greatest.clone();
        meet(&mut self.greatest, Ordering::Greater, greatest, &signs);
    }
}

/// Takes in a number that is better, or as good and of a stacking that comes before.
fn meet<T: Ord>(
    best: &mut Option<Extreme<T>>,
    better: Ordering,
    value: T,
    signs: impl Fn() -> Vec<Sign>,
) {
    let replaces = match best {
        None => true,
        Some(best) => match value.cmp(&best.value) {
            Ordering::Equal => signs() < best.signs,
            order => order == better,
        },
    };
    if replaces {
        let signs = signs();
        *best = Some(Extreme { value, signs });
    }
}

/// How much lies above a layer, for the sums of its forces.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Level {
    /// k.
    pub(super) depth: u128,
    /// The spheres of layers 1 to k.
    pub(super) under_top: u128,
    /// Σ 3n_j + 6 (spheres of layers 1 to j−1) over layers j from 1 to k.
    pub(super) squares: u128,
}

impl Level {
    /// The next layer, with this many spheres.
    pub(super) const fn next(self, spheres: u128) -> Self {
        Self {
            depth: self.depth + 1,
            squares: self.squares + 3 * spheres + 6 * self.under_top,
            under_top: self.under_top + spheres,
        }
    }
}

/// What was counted of the contact forces below some layers.
#[derive(Clone, Debug)]
pub(super) struct Forces<T> {
    pub(super) bins: Bins,
    pub(super) ends: Ends<T>,
    /// The layers; and summed over them the spheres, and what [`Level`] has.
    pub(super) layers: u128,
    pub(super) spheres: u128,
    pub(super) levels: Level,
}

impl<T: Numerator> Forces<T> {
    pub(super) const fn new() -> Self {
        Self {
            bins: Bins {
                first: 0,
                counts: Vec::new(),
            },
            ends: Ends::NONE,
            layers: 0,
            spheres: 0,
            levels: Level {
                depth: 0,
                under_top: 0,
                squares: 0,
            },
        }
    }

    /// Counts the forces below one layer of a beginning with these signs.
    pub(super) fn meet_layer(
        &mut self,
        forces: &Planes<T>,
        width: &T,
        ends: &[T; 2],
        level: &Level,
        signs: &[Sign],
    ) -> Result<(), Error> {
        for plane in forces {
            self.bins.count(plane, width, ends, 1)?;
        }
        self.ends.meet(ends, || signs.to_vec());
        self.layers += 1;
        self.spheres += forces[0].len() as u128;
        self.levels.depth += level.depth;
        self.levels.under_top += level.under_top;
        self.levels.squares += level.squares;
        Ok(())
    }

    /// Adds what was counted below other layers, each so many times; their numerators times `scale` are ours. The
    /// first stacking that goes on from signs is what `complete` says.
    pub(super) fn absorb(
        &mut self,
        other: &Self,
        times: u64,
        scale: &T,
        complete: impl Fn(&[Sign]) -> Vec<Sign>,
    ) -> Result<(), Error> {
        self.bins.absorb(&other.bins, times)?;
        if let Some(Extreme { value, signs }) = &other.ends.least {
            let value = value.clone() * scale;
            meet(&mut self.ends.least, Ordering::Less, value, || {
                complete(signs)
            });
        }
        if let Some(Extreme { value, signs }) = &other.ends.greatest {
            let value = value.clone() * scale;
            let greatest = &mut self.ends.greatest;
            meet(greatest, Ordering::Greater, value, || complete(signs));
        }
        let times = u128::from(times);
        self.layers += other.layers * times;
        self.spheres += other.spheres * times;
        self.levels.depth += other.levels.depth * times;
        self.levels.under_top += other.levels.under_top * times;
        self.levels.squares += other.levels.squares * times;
        Ok(())
    }

    /// Forgets all, in the same memory.
    pub(super) fn clear(&mut self) {
        self.bins.clear();
        let bins = core::mem::take(&mut self.bins);
        *self = Self {
            bins,
            ..Self::new()
        };
    }
}

/// What was counted of some stackings with a number of faults.
#[derive(Clone, Debug)]
pub(super) struct Counted<T> {
    pub(super) stackings: u64,
    pub(super) forces: Forces<T>,
    pub(super) normals: Bins,
    pub(super) normal_ends: Ends<T>,
}

impl<T: Numerator> Counted<T> {
    pub(super) const fn new() -> Self {
        Self {
            stackings: 0,
            forces: Forces::new(),
            normals: Bins {
                first: 0,
                counts: Vec::new(),
            },
            normal_ends: Ends::NONE,
        }
    }

    /// Counts a stacking's base, so many times.
    pub(super) fn meet_base(
        &mut self,
        normals: &[T],
        width: &T,
        ends: &[T; 2],
        times: u64,
        signs: &[Sign],
    ) -> Result<(), Error> {
        self.stackings += times;
        self.normals.count(normals, width, ends, times)?;
        self.normal_ends.meet(ends, || signs.to_vec());
        Ok(())
    }
}
