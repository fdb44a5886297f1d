//! The grid of cells, with the range of each row that forces can reach.

use core::ops::Range;

use cannonpile::engine::refuse_beyond_memory;
use cannonpile::lattice::{Direction, Sign};
use num_bigint::BigUint;

use super::place::Place;
use crate::error::bug;
use crate::{Each, Error};

/// The largest number of 64-bit words that the recursion stores.
const MAX_WORDS: u64 = 100_000_000;

/// The shifts of a cell by a contact of each direction, for a sign.
pub(super) type Shifts = fn(Sign) -> [[isize; 2]; 3];

/// Returns the shifts of a site.
pub(super) fn site_shifts(sign: Sign) -> [[isize; 2]; 3] {
    let step = match sign {
        Sign::Plus => 1,
        Sign::Minus => -1,
    };
    [[0, 0], [step, 0], [0, step]]
}

/// Returns the shifts of a place.
pub(super) fn place_shifts(sign: Sign) -> [[isize; 2]; 3] {
    Place::descents(sign)
}

/// Rows of cells with a margin of one free cell. For each layer and row the grid stores the range that forces can
/// reach.
///
/// The ranges of a layer contain those of the layer above.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    /// The coordinates of the first cell.
    origin: [i128; 2],
    stride: usize,
    rows: usize,
    /// By layer and row.
    windows: Vec<Vec<Range<usize>>>,
    shifts: Shifts,
}

/// The rows of the first layer: the second coordinate, and the range of the first coordinate.
pub(super) type FirstRows = Vec<(i128, Range<i128>)>;

/// The size of a grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    /// The least and the greatest coordinates of the first layer.
    least: [i128; 2],
    greatest: [i128; 2],
    /// The growth of the ranges from layer to layer: 0 or 1.
    reach: i128,
    steps: i128,
}

impl Size {
    /// Returns the size of a grid whose first layer has coordinates between these. Each further layer extends by
    /// `reach`, 0 or 1.
    pub(super) const fn new(
        least: [i128; 2],
        greatest: [i128; 2],
        reach: i128,
        steps: i128,
    ) -> Self {
        Self {
            least,
            greatest,
            reach,
            steps,
        }
    }

    /// Rejects a grid that exceeds the memory limit, with `per_cell` numbers of `words` words in each cell.
    ///
    /// # Errors
    /// [`TooLarge`](cannonpile::Error::TooLarge) beyond [`MAX_WORDS`].
    pub(super) fn check(
        &self,
        quantity: &'static str,
        per_cell: &BigUint,
        words: u64,
    ) -> Result<(), Error> {
        let mut cells = BigUint::from(1_u32);
        for axis in [0, 1] {
            let side = BigUint::from(self.greatest[axis].abs_diff(self.least[axis]));
            let reach = BigUint::from(2 * self.reach.unsigned_abs()) * self.steps.unsigned_abs();
            cells *= side + reach + 3_u32;
        }
        // The last term estimates the ranges.
        let needed = cells * per_cell + BigUint::from(self.steps.unsigned_abs());
        let words = words.max(1);
        // Saturation is correct, because no machine has so many words.
        let bytes = usize::try_from(words).map_or(usize::MAX, |words| words.saturating_mul(8));
        refuse_beyond_memory(
            quantity,
            &needed,
            (MAX_WORDS / words, bytes),
            "use fewer layers, or a smaller pile",
        )?;
        Ok(())
    }
}

impl Grid {
    /// Returns a grid whose size was checked.
    ///
    /// # Errors
    /// [`Bug`](cannonpile::Error::Bug).
    pub(super) fn new(size: &Size, first: &FirstRows, shifts: Shifts) -> Result<Self, Error> {
        let small = |n: i128| usize::try_from(n).map_err(|_| bug("the size was checked"));
        let margin = size.reach * size.steps + 1;
        let origin: [i128; 2] = size.least.each(|least| least - margin);
        let side = |axis: usize| small(size.greatest[axis] + margin - origin[axis] + 1);
        let (stride, rows) = (side(0)?, side(1)?);
        let mut window = vec![0..0; rows];
        for (row, range) in first {
            let cells = small(range.start - origin[0])?..small(range.end - origin[0])?;
            let place = window.get_mut(small(row - origin[1])?);
            *place.ok_or_else(|| bug("the size was checked"))? = cells;
        }
        let mut windows = vec![window];
        for _ in 0..small(size.steps)? {
            let above = windows
                .last()
                .ok_or_else(|| bug("there is a first layer"))?;
            let next = if size.reach == 0 {
                above.clone()
            } else {
                dilated(above)
            };
            windows.push(next);
        }
        Ok(Self {
            origin,
            stride,
            rows,
            windows,
            shifts,
        })
    }

    /// Returns the number of cells.
    pub(super) const fn cells(&self) -> usize {
        self.stride * self.rows
    }

    /// Returns the number of cells of a layer that forces can reach.
    ///
    /// # Errors
    /// [`Bug`](cannonpile::Error::Bug).
    pub(super) fn reached(&self, layer: usize) -> Result<usize, Error> {
        Ok(self.window(layer)?.map(|cells| cells.len()).sum())
    }

    /// Iterates over the ranges of a layer that are not empty, counted from the first cell of the grid.
    ///
    /// # Errors
    /// [`Bug`](cannonpile::Error::Bug) for a layer that does not exist.
    pub(super) fn window(
        &self,
        layer: usize,
    ) -> Result<impl Iterator<Item = Range<usize>> + '_, Error> {
        let window = self.windows.get(layer);
        let window = window.ok_or_else(|| bug("there are as many windows as layers"))?;
        let rows = window.iter().enumerate();
        let rows = rows.filter(|(_, cells)| !cells.is_empty());
        Ok(rows.map(|(row, cells)| {
            let start = row * self.stride;
            start + cells.start..start + cells.end
        }))
    }

    /// Returns the coordinates of a cell.
    pub(super) fn coordinates(&self, cell: usize) -> [i128; 2] {
        let [a, b] = [cell % self.stride, cell / self.stride];
        // Both numbers are below the number of cells in memory, so both conversions are exact.
        [self.origin[0] + a as i128, self.origin[1] + b as i128]
    }

    /// Returns the cell with these coordinates, or `None` outside of the grid.
    pub(super) fn cell(&self, at: [i128; 2]) -> Option<usize> {
        let [a, b] = [0, 1].each(|axis| usize::try_from(at[axis] - self.origin[axis]).ok());
        let (a, b) = (a?, b?);
        (a < self.stride && b < self.rows).then(|| b * self.stride + a)
    }

    /// Returns the cells from which contacts of this direction lead to the given cells, for a step of this sign.
    pub(super) fn above(
        &self,
        cells: &Range<usize>,
        sign: Sign,
        direction: Direction,
    ) -> Result<Range<usize>, Error> {
        let [da, db] = (self.shifts)(sign)[direction.index()];
        let stride = isize::try_from(self.stride).map_err(|_| bug("the size was checked"))?;
        let back = -(db * stride + da);
        let moved = |cell: usize| cell.checked_add_signed(back);
        let (Some(start), Some(end)) = (moved(cells.start), moved(cells.end)) else {
            return Err(bug("there is a free cell all around"));
        };
        Ok(start..end)
    }
}

/// Returns the ranges one layer further down, for both signs.
fn dilated(window: &[Range<usize>]) -> Vec<Range<usize>> {
    let range = |row: Option<usize>| {
        let range = row.and_then(|row| window.get(row));
        range.filter(|range| !range.is_empty())
    };
    let hulls = (0..window.len()).map(|row| {
        // The same row is reached by ±u_β, the next one by u_α and −u_γ, and the previous one by −u_α and u_γ. A
        // nonempty range starts after the first cell of its row.
        let parts = [
            range(Some(row)).map(|range| range.start - 1..range.end + 1),
            range(row.checked_add(1)).map(|range| range.start - 1..range.end),
            range(row.checked_sub(1)).map(|range| range.start..range.end + 1),
        ];
        let hull = |hull: Range<usize>, part: Range<usize>| {
            hull.start.min(part.start)..hull.end.max(part.end)
        };
        // No force reaches a row without parts, so its range is empty.
        parts.into_iter().flatten().reduce(hull).unwrap_or(0..0)
    });
    hulls.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first layer is 98 × 998 cells, and the margin is one cell on each side: 10⁵ cells.
    #[test]
    fn sizes_are_limited() {
        let needed = |reach, steps, per_cell: u32, words| {
            let size = Size::new([-7, 5], [90, 1002], reach, steps);
            match size.check("cells", &per_cell.into(), words) {
                Ok(()) => None,
                Err(Error::Core(cannonpile::Error::TooLarge { needed, limit, .. })) => {
                    assert_eq!(limit, MAX_WORDS / words.max(1));
                    u64::try_from(needed).ok()
                }
                Err(error) => panic!("{error}"),
            }
        };
        assert_eq!(needed(0, 0, 1000, 1), None);
        assert_eq!(needed(0, 0, 1000, 0), None);
        assert_eq!(needed(0, 0, 1001, 1), Some(100_100_000));
        // One more layer of ranges.
        assert_eq!(needed(0, 1, 1000, 1), Some(100_000_001));
        assert_eq!(needed(0, 0, 500, 2), None);
        assert_eq!(needed(0, 0, 501, 2), Some(50_100_000));
        // 50 more cells on each side.
        assert_eq!(needed(1, 50, 454, 1), None);
        assert_eq!(needed(1, 50, 455, 1), Some(200 * 1100 * 455 + 50));
    }

    /// Two steps around two cells, with a margin of one cell.
    #[test]
    fn cells_and_coordinates_agree() {
        let size = Size::new([2, -1], [3, -1], 1, 2);
        let first = FirstRows::from([(-1, 2..4)]);
        let grid = Grid::new(&size, &first, place_shifts).unwrap();
        assert_eq!(grid.cells(), 8 * 7);
        for (a, b) in (-9..=12).flat_map(|a| (-9..=9).map(move |b| (a, b))) {
            let is_inside = (-1..=6).contains(&a) && (-4..=2).contains(&b);
            let cell = grid.cell([a, b]);
            assert_eq!(cell.is_some(), is_inside, "{a} {b}");
            if let Some(cell) = cell {
                assert!(cell < grid.cells());
                assert_eq!(grid.coordinates(cell), [a, b]);
            }
        }
        // Rows of 2; then of 3, 4, 3; then of 4, 5, 6, 5, 4.
        for (layer, cells) in [2, 10, 24].into_iter().enumerate() {
            assert_eq!(grid.reached(layer).unwrap(), cells);
        }
    }
}
