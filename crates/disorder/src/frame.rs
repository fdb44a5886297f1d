//! The cells that the piles of random stackings need, and which of them have spheres.

use core::ops::{Range, RangeInclusive};
use std::collections::BTreeMap;

use cannonpile::lattice::Region;
use num_bigint::BigUint;

use super::grid::{FirstRows, Grid, Size, of_places, of_sites};
use super::number::Number;
use super::piles::{RandomPiles, Setting};
use super::place::Place;
use super::stackings::{FirstSign, RandomStackings};
use super::walk::Nets;
use crate::Error;
use crate::error::bug;

/// What a recursion over the piles runs on.
#[derive(Clone, Debug)]
pub(super) struct Frame<'p> {
    pub(super) piles: &'p RandomPiles,
    pub(super) grid: Grid,
    pub(super) steps: usize,
}

/// The numbers that a recursion keeps for each cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load {
    /// 1, or the numbers of faults.
    pub(super) classes: u128,
    /// 64-bit words of a number.
    pub(super) words: u64,
}

const QUANTITY: &str = "the mean over random stackings";

impl<'p> Frame<'p> {
    /// Returns the cells, if memory has them.
    ///
    /// # Errors
    /// [`TooLarge`](cannonpile::Error::TooLarge); [`Error::OnlyOfLoads`] for a plane with weight or without loads; [`Error::NoStacking`] for a base
    /// that carries no stacking of so many layers.
    pub(super) fn new(piles: &'p RandomPiles, load: Load) -> Result<Self, Error> {
        let steps = piles.stackings.steps();
        // Rows of the first layer are as many as cells at most: first the size, then what is as large.
        let (least, greatest, reach) = match piles.setting {
            Setting::Plane => {
                piles.check_response("the mean of a plane without end")?;
                let places = loaded(piles)?;
                let bound = |pick: fn(i128, i128) -> i128| {
                    let coordinates = |place: &Place| [place.a, place.b];
                    let pairs = places.iter().map(coordinates);
                    let both = |[a, b]: [i128; 2], [c, d]: [i128; 2]| [pick(a, c), pick(b, d)];
                    pairs
                        .reduce(both)
                        .ok_or_else(|| bug("a plane has loads by the check"))
                };
                (bound(i128::min)?, bound(i128::max)?, 1)
            }
            Setting::Under(top) => {
                let corners = top.corners().map(|[i, j]| [2 * i + j, i + 2 * j]);
                let least = [0, 1].map(|axis| {
                    corners
                        .map(|c| c[axis])
                        .into_iter()
                        .fold(corners[0][axis], i128::min)
                });
                let greatest = [0, 1].map(|axis| {
                    corners
                        .map(|c| c[axis])
                        .into_iter()
                        .fold(corners[0][axis], i128::max)
                });
                (least, greatest, 1)
            }
            Setting::On(base) => {
                let least = [*base.x().start(), *base.y().start()];
                let greatest = [*base.x().end(), *base.y().end()];
                Size::new(least, greatest, 0, 0).check(QUANTITY, &BigUint::from(1_u32), 1)?;
                check_height(&base, piles.stackings)?;
                (least, greatest, 0)
            }
        };
        let size = Size::new(least, greatest, reach, steps);
        // Three lines, two signs, two layers; after so many changes of a first sign that is given there is one sign only.
        let signs = if load.classes > 1 {
            piles.stackings.first_signs().len()
        } else {
            2
        };
        let mut per_cell = BigUint::from(load.classes) * 6_u32 * signs;
        // On a base all that for each number of steps that are left.
        if matches!(piles.setting, Setting::On(_)) {
            per_cell *= 2 * steps.unsigned_abs() + 1;
        }
        // As many numbers must fit even if each were a word; how long they are is estimated for what does.
        size.check(QUANTITY, &per_cell, 1)?;
        size.check(QUANTITY, &per_cell, load.words)?;
        let first = match piles.setting {
            Setting::Plane => {
                let mut rows: BTreeMap<i128, Range<i128>> = BTreeMap::new();
                for Place { a, b } in loaded(piles)? {
                    let cells = rows.entry(b).or_insert(a..a + 1);
                    *cells = cells.start.min(a)..cells.end.max(a + 1);
                }
                FirstRows::from_iter(rows)
            }
            Setting::Under(top) => (least[1]..=greatest[1])
                .map(|b| (b, row_of(&top, b)))
                .filter(|(_, cells)| !cells.is_empty())
                .collect(),
            Setting::On(base) => base.rows(0).map(|row| (row.j, row.i)).collect(),
        };
        let moves = if matches!(piles.setting, Setting::On(_)) {
            of_sites
        } else {
            of_places
        };
        let grid = Grid::new(&size, &first, moves)?;
        let steps = usize::try_from(steps).map_err(|_| bug("the size was checked"))?;
        Ok(Self { piles, grid, steps })
    }

    /// Whether layers are named by their sites, and by the steps that are left: on a base.
    pub(super) const fn base(&self) -> Option<Region> {
        match self.piles.setting {
            Setting::On(base) => Some(base),
            Setting::Plane | Setting::Under(_) => None,
        }
    }

    /// What a + step adds to the net steps that are counted: those taken, or those left.
    pub(super) const fn plus(&self) -> isize {
        match self.piles.setting {
            Setting::On(_) => -1,
            Setting::Plane | Setting::Under(_) => 1,
        }
    }

    /// The net numbers of steps at the top layer: 0, or those of the stackings that the base carries.
    pub(super) fn starts(&self) -> impl Iterator<Item = isize> + Clone + '_ {
        // As many as there are cells in memory.
        let steps = self.steps.cast_signed();
        let range = if self.base().is_some() {
            -steps..=steps
        } else {
            0..=0
        };
        range.filter(move |net| self.base().is_none() || self.region(0, *net).is_some())
    }

    /// The sites of layer `k` with so many net steps left down to the base; `None` if there are none, or no such number.
    pub(super) fn region(&self, k: usize, net: isize) -> Option<Region> {
        let (left, net) = ((self.steps - k) as i128, net as i128);
        let even = (left + net) % 2 == 0 && net.abs() <= left;
        let base = self.base().filter(|_| even)?;
        base.shrunk(left.midpoint(net), left.midpoint(-net))
    }

    /// The net numbers of steps that layer `k` may have had if it is to have a sphere at a cell: for piles that are not on
    /// a base.
    pub(super) fn nets(&self, k: usize, cell: usize, within: RangeInclusive<i128>) -> Nets {
        let [a, b] = self.grid.coordinates(cell);
        let top = match &self.piles.setting {
            Setting::Under(top) => Some(top),
            Setting::Plane | Setting::On(_) => None,
        };
        Nets::of(Place { a, b }, k as i128, top, within)
    }

    /// The place of a cell of the bottom layer.
    pub(super) fn place(&self, cell: usize) -> Result<Place, Error> {
        let [a, b] = self.grid.coordinates(cell);
        if self.base().is_none() {
            return Ok(Place { a, b });
        }
        Place::of([a, b], 0).ok_or_else(|| bug("the size was checked"))
    }

    /// The cell of a site of the top layer.
    pub(super) fn top_cell(&self, [i, j]: [i128; 2]) -> Option<usize> {
        let Place { a, b } = Place::of([i, j], 0)?;
        self.grid.cell([a, b])
    }

    /// The cells of the bottom layer that are answered, in order: where some stacking has a sphere and, in the plane, some
    /// load can be felt.
    pub(super) fn bottom(&self) -> Result<Vec<usize>, Error> {
        let cells = self.grid.window(self.steps)?.flatten();
        if self.base().is_some() {
            return Ok(cells.collect());
        }
        let within = self.piles.nets();
        let in_plane = matches!(self.piles.setting, Setting::Plane);
        let loads = if in_plane {
            loaded(self.piles)?
        } else {
            Vec::new()
        };
        let steps = self.steps as i128;
        let is_felt = |cell: usize| {
            let [a, b] = self.grid.coordinates(cell);
            !in_plane
                || loads.iter().any(|load| {
                    let [a, b] = [a - load.a, b - load.b];
                    a.max(b).max(0) - a.min(b).min(0) <= steps
                })
        };
        let kept = cells.filter(|cell| {
            is_felt(*cell) && !self.nets(self.steps, *cell, within.clone()).is_empty()
        });
        Ok(kept.collect())
    }

    /// How many stackings, or with which probability, have a sphere of the bottom layer at a cell, by what they are by net
    /// number of steps.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(super) fn spheres<T: Number>(&self, cell: usize, counts: &[T]) -> Result<T, Error> {
        let steps = self.steps as i128;
        if self.base().is_some() {
            // No step is left, and the base is always there.
            let none_left = counts.get(self.steps).cloned();
            return none_left.ok_or_else(|| bug("a list has a place for no step"));
        }
        self.nets(self.steps, cell, -steps..=steps)
            .sum(counts, self.steps)
    }

    /// Ranges of cells of a region whose layers are named by sites.
    pub(super) fn rows_of(&self, region: &Region) -> Result<Vec<Range<usize>>, Error> {
        let rows = region.rows(0).map(|row| {
            let start = self.grid.cell([row.i.start, row.j]);
            let end = self.grid.cell([row.i.end - 1, row.j]);
            let (Some(start), Some(end)) = (start, end) else {
                return Err(bug("every layer is above the base"));
            };
            Ok(start..end + 1)
        });
        rows.collect()
    }
}

fn loaded(piles: &RandomPiles) -> Result<Vec<Place>, Error> {
    piles
        .loaded_places()
        .ok_or_else(|| bug("loads are within the limit of coordinates"))
}

/// The range of a in row b of the places of a top layer: 3i = 2a − b, 3j = 2b − a, 3(i+j) = a + b. Empty where no place is.
fn row_of(top: &Region, b: i128) -> Range<i128> {
    let up = |n: i128| n.div_euclid(2) + n.rem_euclid(2);
    let least = up(3 * top.x().start() + b)
        .max(2 * b - 3 * top.y().end())
        .max(3 * top.s().start() - b);
    let greatest = (3 * top.x().end() + b)
        .div_euclid(2)
        .min(2 * b - 3 * top.y().start())
        .min(3 * top.s().end() - b);
    // A sphere has a ≡ −b (mod 3).
    let first = least + (-b - least).rem_euclid(3);
    let last = greatest - (greatest + b).rem_euclid(3);
    if first > last { 0..0 } else { first..last + 1 }
}

/// Refuses stackings of which a base carries none; the base must fit into memory.
fn check_height(base: &Region, stackings: RandomStackings) -> Result<(), Error> {
    // What is left after p + steps and m − steps, for the greatest p, less and less as m grows.
    let widest = base.x().end() - base.x().start() + base.y().end() - base.y().start();
    let most = |minus: i128| {
        let (mut least, mut beyond) = (0, widest + 1);
        while beyond - least > 1 {
            let middle = least.midpoint(beyond);
            if base.shrunk(middle, minus).is_some() {
                least = middle;
            } else {
                beyond = middle;
            }
        }
        [least, minus]
    };
    // One step at least has the first sign.
    let begins = |[plus, minus]: &[i128; 2]| match stackings.first() {
        FirstSign::Plus => *plus > 0,
        FirstSign::Minus => *minus > 0,
        FirstSign::Random => true,
    };
    let heights = (0..).take_while(|minus| base.shrunk(0, *minus).is_some());
    let heights = heights.map(most).filter(begins);
    let greatest = heights.fold(0, |most, [plus, minus]| most.max(plus + minus)) + 1;
    if greatest < stackings.layers() {
        return Err(Error::NoStacking {
            layers: stackings.layers(),
            greatest,
            base: Box::new(*base),
        });
    }
    Ok(())
}
