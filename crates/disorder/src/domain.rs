//! The cells that the recursion runs over, and the cells that can contain spheres.

use core::ops::{Range, RangeInclusive};
use std::collections::BTreeMap;

use cannonpile::engine::refuse_beyond_memory;
use cannonpile::lattice::Region;
use num_bigint::BigUint;

use super::grid::{Grid, Size, place_shifts, site_shifts};
use super::nets::Nets;
use super::number::Number;
use super::piles::{RandomPiles, Setting};
use super::place::Place;
use super::stackings::{FirstSign, RandomStackings};
use crate::Error;
use crate::error::bug;

/// The domain of the recursion for given piles.
///
/// Cells stand for places, or for sites of one layer if the piles are on a base. The position of a site above a base
/// depends on the stacking, so the recursion also stores the net number of the steps that are left: + steps minus −
/// steps.
#[derive(Clone, Debug)]
pub(super) struct Domain<'p> {
    pub(super) piles: &'p RandomPiles,
    pub(super) grid: Grid,
    pub(super) steps: usize,
    /// The number of numbers that the recursion stores.
    numbers: BigUint,
}

/// A row of cells, with the net numbers for which each cell has a sphere.
type RowOfSpheres = (Range<usize>, Vec<Nets>);

const QUANTITY: &str = "the mean over random stackings";

/// Fails unless the process can allocate so many words.
///
/// # Errors
/// [`TooLarge`](cannonpile::Error::TooLarge).
pub(super) fn check_words(words: &BigUint) -> Result<(), Error> {
    refuse_beyond_memory(
        QUANTITY,
        words,
        (u64::MAX, size_of::<u64>()),
        "use fewer layers, or a smaller pile",
    )?;
    Ok(())
}

impl<'p> Domain<'p> {
    /// Returns the domain, if it fits in memory. Each cell stores forces for `classes` numbers of faults, and each
    /// force has `words` 64-bit words.
    ///
    /// # Errors
    /// * [`TooLarge`](cannonpile::Error::TooLarge) beyond the memory limit.
    /// * [`Error::NotAResponse`] for a plane with weight or without loads.
    /// * [`Error::NoStacking`] for a base that supports no stacking of so many layers.
    pub(super) fn new(piles: &'p RandomPiles, classes: u128, words: u64) -> Result<Self, Error> {
        let steps = piles.stackings.steps();
        let on_base = matches!(piles.setting, Setting::On(_));
        // The first layer may have too many rows for memory. So the check of the size uses their bounding box only.
        let corners = match piles.setting {
            Setting::Plane => {
                piles.check_response("the mean of an infinite plane")?;
                let places = loaded(piles)?.into_iter();
                places.map(|place| [place.a, place.b]).collect()
            }
            Setting::Under(top) => top.corners().map(|[i, j]| [2 * i + j, i + 2 * j]).to_vec(),
            Setting::On(base) => {
                let (x, y) = (base.x(), base.y());
                vec![[*x.start(), *y.start()], [*x.end(), *y.end()]]
            }
        };
        let bound = |pick: fn(i128, i128) -> i128| {
            let both = |[a, b]: [i128; 2], [c, d]: [i128; 2]| [pick(a, c), pick(b, d)];
            let bound = corners.iter().copied().reduce(both);
            bound.ok_or_else(|| bug("a pile has a site or a load"))
        };
        let (least, greatest) = (bound(i128::min)?, bound(i128::max)?);
        if let Setting::On(base) = &piles.setting {
            Size::new(least, greatest, 0, 0).check(QUANTITY, &BigUint::from(1_u32), 1)?;
            check_height(base, piles.stackings)?;
        }
        let size = Size::new(least, greatest, i128::from(!on_base), steps);
        // A cell stores forces for three contacts, two layers and two signs. With a given first sign the number of
        // faults determines the sign.
        let signs = if classes > 1 {
            piles.stackings.first_signs().len()
        } else {
            2
        };
        let mut per_cell = BigUint::from(classes) * 6_u32 * signs;
        if on_base {
            // One set for each net number of steps that are left.
            per_cell *= 2 * steps.unsigned_abs() + 1;
        }
        // The estimate of `words` is only meaningful once the numbers fit with one word each.
        size.check(QUANTITY, &per_cell, 1)?;
        size.check(QUANTITY, &per_cell, words)?;
        let first = match piles.setting {
            Setting::Plane => {
                let mut rows = BTreeMap::new();
                for Place { a, b } in loaded(piles)? {
                    let cells = rows.entry(b).or_insert(a..a + 1);
                    *cells = cells.start.min(a)..cells.end.max(a + 1);
                }
                rows.into_iter().collect()
            }
            Setting::Under(top) => (least[1]..=greatest[1])
                .map(|b| (b, row_of(&top, b)))
                .filter(|(_, cells)| !cells.is_empty())
                .collect(),
            Setting::On(base) => base.rows(0).map(|row| (row.j, row.i)).collect(),
        };
        let shifts = if on_base { site_shifts } else { place_shifts };
        let grid = Grid::new(&size, &first, shifts)?;
        let steps = usize::try_from(steps).map_err(|_| bug("the size was checked"))?;
        let numbers = per_cell * grid.cells();
        Ok(Self {
            piles,
            grid,
            steps,
            numbers,
        })
    }

    /// Fails unless the process can allocate the numbers of the recursion, of `words` words each, and `of_place` words for
    /// each place of the bottom layer.
    ///
    /// # Errors
    /// [`TooLarge`](cannonpile::Error::TooLarge).
    pub(super) fn check_memory(&self, words: u64, of_place: &BigUint) -> Result<(), Error> {
        let places = self.bottom()?.len() + 1;
        check_words(&(&self.numbers * words + of_place * places))
    }

    /// Returns the base, for piles on a base.
    pub(super) const fn base(&self) -> Option<Region> {
        match self.piles.setting {
            Setting::On(base) => Some(base),
            Setting::Plane | Setting::Under(_) => None,
        }
    }

    /// Returns the change of the net number by a + step. The net number counts the steps taken, or on a base the steps
    /// that are left.
    pub(super) const fn plus(&self) -> isize {
        match self.piles.setting {
            Setting::On(_) => -1,
            Setting::Plane | Setting::Under(_) => 1,
        }
    }

    /// Returns the net numbers of steps that are left: −n to n on a base, else only 0.
    pub(super) fn nets(&self) -> RangeInclusive<isize> {
        // The number of steps is at most the number of cells in memory, so the conversion is exact.
        let steps = self.steps.cast_signed();
        if self.base().is_some() {
            -steps..=steps
        } else {
            0..=0
        }
    }

    /// Returns the net numbers at the top layer: 0, or on a base all numbers for which the top layer has a sphere.
    pub(super) fn starts(&self) -> impl Iterator<Item = isize> + '_ {
        let has_top = |net: &isize| self.base().is_none() || self.region(0, *net).is_some();
        self.nets().filter(has_top)
    }

    /// Returns the sites of layer `k` above a base, for a net number of steps that are left. `None` if the layer has no
    /// site for this number.
    fn region(&self, k: usize, net: isize) -> Option<Region> {
        let (left, net) = ((self.steps - k) as i128, net as i128);
        let even = (left + net) % 2 == 0 && net.abs() <= left;
        let base = self.base().filter(|_| even)?;
        base.shrunk(left.midpoint(net), left.midpoint(-net))
    }

    /// Returns the net numbers for which layer `k` has a sphere in a cell, for piles that are not on a base.
    fn nets_of(&self, k: usize, cell: usize, within: (i128, i128)) -> Nets {
        let [a, b] = self.grid.coordinates(cell);
        let top = match &self.piles.setting {
            Setting::Under(top) => Some(top),
            Setting::Plane | Setting::On(_) => None,
        };
        Nets::of(Place { a, b }, k as i128, top, within)
    }

    /// Returns the rows of cells that can contain spheres of layer `k`, with the net numbers at which each cell contains
    /// one. On a base only the number `net` is considered.
    pub(super) fn possible_spheres(
        &self,
        k: usize,
        net: isize,
    ) -> Result<Vec<RowOfSpheres>, Error> {
        if self.base().is_none() {
            let within = (-(k as i128), k as i128);
            let nets = |cells: &Range<usize>| {
                let nets = cells.clone().map(|cell| self.nets_of(k, cell, within));
                nets.collect()
            };
            let rows = self.grid.window(k)?;
            return Ok(rows.map(|cells| (cells.clone(), nets(&cells))).collect());
        }
        let Some(region) = self.region(k, net) else {
            return Ok(Vec::new());
        };
        let rows = region.rows(0).map(|row| {
            let start = self.grid.cell([row.i.start, row.j]);
            let end = self.grid.cell([row.i.end - 1, row.j]);
            let (Some(start), Some(end)) = (start, end) else {
                return Err(bug("every layer is above the base"));
            };
            let nets = vec![Nets::only(net as i128); end + 1 - start];
            Ok((start..end + 1, nets))
        });
        rows.collect()
    }

    /// Returns the place of a cell of the bottom layer.
    pub(super) fn place(&self, cell: usize) -> Result<Place, Error> {
        let [a, b] = self.grid.coordinates(cell);
        if self.base().is_none() {
            return Ok(Place { a, b });
        }
        Place::of([a, b], 0).ok_or_else(|| bug("the size was checked"))
    }

    /// Returns the cell of a site of the top layer.
    pub(super) fn top_cell(&self, [i, j]: [i128; 2]) -> Option<usize> {
        let Place { a, b } = Place::of([i, j], 0)?;
        self.grid.cell([a, b])
    }

    /// Returns the cells of the bottom layer that have a row in the result. In each of them some stacking has a sphere,
    /// and in the plane some load can reach that sphere.
    pub(super) fn bottom(&self) -> Result<Vec<usize>, Error> {
        let cells = self.grid.window(self.steps)?.flatten();
        if self.base().is_some() {
            return Ok(cells.collect());
        }
        let within = self.piles.net_bounds();
        let in_plane = matches!(self.piles.setting, Setting::Plane);
        let loads = loaded(self.piles)?;
        let steps = self.steps as i128;
        let is_reached = |cell: usize| {
            let [a, b] = self.grid.coordinates(cell);
            !in_plane
                || loads.iter().any(|load| {
                    let [a, b] = [a - load.a, b - load.b];
                    a.max(b).max(0) - a.min(b).min(0) <= steps
                })
        };
        let has_sphere = |cell: usize| !self.nets_of(self.steps, cell, within).is_empty();
        Ok(cells
            .filter(|cell| is_reached(*cell) && has_sphere(*cell))
            .collect())
    }

    /// Returns the sum of `counts` over the net numbers for which the bottom layer has a sphere in a cell.
    ///
    /// # Errors
    /// [`Bug`](cannonpile::Error::Bug).
    pub(super) fn spheres<T: Number>(&self, cell: usize, counts: &[T]) -> Result<T, Error> {
        let steps = self.steps as i128;
        let nets = if self.base().is_some() {
            // No step is left, and every stacking has the base.
            Nets::only(0)
        } else {
            self.nets_of(self.steps, cell, (-steps, steps))
        };
        nets.sum(counts, self.steps)
    }
}

fn loaded(piles: &RandomPiles) -> Result<Vec<Place>, Error> {
    let places = piles.loads().iter().map(|(site, _)| Place::of(*site, 0));
    let places = places.collect::<Option<_>>();
    places.ok_or_else(|| bug("loads are within the limit of coordinates"))
}

/// Returns the range of a in row b of the places of a top layer. It is empty if the row has no place. The bounds follow
/// from 3i = 2a − b, 3j = 2b − a, 3(i+j) = a + b.
fn row_of(top: &Region, b: i128) -> Range<i128> {
    let up = |n: i128| n.div_euclid(2) + n.rem_euclid(2);
    let least = up(3 * top.x().start() + b)
        .max(2 * b - 3 * top.y().end())
        .max(3 * top.s().start() - b);
    let greatest = (3 * top.x().end() + b)
        .div_euclid(2)
        .min(2 * b - 3 * top.y().start())
        .min(3 * top.s().end() - b);
    // A site of the top layer has a ≡ −b (mod 3).
    let first = least + (-b - least).rem_euclid(3);
    let last = greatest - (greatest + b).rem_euclid(3);
    if first > last { 0..0 } else { first..last + 1 }
}

/// Rejects stackings that are too high for the base. The base must fit in memory.
///
/// # Errors
/// [`Error::NoStacking`].
pub(super) fn check_height(base: &Region, stackings: RandomStackings) -> Result<(), Error> {
    // The first step of a stacking has the given sign.
    let begins = |plus: i128, minus: i128| match stackings.first() {
        FirstSign::Plus => plus > 0,
        FirstSign::Minus => minus > 0,
        FirstSign::Random => true,
    };
    // More − steps leave room for fewer + steps.
    let mut plus = base.x().end() - base.x().start() + base.y().end() - base.y().start();
    let mut greatest = 1;
    for minus in (0..).take_while(|minus| base.shrunk(0, *minus).is_some()) {
        while base.shrunk(plus, minus).is_none() {
            plus -= 1;
        }
        if begins(plus, minus) {
            greatest = greatest.max(plus + minus + 1);
        }
    }
    if greatest < stackings.layers() {
        return Err(Error::NoStacking {
            layers: stackings.layers(),
            greatest,
            base: Box::new(*base),
        });
    }
    Ok(())
}
