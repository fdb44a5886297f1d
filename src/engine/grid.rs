//! Where the lines of a layer have their cells.
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

use alloc::vec::Vec;
use core::ops::Range;

use num_bigint::BigUint;

use crate::Error;
use crate::error::{bug, refuse_beyond_memory};
use crate::lattice::Region;
use crate::scalar::Algebra;
use crate::shape::{Shape, Stretch};

/// The most numbers that a sweep keeps, 1 GiB of `i64`.
pub(crate) const MAX_NUMBERS: u64 = 1 << 27;

/// A number of a plane has eight; and as many are for what is computed from it.
const BYTES: usize = 16;

/// Where the lines of a layer have their cells.
#[derive(Clone, Debug)]
pub(crate) struct Grid<'p> {
    pub(super) shape: &'p Shape,
    /// The layer that names the cells: the last one of the sweep, or of its window.
    pub(super) last: i128,
    /// The last layer of the sweep.
    pub(super) end: i128,
    /// The least i and i+j of layer `last`, if a third of each layer is kept.
    pub(super) corner: Option<[i128; 2]>,
    first_row: i128,
    /// By row of the last layer: its first site and that site's cell.
    rows: Vec<(i128, usize)>,
    pub(super) cells: usize,
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
    /// The spheres of it that are kept.
    pub(crate) part: Region,
    /// The net number of + steps from layer `k` to the last one.
    pub(super) shift: i128,
}

impl Pass {
    /// The rows that are kept.
    pub(super) fn rows(&self) -> Range<i128> {
        let rows = self.part.y();
        *rows.start()..rows.end() + 1
    }

    /// No line of the layer has more spheres of the pass on it: not more than steps, nor than sites on a side.
    pub(super) fn greatest_count(&self) -> i128 {
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
        Self::over(shape, [last, last], None, &shape.layer(last)?)
    }

    /// The cells of a sweep to layer `end`, named by the places of layer `last` in a region.
    ///
    /// # Errors
    /// [`Error::Bug`] for a row that no memory holds.
    pub(super) fn over(
        shape: &'p Shape,
        [last, end]: [i128; 2],
        corner: Option<[i128; 2]>,
        region: &Region,
    ) -> Result<Self, Error> {
        let mut rows = Vec::new();
        let mut cells = 0;
        for row in region.rows(last) {
            rows.push((row.i.start, cells));
            cells += length(&row.i)?;
        }
        Ok(Self {
            shape,
            last,
            end,
            corner,
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
        let numbers = shape.layer(last)?.site_count() * 3_u32 * planes;
        refuse_beyond_memory(
            "a sweep down to this layer",
            &numbers,
            (MAX_NUMBERS, BYTES),
            "ask for one sphere, or for fewer layers",
        )?;
        Ok(numbers)
    }

    /// Returns the next pass on the way from layer `from` down to layer `to`: through one run, or as far as it is asked
    /// for, and not beyond the cells. `None` where there is none.
    ///
    /// # Errors
    /// [`Error::Bug`] if a line of the layer that it leads to has no cell.
    pub(crate) fn pass(&self, from: i128, to: i128) -> Result<Option<Pass>, Error> {
        let to = to.min(self.last);
        if from >= to {
            return Ok(None);
        }
        let run = self.shape.stretch_to(from + 1);
        let run = run.ok_or_else(|| bug("a run leads to every layer below the top"))?;
        let k = run.to.min(to);
        let pass = Pass {
            run,
            turns: k == run.to && k < self.end,
            from,
            k,
            region: self.shape.layer(k)?,
            part: self.part(k)?,
            shift: self.shift(k),
        };
        // Layers are convex, and so are the places their lines lead to: the corners speak for all.
        let places = pass.part.corners().into_iter().flat_map(|[i, j]| {
            let shift = pass.shift;
            [[i, j], [i + shift, j], [i, j + shift]]
        });
        for [i, j] in places {
            self.cells(i, j, 1)?;
        }
        Ok(Some(pass))
    }

    /// Returns the spheres of a layer that a sweep keeps.
    ///
    /// # Errors
    /// [`Error::LayerOutside`].
    pub(crate) fn part(&self, k: i128) -> Result<Region, Error> {
        let layer = self.shape.layer(k)?;
        match self.corner {
            // Lower by one for each + step.
            Some(corner) => cut(&layer, corner, (self.last - k).midpoint(self.shift(k))),
            None => Ok(layer),
        }
    }

    pub(super) fn shift(&self, k: i128) -> i128 {
        self.shape.shift(self.last) - self.shape.shift(k)
    }

    /// Returns the cells of consecutive lines, from that to the place (i, j) of the last layer on.
    ///
    /// # Errors
    /// [`Error::Bug`] if not all of their places are in it.
    fn cells(&self, i: i128, j: i128, length: usize) -> Result<Range<usize>, Error> {
        let cells = self.cells_in_row(i, j, length);
        cells.ok_or_else(|| bug("every line of a layer goes on to the last one"))
    }

    fn cells_in_row(&self, i: i128, j: i128, length: usize) -> Option<Range<usize>> {
        let row = usize::try_from(j.checked_sub(self.first_row)?).ok()?;
        let (first, cell) = self.rows.get(row)?;
        let along = usize::try_from(i.checked_sub(*first)?).ok()?;
        let start = cell.checked_add(along)?;
        let cells = start..start.checked_add(length)?;
        let end = self.rows.get(row + 1).map_or(self.cells, |(_, next)| *next);
        (cells.end <= end).then_some(cells)
    }

    /// Returns the first cell of row j of the last layer.
    ///
    /// # Errors
    /// [`Error::Bug`] if it has no such row.
    pub(super) fn row_start(&self, j: i128) -> Result<usize, Error> {
        let row = usize::try_from(j - self.first_row).ok();
        let row = row.and_then(|row| self.rows.get(row));
        row.map(|(_, cell)| *cell)
            .ok_or_else(|| bug("every row of a layer goes on to the last one"))
    }

    /// Returns the cells of a row of sites of a layer, by direction.
    ///
    /// # Errors
    /// [`Error::Bug`] if one of their lines has no cell.
    pub(super) fn row(
        &self,
        j: i128,
        i: &Range<i128>,
        shift: i128,
    ) -> Result<[Range<usize>; 3], Error> {
        let n = length(i)?;
        Ok([
            self.cells(i.start, j, n)?,
            self.cells(i.start + shift, j, n)?,
            self.cells(i.start, j + shift, n)?,
        ])
    }

    /// Returns the cells of a sphere of layer `k`, by direction.
    ///
    /// # Errors
    /// As for [`row`](Self::row).
    pub(crate) fn site(&self, i: i128, j: i128, k: i128) -> Result<[usize; 3], Error> {
        let cells = self.row(j, &(i..i + 1), self.shift(k))?;
        Ok(cells.map(|cells| cells.start))
    }
}

/// From where the numbers of the next window come.
#[derive(Default)]
pub(crate) struct Moves {
    /// From the same lines.
    pub(super) rows: Vec<Piece>,
    /// One by one from images.
    pub(super) images: Vec<Piece>,
}

/// Numbers that are in other cells in the next window: direction and first cell in both, and how many.
pub(super) struct Piece {
    pub(super) from: (usize, usize),
    pub(super) to: (usize, usize),
    pub(super) length: usize,
}

/// The numbers of a layer, in one of the ways they are kept.
pub(crate) trait Layer<T: Algebra> {
    /// Adds the increments of a pass, by direction, and turns what it ends at if the sign changes there. May note it only.
    ///
    /// # Errors
    /// [`Error::Bug`] for numbers wider than they can be.
    fn pass(
        &mut self,
        grid: &Grid<'_>,
        pass: &Pass,
        increments: &[T::Numerator; 3],
    ) -> Result<(), Error>;

    /// Makes the passes that were only noted: before anything else is asked of the layer.
    ///
    /// # Errors
    /// As for [`pass`](Self::pass).
    fn catch_up(&mut self, grid: &Grid<'_>) -> Result<(), Error>;

    /// Adds to the three lines of a sphere.
    ///
    /// # Errors
    /// As for [`pass`](Self::pass).
    fn add_at(&mut self, cells: [usize; 3], values: &[T::Numerator; 3]) -> Result<(), Error>;

    /// Takes the numbers to the cells of the next window.
    fn move_to(&mut self, next: &Grid<'_>, moves: &Moves);

    /// What the three lines of a sphere carry.
    fn at(&self, cells: [usize; 3]) -> [T::Numerator; 3];
}

/// Whoever looks at the numbers of a layer has made the passes that lead to them.
pub(super) fn none_wait<P>(waiting: &[P]) {
    debug_assert!(waiting.is_empty(), "passes come before what they lead to");
}

/// The sites not below a corner that is so much lower.
pub(super) fn cut(region: &Region, corner: [i128; 2], lower: i128) -> Result<Region, Error> {
    let part = region.above(corner.map(|bound| bound - lower));
    part.ok_or_else(|| bug("a third of a layer has a sphere"))
}

/// Returns the number of sites in a range.
///
/// # Errors
/// [`Error::Bug`] if no memory holds as many.
fn length(i: &Range<i128>) -> Result<usize, Error> {
    let sites = usize::try_from(i.end - i.start);
    sites.map_err(|_| bug("a row of a sweep fits in memory"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Dimension;

    /// One past the end of a row is no sphere of the next.
    #[test]
    #[cfg_attr(
        debug_assertions,
        should_panic(expected = "every line of a layer goes on")
    )]
    fn a_sphere_past_the_end_of_its_row_is_a_bug() {
        let shape = Shape::pyramid(2, Dimension::Three).unwrap();
        let grid = Grid::new(&shape, 1, 1).unwrap();
        assert_eq!(grid.site(1, 0, 1), Ok([1, 1, 1]));
        assert!(matches!(grid.site(2, 0, 1), Err(Error::Bug { .. })));
    }
}
