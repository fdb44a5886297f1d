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

mod cells;
mod forces;
mod planes;

pub(crate) use cells::Cells;
pub use forces::{ExactSweep, Sweep};
pub(crate) use planes::{Least, Planes, Size, bound};

use alloc::vec::Vec;
use core::ops::Range;

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::Error;
use crate::lattice::{Region, Row, Site};
use crate::lines::Lines;
use crate::meter::Meter;
use crate::scalar::Algebra;
use crate::shape::{Shape, Stretch};

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
    /// Adds the increments of a pass, by direction, and turns what it ends at if the sign changes there.
    fn pass(&mut self, grid: &Grid<'_>, pass: &Pass, increments: &[T::Numerator; 3]);

    /// Makes the passes that were only noted: before anything else is asked of the layer.
    fn catch_up(&mut self, _grid: &Grid<'_>) {}

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
    pub(crate) fn advance<M: Meter>(&mut self, k: i128, meter: M) {
        loop {
            let Some(pass) = self.grid.passes(self.k, k).next() else {
                self.layer.catch_up(&self.grid);
                return;
            };
            self.settle();
            self.add_extras(pass.from + 1..pass.k);
            let increments = self.lines.increments_after(pass.run.index);
            self.layer.pass(&self.grid, &pass, &increments);
            meter.pass();
            if M::COUNTS && pass.turns {
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
        if !sites.is_empty() {
            self.layer.catch_up(&self.grid);
        }
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

    /// The changes of sign across which what the lines carry is turned.
    pub(crate) fn turned_already(&self) -> usize {
        self.pass
            .map_or(0, |pass| pass.run.index + usize::from(pass.turns))
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

impl<'p, T: Algebra> Descent<'p, T, Cells<T::Numerator>> {
    /// What the lines of any row of this layer carry.
    pub(crate) fn carried_by_rows<'s>(
        &'s self,
    ) -> impl Fn(&Row) -> [&'s [T::Numerator]; 3] + use<'s, 'p, T> {
        let shift = self.grid.shift(self.k);
        move |row| self.layer.slices(self.grid.row(row.j, &row.i, shift))
    }
}

impl Descent<'_, BigRational, Planes> {
    /// The least number on the lines of this layer.
    pub(crate) fn least(&mut self) -> Option<Least> {
        self.layer.least(&self.grid, self.pass.as_ref()?)
    }
}

/// The number of sites in a range that fits in memory.
fn length(i: &Range<i128>) -> usize {
    usize::try_from(i.end - i.start).unwrap_or(0)
}
