//! A number for each line of a layer.

use alloc::vec::Vec;
use core::ops::{Add, Range};

use super::grid::{Grid, Layer, Pass};
use super::parallel;
use crate::formula;
use crate::lattice::{Along, Slopes};
use crate::scalar::{Algebra, Ring};

/// How many numbers are worth a thread of their own.
pub(super) const WORTH_A_THREAD: usize = 1 << 13;

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

/// Rows of a layer with the cells of their lines in every plane, apart from all other rows.
pub(super) struct Band<'c, V> {
    rows: Range<i128>,
    /// Where the slices begin among all cells.
    starts: [usize; 3],
    planes: Vec<[&'c mut [V]; 3]>,
}

impl<V: Clone + for<'a> Add<&'a V, Output = V>> Cells<V> {
    pub(crate) fn new(grid: &Grid<'_>, zero: &V) -> Self {
        Self(core::array::from_fn(
            |_| alloc::vec![zero.clone(); grid.cells],
        ))
    }

    /// Adds to the three lines of a sphere.
    pub(super) fn add_to(&mut self, cells: [usize; 3], values: &[V; 3]) {
        for ((line, cell), value) in self.0.iter_mut().zip(cells).zip(values) {
            if let Some(sum) = line.get_mut(cell) {
                *sum = formula::passed_on(sum.clone(), value);
            }
        }
    }

    /// All rows of the layer that a pass leads to.
    pub(super) fn whole(&mut self, pass: &Pass) -> Band<'_, V> {
        let rows = pass.region.y();
        Band {
            rows: *rows.start()..rows.end() + 1,
            starts: [0; 3],
            planes: alloc::vec![self.0.each_mut().map(Vec::as_mut_slice)],
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

/// The rows of the layer that a pass leads to, in as many bands as there are threads for.
pub(super) fn bands<'c, V>(
    planes: &'c mut [Cells<V>],
    grid: &Grid<'_>,
    pass: &Pass,
) -> Vec<Band<'c, V>> {
    let rows = pass.region.y();
    let (first, end) = (*rows.start(), rows.end() + 1);
    let worth = grid.cells * planes.len() / WORTH_A_THREAD;
    // More than threads: rows are not of one length, and threads not of one speed. Not asked for where they are not worth it.
    let bands = if worth > 1 {
        worth.min(4 * parallel::threads())
    } else {
        1
    };
    let bands = i128::try_from(bands).unwrap_or(1).clamp(1, end - first);
    let slices = |Cells(cells): &'c mut Cells<V>| cells.each_mut().map(Vec::as_mut_slice);
    let mut rest: Vec<[&mut [V]; 3]> = planes.iter_mut().map(slices).collect();
    let mut starts = [0; 3];
    let part = |band: i128| first + (end - first) * band / bands;
    let split = (0..bands).map(|band| {
        let (rows, begun) = (part(band)..part(band + 1), starts);
        if rows.end < end {
            let next = pass.region.row(rows.end);
            let next = grid.row(rows.end, &next, pass.shift);
            starts = next.map(|cells| cells.start);
        } else {
            starts = [grid.cells; 3];
        }
        let split_off = |rest: &mut [&'c mut [V]; 3]| {
            let mut lengths = starts.iter().zip(begun).map(|(start, begun)| start - begun);
            rest.each_mut().map(|rest| {
                let n = lengths.next().unwrap_or(0);
                rest.split_off_mut(..n).unwrap_or_default()
            })
        };
        Band {
            rows,
            starts: begun,
            planes: rest.iter_mut().map(split_off).collect(),
        }
    });
    split.collect()
}

impl<V: Clone + for<'a> Add<&'a V, Output = V>> Band<'_, V> {
    /// Adds the increments of a pass, by plane, and turns what it ends at if the sign changes there.
    pub(super) fn add_and_turn(
        &mut self,
        grid: &Grid<'_>,
        pass: &Pass,
        ramps: &[Ramps<V>],
        turn: impl Fn(&[V; 3]) -> [V; 3],
    ) {
        let steps = pass.k - pass.from;
        for j in self.rows.clone() {
            let i = pass.region.row(j);
            let places = grid.row(j, &i, pass.shift);
            let (n, mut places) = (places[0].len(), places.into_iter().zip(self.starts));
            let places: [Range<usize>; 3] = core::array::from_fn(|_| {
                let (cells, start) = places.next().unwrap_or_default();
                cells.start - start..cells.end - start
            });
            let counts = pass.region.row_counts(j, pass.run.sign, steps);
            let [on_a, on_b, on_c] = counts.map(|count| Slopes::new(count, i.start, n));
            for ([alpha, beta, gamma], Ramps([ramp_a, ramp_b, ramp_c])) in
                self.planes.iter_mut().zip(ramps)
            {
                let [a, b, c] = places.clone();
                let (a, b, c) = (&mut alpha[a], &mut beta[b], &mut gamma[c]);
                add(a, &on_a, ramp_a);
                add(b, &on_b, ramp_b);
                add(c, &on_c, ramp_c);
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
}

/// Adds to a row what its counts come to.
fn add<V: Clone + for<'a> Add<&'a V, Output = V>>(row: &mut [V], counts: &Slopes, ramp: &[V]) {
    let Along { up, level, down } = counts.along(0..row.len(), ramp);
    let (rising, rest) = row.split_at_mut(up.len());
    let (same, falling) = rest.split_at_mut(rest.len() - down.len());
    for (sum, value) in rising.iter_mut().zip(up) {
        *sum = formula::passed_on(sum.clone(), value);
    }
    if let Some(value) = level {
        for sum in same {
            *sum = formula::passed_on(sum.clone(), value);
        }
    }
    for (sum, value) in falling.iter_mut().zip(down.iter().rev()) {
        *sum = formula::passed_on(sum.clone(), value);
    }
}

impl<T: Algebra> Layer<T> for Cells<T::Numerator> {
    fn pass(&mut self, grid: &Grid<'_>, pass: &Pass, increments: &[T::Numerator; 3]) {
        let ramps = Ramps::new(pass, increments, |w, n| {
            formula::force(T::Numerator::from_i128(n), w)
        });
        let bands = bands(core::slice::from_mut(self), grid, pass);
        parallel::for_each(bands, |mut band| {
            let ramps = core::slice::from_ref(&ramps);
            band.add_and_turn(grid, pass, ramps, formula::half_turn::<T>);
        });
    }

    fn add_at(&mut self, cells: [usize; 3], values: &[T::Numerator; 3]) {
        self.add_to(cells, values);
    }

    fn at(&self, cells: [usize; 3]) -> [T::Numerator; 3] {
        self.carried(cells).map(Clone::clone)
    }
}
