//! Counters of forces: bins, extremes and sums, in machine integers that are wide enough.

use core::cmp::Ordering;

use cannonpile::lattice::Sign;

use super::layer::{Numerator, Planes};
use crate::error::bug;
use crate::{Each, Error};

/// A histogram. It covers all bins from the least to the greatest number so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Bins {
    pub(super) first: i64,
    pub(super) counts: Vec<u64>,
}

impl Bins {
    /// Counts each number x `times` times in the bin ⌊x/width⌋. `ends` are the least and the greatest number.
    pub(super) fn count<'t, T: Numerator + 't>(
        &mut self,
        numbers: impl IntoIterator<Item = &'t T>,
        width: &T,
        ends: &[T; 2],
        times: u64,
    ) -> Result<(), Error> {
        let bin = |x: &T| x.div_floor(width).to_i64();
        let [first, last] = ends.each_ref().each(bin);
        self.cover(first.zip(last).ok_or_else(outside)?)?;
        for x in numbers {
            let index = bin(x).and_then(|bin| usize::try_from(bin - self.first).ok());
            let count = index.and_then(|index| self.counts.get_mut(index));
            *count.ok_or_else(outside)? += times;
        }
        Ok(())
    }

    /// Extends the histogram to these bins.
    fn cover(&mut self, (first, last): (i64, i64)) -> Result<(), Error> {
        if self.counts.is_empty() {
            self.first = first;
        }
        if let Ok(before @ 1..) = usize::try_from(self.first - first) {
            self.counts.splice(0..0, core::iter::repeat_n(0, before));
            self.first = first;
        }
        let length = usize::try_from(last - self.first + 1).map_err(|_| outside())?;
        if length > self.counts.len() {
            self.counts.resize(length, 0);
        }
        Ok(())
    }

    /// Adds another histogram `times` times.
    fn add(&mut self, other: &Self, times: u64) -> Result<(), Error> {
        let Some(more) = other.counts.len().checked_sub(1) else {
            return Ok(());
        };
        let last = other.first + i64::try_from(more).map_err(|_| outside())?;
        self.cover((other.first, last))?;
        let before = usize::try_from(other.first - self.first).map_err(|_| outside())?;
        let pairs = self.counts.iter_mut().skip(before).zip(&other.counts);
        pairs.for_each(|(count, more)| *count += more * times);
        Ok(())
    }
}

fn outside() -> Error {
    bug("a number lies between the least and the greatest of its layer")
}

/// The least or the greatest number so far, and the signs of the first stacking in which it occurs.
#[derive(Clone, Debug)]
pub(super) struct Extreme<T> {
    pub(super) value: T,
    pub(super) signs: Vec<Sign>,
}

/// The least and the greatest number so far.
pub(super) type Ends<T> = [Option<Extreme<T>>; 2];

/// Updates both ends with the least and the greatest number of a stacking.
fn update<T: Numerator>(ends: &mut Ends<T>, values: [T; 2], signs: &[Sign]) {
    let orders = [Ordering::Less, Ordering::Greater];
    for ((end, value), better) in ends.iter_mut().zip(values).zip(orders) {
        let replaces = |end: &Extreme<T>| match value.cmp(&end.value) {
            Ordering::Equal => signs < end.signs.as_slice(),
            order => order == better,
        };
        if end.as_ref().is_none_or(replaces) {
            let signs = signs.to_vec();
            *end = Some(Extreme { value, signs });
        }
    }
}

/// The numbers that determine the sums of the forces below a layer, or their totals over several layers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Level {
    /// The number of layers: 1 for a single layer.
    pub(super) layers: u128,
    /// The number of spheres of layer k.
    pub(super) spheres: u128,
    /// The layer index k.
    pub(super) depth: u128,
    /// The number of spheres of layers 1 to k.
    pub(super) under_top: u128,
    /// Σ 3n_j + 6 (spheres of layers 1 to j−1) over layers j from 1 to k.
    pub(super) squares: u128,
}

impl Level {
    /// Returns the level of a top layer.
    pub(super) fn top(spheres: u128) -> Self {
        Self {
            layers: 1,
            spheres,
            ..Self::default()
        }
    }

    /// Returns the level of the next layer, which has this number of spheres.
    pub(super) const fn next(self, spheres: u128) -> Self {
        Self {
            layers: 1,
            spheres,
            depth: self.depth + 1,
            squares: self.squares + 3 * spheres + 6 * self.under_top,
            under_top: self.under_top + spheres,
        }
    }

    fn add(&mut self, other: &Self, times: u128) {
        self.layers += other.layers * times;
        self.spheres += other.spheres * times;
        self.depth += other.depth * times;
        self.under_top += other.under_top * times;
        self.squares += other.squares * times;
    }
}

/// The contact forces below one layer of a stacking.
pub(super) struct LayerForces<T> {
    bins: Bins,
    ends: [T; 2],
    level: Level,
}

impl<T: Numerator> LayerForces<T> {
    /// Counts forces. `ends` are the least and the greatest of them.
    pub(super) fn new(
        forces: &Planes<T>,
        width: &T,
        ends: [T; 2],
        level: Level,
    ) -> Result<Self, Error> {
        let mut bins = Bins::default();
        for plane in forces {
            bins.count(plane, width, &ends, 1)?;
        }
        Ok(Self { bins, ends, level })
    }
}

/// The counters of some stackings with the same number of faults.
#[derive(Clone, Debug)]
pub(super) struct Counted<T> {
    pub(super) stackings: u64,
    pub(super) forces: Bins,
    pub(super) ends: Ends<T>,
    /// The totals over all layers of all stackings.
    pub(super) level: Level,
    pub(super) normals: Bins,
    pub(super) normal_ends: Ends<T>,
}

impl<T: Numerator> Counted<T> {
    pub(super) fn new() -> Self {
        Self {
            stackings: 0,
            forces: Bins::default(),
            ends: [None, None],
            level: Level::default(),
            normals: Bins::default(),
            normal_ends: [None, None],
        }
    }

    /// Adds a layer that `times` stackings share. The first of them has these signs. `scale` converts the numerators of
    /// the layer.
    pub(super) fn add_layer(
        &mut self,
        layer: &LayerForces<T>,
        times: u64,
        scale: &T,
        signs: &[Sign],
    ) -> Result<(), Error> {
        self.forces.add(&layer.bins, times)?;
        let values = layer.ends.clone().each(|value| value * scale);
        update(&mut self.ends, values, signs);
        self.level.add(&layer.level, times.into());
        Ok(())
    }

    /// Adds `times` stackings with these signs and normal forces on the floor.
    pub(super) fn add_base(
        &mut self,
        normals: &[T],
        width: &T,
        ends: &[T; 2],
        times: u64,
        signs: &[Sign],
    ) -> Result<(), Error> {
        self.stackings += times;
        self.normals.count(normals, width, ends, times)?;
        update(&mut self.normal_ends, ends.clone(), signs);
        Ok(())
    }
}
