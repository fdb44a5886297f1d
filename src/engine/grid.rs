//! The memory layout of a sweep: one cell for each line of contacts.
//!
//! # Cells of lines
//! From one layer to the next every line of contacts continues: each sphere receives three forces and transmits three.
//! So a line has one cell for the whole sweep. The cell is named by the position of the line in the last layer. The
//! three lines of a sphere (i, j) of layer k have the cells
//!
//! α: (i, j), β: (i+o, j), γ: (i, j+o), where o is the net number of + steps from layer k to the last one.
//!
//! For example, a pile of three layers has the stacking "++". For its top sphere (0, 0) the offset o is 2. Its lines
//! have the cells (0, 0), (2, 0) and (0, 2): they end in the three corners of the base.
//!
//! So a step to the next layer moves no number. A whole run is one pass, which adds to each cell the increments of the
//! spheres on its line ([`Region::spheres_above`]). A sign change applies the half-turn to the three cells of each
//! sphere in place. The cell of a line that has not begun contains zero.

use alloc::vec::Vec;
use core::ops::Range;

use num_bigint::BigUint;

use crate::Error;
use crate::each::Each;
use crate::error::{bug, refuse_beyond_memory};
use crate::lattice::{Region, small};
use crate::scalar::Algebra;
use crate::shape::{RunLayers, Shape};

/// The maximum number of values in a sweep: 1 GiB of `i64`.
pub(crate) const MAX_NUMBERS: u64 = 1 << 27;

/// The bytes for each value: eight in its plane, and eight for the results.
const BYTES: usize = 16;

/// The cells of the lines of contacts in a sweep, or in a window of it.
#[derive(Clone, Debug)]
pub(crate) struct Grid<'p> {
    pub(super) shape: &'p Shape,
    /// The layer whose sites name the cells: the last one of the sweep, or of the window.
    pub(super) last: i128,
    /// The last layer of the sweep.
    pub(super) end: i128,
    /// The lower bounds of i and i+j in layer `last`, if only a third of each layer is stored.
    pub(super) corner: Option<[i128; 2]>,
    /// A site near all cells. Positions in `rows` are relative to it.
    pub(super) origin: [i128; 2],
    /// For each row of the last layer: the i of its first site, and the cell of that site. The row after the last one
    /// begins where the cells end.
    rows: Vec<(i64, usize)>,
    pub(super) cells: usize,
}

/// One pass of a sweep, through a run or a part of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pass {
    /// The run of the pass. It may continue below layer `k`.
    pub(crate) run: RunLayers,
    /// Whether the sign changes at layer `k`.
    pub(crate) turns: bool,
    /// The layer at which the pass begins.
    pub(crate) from: i128,
    /// The layer at which the pass ends.
    pub(crate) k: i128,
    pub(crate) region: Region,
    /// The stored spheres of `region`.
    pub(super) stored: Stored,
}

/// The spheres of a layer that a sweep stores, and the position of their cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stored {
    /// All spheres of the layer, or a third whose images are the rest.
    pub(crate) part: Region,
    /// The sum i+j+a of the layer, if only a third of it is stored.
    pub(super) sum: Option<i128>,
    /// The net number of + steps from the layer to the last one.
    pub(super) shift: i128,
}

impl Pass {
    /// Returns the stored rows.
    pub(super) fn rows(&self) -> Range<i128> {
        let rows = self.stored.part.y();
        *rows.start()..rows.end() + 1
    }

    /// Returns an upper bound of the number of spheres on a line in the pass: the smallest of the number of steps and
    /// the widths of the layer.
    pub(super) fn greatest_count(&self) -> i128 {
        let widths = self.region.widths();
        widths.into_iter().fold(self.k - self.from, i128::min)
    }
}

impl<'p> Grid<'p> {
    /// Returns the cells of a sweep from the top to layer `last`, each of `planes` numbers.
    ///
    /// # Errors
    /// [`Error::TooLarge`], with the size; [`Error::LayerOutside`].
    pub(crate) fn new(shape: &'p Shape, last: i128, planes: usize) -> Result<Self, Error> {
        Self::numbers(shape, last, planes)?;
        Self::over(shape, [last, last], None, &shape.layer(last)?)
    }

    /// Returns the cells of a sweep to layer `end`, named by the sites of layer `last` within a region.
    ///
    /// # Errors
    /// [`Error::Bug`] for a row that exceeds the address space.
    pub(super) fn over(
        shape: &'p Shape,
        [last, end]: [i128; 2],
        corner: Option<[i128; 2]>,
        region: &Region,
    ) -> Result<Self, Error> {
        let origin = [*region.x().start(), *region.y().start()];
        let mut rows = Vec::new();
        let mut cells = 0;
        for row in region.rows(last) {
            rows.push((small(row.i.start - origin[0])?, cells));
            cells += length(small(row.i.end - row.i.start)?)?;
        }
        rows.push((0, cells));
        Ok(Self {
            shape,
            last,
            end,
            corner,
            origin,
            rows,
            cells,
        })
    }

    /// Returns the number of values in a sweep from the top to layer `last`.
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

    /// Returns the next pass from layer `from` towards layer `to`. It ends with its run, at layer `to`, or with the
    /// window, whichever comes first. Returns `None` if no such layer lies below `from`.
    ///
    /// # Errors
    /// [`Error::Bug`] if a line of the layer where the pass ends has no cell.
    pub(crate) fn pass(&self, from: i128, to: i128) -> Result<Option<Pass>, Error> {
        let to = to.min(self.last);
        if from >= to {
            return Ok(None);
        }
        let run = self.shape.run_to(from + 1);
        let run = run.ok_or_else(|| bug("a run leads to every layer below the top"))?;
        let k = run.to.min(to);
        let pass = Pass {
            run,
            turns: k == run.to && k < self.end,
            from,
            k,
            region: self.shape.layer(k)?,
            stored: self.stored(k)?,
        };
        // Layers are convex, and so are the sets of cells of their lines. So a check of the corners suffices.
        for site in pass.stored.part.corners() {
            self.site(site, pass.stored.shift)?;
        }
        Ok(Some(pass))
    }

    /// Returns the spheres of a layer that the sweep stores.
    ///
    /// # Errors
    /// [`Error::LayerOutside`].
    pub(crate) fn stored(&self, k: i128) -> Result<Stored, Error> {
        let layer = self.shape.layer(k)?;
        let shift = self.shift(k);
        Ok(match self.corner {
            // The corner is lower by one for each + step between the layers.
            Some(corner) => Stored {
                part: cut(&layer, corner, (self.last - k).midpoint(shift))?,
                sum: Some(sum(&layer)?),
                shift,
            },
            None => Stored {
                part: layer,
                sum: None,
                shift,
            },
        })
    }

    /// Returns the net number of + steps from layer `k` to the last one.
    pub(super) fn shift(&self, k: i128) -> i128 {
        self.shape.shift(self.last) - self.shape.shift(k)
    }

    /// Returns the cells of `length` consecutive lines, from the line that ends at site (i, j) of the last layer.
    ///
    /// # Errors
    /// [`Error::Bug`] if one of the cells does not exist.
    #[inline]
    fn cells(&self, i: i64, j: i64, length: usize) -> Result<Range<usize>, Error> {
        let cells = self.cells_in_row(i, j, length);
        cells.ok_or_else(|| bug("every line of a layer continues to the last one"))
    }

    #[inline]
    fn cells_in_row(&self, i: i64, j: i64, length: usize) -> Option<Range<usize>> {
        let row = usize::try_from(j).ok()?;
        let [(first, cell), (_, next)] = self.rows.get(row..)?.first_chunk()?;
        let start = cell.checked_add(usize::try_from(i - first).ok()?)?;
        let cells = start..start.checked_add(length)?;
        (cells.end <= *next).then_some(cells)
    }

    /// Returns the first cell of row j of the last layer.
    ///
    /// # Errors
    /// [`Error::Bug`] if the layer does not have this row.
    pub(super) fn row_start(&self, j: i128) -> Result<usize, Error> {
        let row = usize::try_from(j - self.origin[1]).ok();
        let row = row.and_then(|row| self.rows.get(row));
        row.map(|(_, cell)| *cell)
            .ok_or_else(|| bug("every row of a layer continues to the last one"))
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
        let [x, y] = self.origin;
        self.nearby_row(
            small(j - y)?,
            &(small(i.start - x)?..small(i.end - x)?),
            small(shift)?,
        )
    }

    /// Returns [`row`](Self::row) for a row whose position is relative to the origin.
    ///
    /// # Errors
    /// As for [`row`](Self::row).
    #[inline]
    pub(super) fn nearby_row(
        &self,
        j: i64,
        i: &Range<i64>,
        shift: i64,
    ) -> Result<[Range<usize>; 3], Error> {
        let n = length(i.end - i.start)?;
        Ok([
            self.cells(i.start, j, n)?,
            self.cells(i.start + shift, j, n)?,
            self.cells(i.start, j + shift, n)?,
        ])
    }

    /// Returns the cells of a sphere, by direction.
    ///
    /// # Errors
    /// As for [`row`](Self::row).
    pub(crate) fn site(&self, [i, j]: [i128; 2], shift: i128) -> Result<[usize; 3], Error> {
        let cells = self.row(j, &(i..i + 1), shift)?;
        Ok(cells.each(|cells| cells.start))
    }
}

/// The moves of numbers from one window to the next.
#[derive(Default)]
pub(crate) struct Moves {
    /// Rows whose lines are stored in both windows.
    pub(super) rows: Vec<Piece>,
    /// Single lines, each copied from an image under the threefold symmetry.
    pub(super) images: Vec<Piece>,
}

/// A piece of a row that is stored in other cells of the next window: direction and first cell in both windows, and the
/// length.
pub(super) struct Piece {
    pub(super) from: (usize, usize),
    pub(super) to: (usize, usize),
    pub(super) length: usize,
}

/// The numbers on the lines of a layer, in one of several representations.
pub(crate) trait Layer<T: Algebra> {
    /// Makes a pass: adds its increments, by direction, and turns the forces if it ends at a sign change. May defer
    /// this work.
    ///
    /// # Errors
    /// [`Error::Bug`] for a number beyond its proved width.
    fn pass(
        &mut self,
        grid: &Grid<'_>,
        pass: &Pass,
        increments: &[T::Numerator; 3],
    ) -> Result<(), Error>;

    /// Makes all deferred passes. Must be called before any method other than `pass`.
    ///
    /// # Errors
    /// As for [`pass`](Self::pass).
    fn catch_up(&mut self, grid: &Grid<'_>) -> Result<(), Error>;

    /// Adds values to the three lines of a sphere.
    ///
    /// # Errors
    /// As for [`pass`](Self::pass).
    fn add_at(&mut self, cells: [usize; 3], values: &[T::Numerator; 3]) -> Result<(), Error>;

    /// Moves the numbers to the cells of the next window.
    fn move_to(&mut self, next: &Grid<'_>, moves: &Moves);

    /// Returns the numbers on the three lines of a sphere.
    fn at(&self, cells: [usize; 3]) -> [T::Numerator; 3];
}

/// Asserts that no pass is deferred: numbers may be read and changed only then.
pub(super) fn assert_none_deferred<P>(deferred: &[P]) {
    debug_assert!(
        deferred.is_empty(),
        "deferred passes are made before numbers are read"
    );
}

/// Returns the sites of a region whose i and i+j are at least the bounds `corner`, both lowered by `lower`.
pub(super) fn cut(region: &Region, corner: [i128; 2], lower: i128) -> Result<Region, Error> {
    let part = region.above(corner.each(|bound| bound - lower));
    part.ok_or_else(|| bug("a third of a layer has a sphere"))
}

/// Returns s = i+j+a for a layer that the rotation maps onto itself.
pub(super) fn sum(region: &Region) -> Result<i128, Error> {
    let sum = region.sum_of_turn();
    sum.ok_or_else(|| bug("every layer of a pile is mapped onto itself if its base is"))
}

/// Returns the number of sites in a row.
///
/// # Errors
/// [`Error::Bug`] if the number exceeds the address space.
#[inline]
fn length(sites: i64) -> Result<usize, Error> {
    usize::try_from(sites).map_err(|_| bug("a row of a sweep fits in memory"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Dimension;

    /// The site after the end of a row is not the first one of the next row.
    #[test]
    #[cfg_attr(
        debug_assertions,
        should_panic(expected = "every line of a layer continues")
    )]
    fn a_sphere_past_the_end_of_its_row_is_a_bug() {
        let shape = Shape::pyramid(2, Dimension::Three).unwrap();
        let grid = Grid::new(&shape, 1, 1).unwrap();
        assert_eq!(grid.site([1, 0], 0), Ok([1, 1, 1]));
        assert!(matches!(grid.site([2, 0], 0), Err(Error::Bug { .. })));
    }
}
