//! Layer after layer, one layer in memory: the method *sweep*.
//!
//! # Lines keep their cells
//! From layer to layer every line of contacts goes on: each sphere receives three and passes three on. So a line is
//! given a cell, once for all, named by where the line will be in the last layer: the lines of direction α by the site
//! (i, j) they end at, and a sphere (i, j) of layer k finds its three lines at
//!
//! α: (i, j), β: (i+o, j), γ: (i, j+o), where o is the net number of + steps from layer k to the last one.
//!
//! A step without a change of sign moves nothing: lines count up, and a whole run is one pass that adds to each cell
//! the increments of the spheres on it ([`Region::spheres_above`]). A change of sign turns the three cells of each
//! sphere in place. A line that has not begun is a cell that holds zero.
//!
//! # Numbers
//! The passes are linear, and the same for every number: a [`Cells`] of the numerators of a scalar is the generic
//! sweep; several of `i64`, one for each limb, are the exact engine ([`Planes`](planes::Planes)).

mod planes;

pub(crate) use planes::{Least, Planes, Size};

use alloc::vec::Vec;
use core::ops::{Add, Range};

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::Error;
use crate::lattice::{Region, Shape, Site, Stretch, Trapezoid};
use crate::lines::Lines;
use crate::meter::Meter;
use crate::scalar::{Algebra, Ring};
use crate::transfer::turn_numerators;

/// The most numbers that a sweep keeps, 1 GiB of `i64`.
pub(crate) const MAX_NUMBERS: u64 = 1 << 27;

/// Where the lines of a layer have their cells.
#[derive(Clone, Debug)]
pub(crate) struct Grid<'p> {
    shape: &'p Shape,
    /// The last layer of the sweep, which names the cells.
    last: i128,
    first_row: i128,
    /// By row of the last layer: its first site and that site's cell.
    rows: Vec<(i128, usize)>,
    cells: usize,
}

/// One pass: the layer that it leads to, and where that layer's rows lie.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pass {
    /// The run passed through, down to `k`.
    pub(crate) run: Stretch,
    /// Whether a change of sign follows at layer `k`.
    pub(crate) turns: bool,
    /// The layer that the pass begins at.
    pub(crate) from: i128,
    /// The layer that it leads to.
    pub(crate) k: i128,
    pub(crate) region: Region,
    /// The net number of + steps from layer `k` to the last one.
    shift: i128,
}

impl Pass {
    /// No line of the layer has more spheres of the pass on it: not more than steps, nor than sites on a side.
    fn greatest_count(&self) -> i128 {
        let widths = self.region.widths();
        widths.into_iter().fold(self.k - self.from, i128::min)
    }
}

impl<'p> Grid<'p> {
    /// The cells of a sweep from the top to layer `last`, each of `planes` numbers.
    ///
    /// # Errors
    /// [`Error::TooLarge`], with the size; [`Error::LayerOutside`].
    pub(crate) fn new(shape: &'p Shape, last: i128, planes: usize) -> Result<Self, Error> {
        Self::numbers(shape, last, planes)?;
        let region = shape.layer(last)?;
        let mut rows = Vec::new();
        let mut cells = 0;
        for row in region.rows(last) {
            rows.push((row.i.start, cells));
            cells += length(&row.i);
        }
        Ok(Self {
            shape,
            last,
            first_row: *region.y().start(),
            rows,
            cells,
        })
    }

    /// How many numbers they are.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub(crate) fn numbers(shape: &Shape, last: i128, planes: usize) -> Result<BigUint, Error> {
        let numbers = shape.layer(last)?.sites() * 3_u32 * planes;
        if numbers > BigUint::from(MAX_NUMBERS) {
            return Err(Error::TooLarge {
                quantity: "a sweep down to this layer",
                needed: numbers,
                limit: MAX_NUMBERS,
                remedy: "ask for one sphere, or for fewer layers",
            });
        }
        Ok(numbers)
    }

    /// The passes from layer `from` to layer `to`, one for each run between them.
    pub(crate) fn passes(&self, from: i128, to: i128) -> impl Iterator<Item = Pass> + use<'_, 'p> {
        let mut from = from;
        core::iter::from_fn(move || {
            if from >= to {
                return None;
            }
            let run = self.shape.stretch_to(from + 1)?;
            let k = run.to.min(to);
            let pass = Pass {
                run,
                turns: k == run.to && k < self.shape.layers() - 1 && k < self.last,
                from,
                k,
                region: self.shape.layer(k).ok()?,
                shift: self.shift(k),
            };
            from = k;
            Some(pass)
        })
    }

    fn shift(&self, k: i128) -> i128 {
        self.shape.shift(self.last) - self.shape.shift(k)
    }

    /// The cells of consecutive lines, from the place (i, j) in the last layer on.
    fn cells(&self, i: i128, j: i128, length: usize) -> Range<usize> {
        let row = usize::try_from(j - self.first_row).ok();
        let start = row
            .and_then(|row| self.rows.get(row))
            .and_then(|(first, cell)| {
                let along = usize::try_from(i - first).ok()?;
                cell.checked_add(along)
            });
        // Every line of a layer goes on to the last one.
        let start = start.unwrap_or(0);
        start..start + length
    }

    /// The cells of a row of sites of a layer, by direction.
    fn row(&self, j: i128, i: &Range<i128>, shift: i128) -> [Range<usize>; 3] {
        let n = length(i);
        [
            self.cells(i.start, j, n),
            self.cells(i.start + shift, j, n),
            self.cells(i.start, j + shift, n),
        ]
    }

    /// The cells of a sphere of layer `k`, by direction.
    pub(crate) fn site(&self, i: i128, j: i128, k: i128) -> [usize; 3] {
        let shift = self.shift(k);
        self.row(j, &(i..i + 1), shift).map(|cells| cells.start)
    }
}

/// The numbers of a layer, in one of the ways they are kept.
pub(crate) trait Layer<T: Algebra> {
    /// Adds the increments of a pass, and turns what it ends at if the sign changes there.
    fn pass(&mut self, grid: &Grid<'_>, pass: &Pass, increment: &T::Numerator);

    /// Adds to the three lines of a sphere.
    fn add_at(&mut self, cells: [usize; 3], values: &[T::Numerator; 3]);

    /// What the three lines of a sphere carry.
    fn at(&self, cells: [usize; 3]) -> [T::Numerator; 3];
}

/// A pile on its way down: the forces of one layer.
#[derive(Clone, Debug)]
pub(crate) struct Descent<'p, T: Algebra, S> {
    lines: Lines<'p, T>,
    grid: Grid<'p>,
    layer: S,
    /// The last pass; none at the top.
    pass: Option<Pass>,
    k: i128,
    /// Whether what weighs more on layer `k` is on its lines already.
    settled: bool,
}

impl<'p, T: Algebra, S: Layer<T>> Descent<'p, T, S> {
    pub(crate) fn new(lines: Lines<'p, T>, grid: Grid<'p>, layer: S) -> Self {
        Self {
            lines,
            grid,
            layer,
            pass: None,
            k: 0,
            settled: false,
        }
    }

    pub(crate) fn lines(&self) -> &Lines<'p, T> {
        &self.lines
    }

    pub(crate) fn pass(&self) -> Option<&Pass> {
        self.pass.as_ref()
    }

    /// The layer that it is at.
    pub(crate) fn k(&self) -> i128 {
        self.k
    }

    /// Goes down to layer `k`, if it is further down.
    pub(crate) fn advance(&mut self, k: i128, meter: impl Meter) {
        loop {
            let Some(pass) = self.grid.passes(self.k, k).next() else {
                return;
            };
            self.settle();
            self.add_extras(pass.from + 1..pass.k);
            let increment = self.lines.increment_after(pass.run.index);
            self.layer.pass(&self.grid, &pass, &increment);
            meter.pass();
            if pass.turns {
                meter.turn(pass.region.sites().to_usize().unwrap_or(usize::MAX));
            }
            (self.k, self.pass, self.settled) = (pass.k, Some(pass), false);
        }
    }

    /// Puts what weighs more on this layer on its lines.
    pub(crate) fn settle(&mut self) {
        if !self.settled {
            self.add_extras(self.k..self.k + 1);
            self.settled = true;
        }
    }

    fn add_extras(&mut self, layers: Range<i128>) {
        let sites: Vec<Site> = self.lines.extras_in(layers).collect();
        for site in sites {
            let cells = self.grid.site(site.i, site.j, site.k);
            self.layer.add_at(cells, &self.lines.extra(site));
        }
    }

    /// The forces from above on a sphere of this layer, which must be the last of the sweep, and the changes of sign
    /// before.
    pub(crate) fn received(&self, site: Site) -> ([T::Numerator; 3], usize) {
        let cells = self.grid.site(site.i, site.j, site.k);
        let changes = self.pass.map_or(0, |pass| pass.run.index);
        (self.layer.at(cells), changes)
    }

    /// What a sphere of this layer passes on, and the changes of sign down to there.
    pub(crate) fn passed_on(&self, site: Site, meter: impl Meter) -> ([T::Numerator; 3], usize) {
        let (carried, changes) = self.received(site);
        match self.pass {
            Some(pass) if pass.turns => self.lines.with_own(site, carried, changes + 1),
            _ => self.lines.to_below(site, carried, changes, meter),
        }
    }
}

/// A number for each line of a layer, by direction.
#[derive(Clone, Debug)]
pub(crate) struct Cells<V>([Vec<V>; 3]);

impl<V: Clone + for<'a> Add<&'a V, Output = V>> Cells<V> {
    pub(crate) fn new(grid: &Grid<'_>, zero: &V) -> Self {
        Self(core::array::from_fn(
            |_| alloc::vec![zero.clone(); grid.cells],
        ))
    }

    /// Adds the increments of a pass, `ramp[n]` for n spheres, and turns what it ends at if the sign changes there.
    fn add_and_turn(
        &mut self,
        grid: &Grid<'_>,
        pass: &Pass,
        ramp: &[V],
        turn: impl Fn(&[V; 3]) -> [V; 3],
    ) {
        let Self([alpha, beta, gamma]) = self;
        let steps = pass.k - pass.from;
        for row in pass.region.rows(pass.k) {
            let [a, b, c] = grid.row(row.j, &row.i, pass.shift);
            let (a, b, c) = (&mut alpha[a], &mut beta[b], &mut gamma[c]);
            let [on_a, on_b, on_c] = pass.region.row_counts(row.j, pass.run.sign, steps);
            add(a, on_a, row.i.start, ramp);
            add(b, on_b, row.i.start, ramp);
            add(c, on_c, row.i.start, ramp);
            if !pass.turns {
                continue;
            }
            for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                let turned = turn(&[a.clone(), b.clone(), c.clone()]);
                [*a, *b, *c] = turned;
            }
        }
    }

    /// Adds to the three lines of a sphere.
    fn add_to(&mut self, cells: [usize; 3], values: &[V; 3]) {
        for ((line, cell), value) in self.0.iter_mut().zip(cells).zip(values) {
            if let Some(sum) = line.get_mut(cell) {
                *sum = sum.clone() + value;
            }
        }
    }

    /// What the three lines of a sphere carry.
    fn carried(&self, [a, b, c]: [usize; 3]) -> [&V; 3] {
        let Self([alpha, beta, gamma]) = self;
        [&alpha[a], &beta[b], &gamma[c]]
    }

    /// What the lines of a row of spheres carry.
    pub(crate) fn row<'c>(&'c self, grid: &Grid<'_>, pass: &Pass, j: i128) -> [&'c [V]; 3] {
        let Self([alpha, beta, gamma]) = self;
        let [a, b, c] = grid.row(j, &pass.region.row(j), pass.shift);
        [&alpha[a], &beta[b], &gamma[c]]
    }
}

impl Descent<'_, BigRational, Planes> {
    /// The least number on the lines of this layer.
    pub(crate) fn least(&mut self) -> Option<Least> {
        self.layer.least(&self.grid, self.pass.as_ref()?)
    }
}

impl<T: Algebra> Layer<T> for Cells<T::Numerator> {
    fn pass(&mut self, grid: &Grid<'_>, pass: &Pass, increment: &T::Numerator) {
        let ramp = (0..=pass.greatest_count()).map(|n| T::Numerator::from_i128(n) * increment);
        self.add_and_turn(grid, pass, &ramp.collect::<Vec<_>>(), turn_numerators::<T>);
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

/// The number of sites in a range that fits in memory.
fn length(i: &Range<i128>) -> usize {
    usize::try_from(i.end - i.start).unwrap_or(0)
}
