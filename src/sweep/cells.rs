//! A number for each line of a layer.

use alloc::vec::Vec;
use core::ops::{Add, Range};

use super::{Grid, Layer, Pass};
use crate::lattice::{Direction, Trapezoid};
use crate::parallel;
use crate::scalar::{Algebra, Ring};
use crate::transfer::turn_numerators;

/// How many numbers are worth a thread of their own.
const WORTH_A_THREAD: usize = 1 << 13;

/// A number for each line of a layer, by direction.
#[derive(Clone, Debug)]
pub(crate) struct Cells<V>(pub(super) [Vec<V>; 3]);

/// What the spheres of a pass come to on a line: `ramps[direction][n]` for n of them.
pub(super) struct Ramps<V>([Vec<V>; 3]);

impl<V: Clone + PartialEq> Ramps<V> {
    /// From what one sphere adds to its lines, and what `n` of it are.
    pub(super) fn new<W: PartialEq>(
        pass: &Pass,
        increments: &[W; 3],
        times: impl Fn(&W, i128) -> V,
    ) -> Self {
        let ramp = |w: &W| -> Vec<V> {
            let counts = 0..=pass.greatest_count();
            counts.map(|n| times(w, n)).collect()
        };
        let [a, b, c] = increments;
        let alpha = ramp(a);
        let beta = if a == b { alpha.clone() } else { ramp(b) };
        let gamma = if a == c { alpha.clone() } else { ramp(c) };
        Self([alpha, beta, gamma])
    }

    /// The same of a part of each number.
    pub(super) fn map<U>(&self, part: impl Fn(&V) -> U) -> Ramps<U> {
        Ramps(
            self.0
                .each_ref()
                .map(|ramp| ramp.iter().map(&part).collect()),
        )
    }
}

/// Rows of a layer with the cells of their lines, apart from all other rows.
pub(super) struct Band<'c, V> {
    rows: Range<i128>,
    /// Where the slices begin among all cells.
    starts: [usize; 3],
    cells: [&'c mut [V]; 3],
}

impl<V: Clone + for<'a> Add<&'a V, Output = V>> Cells<V> {
    pub(crate) fn new(grid: &Grid<'_>, zero: &V) -> Self {
        Self(core::array::from_fn(
            |_| alloc::vec![zero.clone(); grid.cells],
        ))
    }

    /// The rows of the layer that a pass leads to, in as many bands as there are threads for.
    pub(super) fn bands(&mut self, grid: &Grid<'_>, pass: &Pass) -> Vec<Band<'_, V>> {
        let rows = pass.region.y();
        let (first, end) = (*rows.start(), rows.end() + 1);
        let worth = i128::try_from(self.0[0].len() / WORTH_A_THREAD).unwrap_or(1);
        let threads = i128::try_from(parallel::threads()).unwrap_or(1);
        // More than threads: rows are not of one length, and threads not of one speed.
        let bands = worth.min(4 * threads).clamp(1, end - first);
        let mut rest = self.0.each_mut().map(Vec::as_mut_slice);
        let mut starts = [0; 3];
        let mut split = Vec::new();
        for band in 0..bands {
            let part = |n: i128| first + (end - first) * n / bands;
            let rows = part(band)..part(band + 1);
            let mut cells: [&mut [V]; 3] = Default::default();
            let ends = if rows.end == end {
                starts.map(|_| usize::MAX)
            } else {
                let next = pass.region.row(rows.end);
                grid.row(rows.end, &next, pass.shift)
                    .map(|cells| cells.start)
            };
            let begun = starts;
            for (((cells, rest), start), end) in
                cells.iter_mut().zip(&mut rest).zip(&mut starts).zip(ends)
            {
                let n = end.saturating_sub(*start).min(rest.len());
                *cells = rest.split_off_mut(..n).unwrap_or_default();
                *start += n;
            }
            split.push(Band {
                rows,
                starts: begun,
                cells,
            });
        }
        split
    }

    /// Adds to the three lines of a sphere.
    pub(super) fn add_to(&mut self, cells: [usize; 3], values: &[V; 3]) {
        for ((line, cell), value) in self.0.iter_mut().zip(cells).zip(values) {
            if let Some(sum) = line.get_mut(cell) {
                *sum = sum.clone() + value;
            }
        }
    }

    /// What the three lines of a sphere carry.
    pub(super) fn carried(&self, [a, b, c]: [usize; 3]) -> [&V; 3] {
        let Self([alpha, beta, gamma]) = self;
        [&alpha[a], &beta[b], &gamma[c]]
    }

    /// What the lines of a row of spheres carry.
    pub(super) fn row(&self, grid: &Grid<'_>, pass: &Pass, j: i128) -> [&[V]; 3] {
        self.slices(grid.row(j, &pass.region.row(j), pass.shift))
    }

    /// What consecutive lines carry, by direction.
    pub(super) fn slices(&self, [a, b, c]: [Range<usize>; 3]) -> [&[V]; 3] {
        let Self([alpha, beta, gamma]) = self;
        [&alpha[a], &beta[b], &gamma[c]]
    }
}

impl<V: Clone + for<'a> Add<&'a V, Output = V>> Band<'_, V> {
    /// Adds the increments of a pass, and turns what it ends at if the sign changes there.
    pub(super) fn add_and_turn(
        &mut self,
        grid: &Grid<'_>,
        pass: &Pass,
        ramps: &Ramps<V>,
        turn: impl Fn(&[V; 3]) -> [V; 3],
    ) {
        let steps = pass.k - pass.from;
        let [alpha, beta, gamma] = &mut self.cells;
        for j in self.rows.clone() {
            let i = pass.region.row(j);
            let [a, b, c] = grid.row(j, &i, pass.shift);
            let [from_a, from_b, from_c] = self.starts;
            let inside = |cells: Range<usize>, from: usize| cells.start - from..cells.end - from;
            let (a, b, c) = (
                &mut alpha[inside(a, from_a)],
                &mut beta[inside(b, from_b)],
                &mut gamma[inside(c, from_c)],
            );
            let counts = pass.region.row_counts(j, pass.run.sign, steps);
            let lines = [&mut *a, &mut *b, &mut *c];
            for ((line, count), direction) in lines.into_iter().zip(counts).zip(Direction::ALL) {
                add(line, count, i.start, &ramps.0[direction.index()]);
            }
            if !pass.turns {
                continue;
            }
            for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                let turned = turn(&[a.clone(), b.clone(), c.clone()]);
                [*a, *b, *c] = turned;
            }
        }
    }
}

impl<T: Algebra> Layer<T> for Cells<T::Numerator> {
    fn pass(&mut self, grid: &Grid<'_>, pass: &Pass, increments: &[T::Numerator; 3]) {
        let ramps = Ramps::new(pass, increments, |w, n| T::Numerator::from_i128(n) * w);
        parallel::for_each(self.bands(grid, pass), |mut band| {
            band.add_and_turn(grid, pass, &ramps, turn_numerators::<T>);
        });
    }

    fn add_at(&mut self, cells: [usize; 3], values: &[T::Numerator; 3]) {
        self.add_to(cells, values);
    }

    fn at(&self, cells: [usize; 3]) -> [T::Numerator; 3] {
        self.carried(cells).map(Clone::clone)
    }
}

/// Adds `ramp[count]` along a row that begins at `start`: rising, level, falling.
fn add<V: Clone + for<'a> Add<&'a V, Output = V>>(
    row: &mut [V],
    count: Trapezoid,
    start: i128,
    ramp: &[V],
) {
    // No count is greater than the last of the ramp.
    let count = Trapezoid {
        cap: i128::try_from(ramp.len()).map_or(count.cap, |n| count.cap.min(n - 1)),
        ..count
    };
    let Some(level) = usize::try_from(count.cap)
        .ok()
        .and_then(|cap| ramp.get(cap))
    else {
        return;
    };
    let n = row.len();
    let inside = |i: i128| usize::try_from((i - start).max(0)).map_or(n, |i| i.min(n));
    // Where the rise reaches the cap, and where the fall leaves it.
    let rise = count.rises.map_or(0, |from| inside(from + count.cap));
    let fall = count.falls.map_or(n, |until| inside(until - count.cap + 1));
    let (rising, rest) = row.split_at_mut(rise);
    let (level_part, falling) = rest.split_at_mut(fall.saturating_sub(rise));
    for (sum, i) in rising.iter_mut().zip(start..) {
        slope(sum, count.at(i), ramp);
    }
    for sum in level_part {
        *sum = sum.clone() + level;
    }
    let after = start + i128::try_from(fall.max(rise)).unwrap_or(0);
    for (sum, i) in falling.iter_mut().zip(after..) {
        slope(sum, count.at(i), ramp);
    }
}

fn slope<V: Clone + for<'a> Add<&'a V, Output = V>>(sum: &mut V, count: i128, ramp: &[V]) {
    if let Some(value) = usize::try_from(count).ok().and_then(|n| ramp.get(n)) {
        *sum = sum.clone() + value;
    }
}
