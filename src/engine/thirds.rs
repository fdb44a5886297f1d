//! Sweeps that store a third of each layer, for piles with threefold symmetry.
//!
//! # The rotation
//! Let a layer have the bounds x₀ ≤ i, j ≤ x₁ and s − x₁ ≤ i+j ≤ s − x₀. The rotation by 120° maps it onto itself:
//! (i, j) → (j, s−i−j). It maps α to γ, γ to β and β to α. A + step adds 1 to s, and a − step subtracts 1 from it. So
//! the rotation maps the layer below onto itself as well. If all spheres weigh the same, and the three increments are
//! equal, the forces have the same symmetry.
//!
//! # The stored part
//! With a = s−i−j the rotation maps (i, j, a) to (j, a, i). The differences of three numbers from their mean sum to
//! zero. So somewhere in their cyclic order a difference that is not positive is followed by one that is not negative.
//! One of the three images of a site therefore has a ≤ s/3 ≤ i. So the sites with i ≥ ⌈s/3⌉ and i+j ≥ s − ⌊s/3⌋
//! suffice. They form a region again, cut off at a corner.
//!
//! For example, the layer 0 ≤ i, j and i+j ≤ 2 has s = 2. The sites with i ≥ 1 and i+j ≥ 2 are stored (#):
//!
//! ```text
//! j = 2    .
//! j = 1    . #
//! j = 0    . . #
//! ```
//!
//! The rotation maps # at (2, 0) to the corners (0, 2) and (0, 0), and # at (1, 1) to (1, 0) and (0, 1).
//!
//! # Windows
//! A sphere receives forces from the layer n steps further up. After + steps they come from (i, j), (i−n, j) and
//! (i, j−n). After − steps they come from (i, j), (i+n, j) and (i, j+n). So the stored part of a layer follows from
//! that of a layer above, if the corner of the latter is lower by one for each + step between them.
//!
//! Further up, these parts grow beyond a third. So the sweep is divided into *windows* of a few runs. The cells of a
//! window are named by its last layer. They cover the stored part of that layer, widened by the distance that lines
//! move in the window. The next window begins with the same layer, and stores a larger part of it. The additional
//! numbers are copied from their images.
//!
//! # Reading
//! A sphere that is not stored has the forces of its image, each along the rotated direction. So floats of contact
//! forces are computed for the stored spheres alone, and copied to their images.

use super::grid::{Grid, Moves, Piece, Stored, cut, sum};
use crate::Error;
use crate::each::Each;
use crate::error::bug;
use crate::lattice::{Dimension, Direction};
use crate::pile::Pile;
use crate::shape::Shape;

/// The maximum number of steps in a window, unless a single run is longer.
///
/// It is three times the number of passes that are deferred. So few numbers are copied between windows, and few cells
/// lie outside the stored part.
const LAYERS: i128 = 9;

/// Returns whether the forces of a pile have threefold symmetry.
pub(crate) fn has_threefold_symmetry(pile: &Pile) -> bool {
    let even = pile.is_regular() && pile.dimension() == Dimension::Three;
    // If the rotation maps the base or the top onto itself, it does so with all layers.
    even && pile.gravity_is_vertical()
        && pile.has_no_loads()
        && pile.shape().base().sum_of_turn().is_some()
}

impl<'p> Grid<'p> {
    /// Returns the first window of a sweep of thirds from the top to layer `end`, with `planes` numbers in each cell.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub(crate) fn of_thirds(shape: &'p Shape, end: i128, planes: usize) -> Result<Self, Error> {
        Self::numbers(shape, end, planes)?;
        Self::window(shape, end, 0)
    }

    /// Returns the next window, and the moves of the numbers into it.
    ///
    /// # Errors
    /// [`Error::Bug`] at the end of the sweep.
    pub(super) fn next_window(&self) -> Result<(Self, Moves), Error> {
        if self.last == self.end {
            return Err(bug(
                "a sweep is queried only for layers down to its last one",
            ));
        }
        let next = Self::window(self.shape, self.end, self.last)?;
        let moves = self.moves_to(&next)?;
        Ok((next, moves))
    }

    fn window(shape: &'p Shape, end: i128, first: i128) -> Result<Self, Error> {
        let mut last = end;
        if let Some(run) = shape.run_to(first + 1) {
            let within = |index| shape.run(index).filter(|run| run.to - first <= LAYERS);
            let more = (run.index + 1..).map_while(within);
            last = more.fold(run.to, |_, run| run.to).min(end);
        }
        let region = shape.layer(last)?;
        let s = sum(&region)?;
        let corner = [-(-s).div_euclid(3), s - s.div_euclid(3)];
        let net = shape.shift(last) - shape.shift(first);
        // The larger of the numbers of + and − steps is the mean of their sum and their absolute difference.
        let reach = (last - first).midpoint(net.abs());
        let cells = cut(&region, corner, reach)?;
        Self::over(shape, [last, end], Some(corner), &cells)
    }

    /// Returns the moves of the numbers to the next window.
    fn moves_to(&self, next: &Self) -> Result<Moves, Error> {
        let k = self.last;
        let (available, needed) = (self.stored(k)?, next.stored(k)?);
        let mut moves = Moves::default();
        for row in needed.part.rows(k) {
            let same = available.part.row_within(row.j);
            let same = if same.is_empty() {
                row.i.start..row.i.start
            } else {
                same
            };
            if !same.is_empty() {
                let from = self.row(row.j, &same, available.shift)?;
                let to = next.row(row.j, &same, needed.shift)?;
                let lines = from.into_iter().zip(to).enumerate();
                moves.rows.extend(lines.map(|(line, (from, to))| Piece {
                    from: (line, from.start),
                    to: (line, to.start),
                    length: from.len(),
                }));
            }
            for i in (row.i.start..same.start).chain(same.end..row.i.end) {
                let (image, turns) = available.kept([i, row.j])?;
                let from = self.site(image, available.shift)?;
                let to = next.site([i, row.j], needed.shift)?;
                moves.images.extend((0..3).map(|line| {
                    let image = turned(line, turns);
                    Piece {
                        from: (image, from[image]),
                        to: (line, to[line]),
                        length: 1,
                    }
                }));
            }
        }
        Ok(moves)
    }
}

impl Stored {
    /// Returns the images of a sphere under 0, 1 and 2 rotations, or only the sphere if whole layers are stored.
    pub(super) fn images(&self, place: [i128; 2]) -> impl Iterator<Item = [i128; 2]> + use<> {
        let sum = self.sum;
        let next = move |[i, j]: &[i128; 2]| sum.map(|s| [*j, s - i - j]);
        core::iter::successors(Some(place), next).take(3)
    }

    /// Returns the stored image of a sphere, and the number of rotations that lead to it.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(super) fn kept(&self, place: [i128; 2]) -> Result<([i128; 2], usize), Error> {
        if self.sum.is_none() {
            return Ok((place, 0));
        }
        let mut images = self.images(place).zip(0..);
        let kept = images.find(|([i, j], _)| self.part.contains(*i, *j));
        kept.ok_or_else(|| bug("one of three images is kept"))
    }

    /// Copies values that belong to the lines of the stored spheres to the lines of their images. The slices have one
    /// value for each sphere of the layer, by direction.
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(crate) fn copy_to_images<V: Clone>(
        &self,
        shape: &Shape,
        k: i128,
        slices: &mut [&mut [V]; 3],
    ) -> Result<(), Error> {
        let layer = shape.layer(k)?;
        let cells = Grid::over(shape, [k, k], None, &layer)?;
        for row in layer.rows(k) {
            let [own, ..] = cells.row(row.j, &row.i, 0)?;
            for (place, i) in own.zip(row.i) {
                let (image, turns) = self.kept([i, row.j])?;
                if turns > 0 {
                    let [from, ..] = cells.site(image, 0)?;
                    let values = slices.each_ref().each(|slice| slice[from].clone());
                    for line in 0..3 {
                        slices[line][place] = values[turned(line, turns)].clone();
                    }
                }
            }
        }
        Ok(())
    }

    /// Returns the first image of a line in row order, as (j, i, direction).
    ///
    /// # Errors
    /// [`Error::Bug`].
    pub(super) fn first_image(
        &self,
        place: [i128; 2],
        direction: Direction,
    ) -> Result<(i128, i128, Direction), Error> {
        let images = self.images(place).zip(0..);
        let images =
            images.map(|([i, j], turns)| (j, i, Direction::ALL[turned(direction.index(), turns)]));
        images
            .min()
            .ok_or_else(|| bug("a line is an image of itself"))
    }
}

/// Returns the direction after `turns` rotations: α becomes γ, γ becomes β, and β becomes α.
pub(super) fn turned(line: usize, turns: usize) -> usize {
    (line + 2 * turns) % 3
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use num_bigint::BigInt;
    use num_rational::BigRational;

    use super::*;
    use crate::Pile;
    use crate::engine::limbs::Least;
    use crate::engine::rows::{exact_sweep, shortest_exact_sweep};
    use crate::engine::{Cells, LineForces, Planes, Readout, Sweep, Unit};
    use crate::lattice::{Region, Row};
    use crate::scalar::Surd;

    /// Returns piles under tops of one sphere, with six sides, with three sides, and away from the origin, and one pile
    /// on a base. The sign changes at every step, seldom, or irregularly.
    fn piles() -> Vec<Pile> {
        let hexagon = Region::hexagon(3, 2).unwrap();
        let elsewhere = Region::new(5..=8, 5..=8, 9..=12).unwrap();
        let tops = [
            Region::SITE,
            hexagon,
            Region::triangle(4).unwrap(),
            elsewhere,
        ];
        let alternating = "+-".repeat(14);
        let mixed = "+-++---+".repeat(3);
        let stackings = [alternating.as_str(), &mixed, "(2,9,1,1,14,1,1)", "-(12,3)"];
        let mut piles = Vec::new();
        for stacking in stackings {
            let under = |top| Pile::under(top, stacking.parse().unwrap()).unwrap();
            piles.extend(
                tops.into_iter()
                    .flat_map(|top| [under(top), under(top.mirrored())]),
            );
        }
        let base = Region::hexagon(14, 17).unwrap();
        piles.push(Pile::on(base, "+--++-+-+-+--+".parse().unwrap()).unwrap());
        piles
    }

    /// Returns the numbers on the lines of a row as floats.
    fn floats(sweep: &Sweep<'_, BigRational, Planes>, row: &Row) -> [Vec<f64>; 3] {
        let readout = Readout {
            combination: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
            own: [(); 3].map(|()| BigInt::ZERO),
        };
        let unit = || Unit::new(Surd::from(BigRational::from(BigInt::from(1))), 1.into());
        let mut floats = [(); 3].map(|()| alloc::vec![0.0; row.length().unwrap()]);
        let out = floats.each_mut().map(Vec::as_mut_slice);
        let units = [unit(), unit(), unit()];
        assert_eq!(sweep.nearest_row(row, (&readout, &units), out), Ok(true));
        floats
    }

    /// Compares all spheres, as integers and as floats, and the smallest numbers, in every `stops`-th layer.
    fn compare(pile: &Pile, stops: i128) {
        let last = pile.layers() - 1;
        assert!(has_threefold_symmetry(pile));
        let lines = LineForces::<BigRational>::new(pile);
        let mut whole = exact_sweep(&lines, last).unwrap();
        let mut third = shortest_exact_sweep(&lines, last).unwrap();
        for k in (0..=last).filter(|k| (last - k) % stops == 0) {
            whole.advance(k, crate::engine::Meter::NONE).unwrap();
            third.advance(k, crate::engine::Meter::NONE).unwrap();
            let what = alloc::format!("{} {k} {stops}", pile.shape().stacking());
            for site in pile.shape().layer(k).unwrap().rows(k).flatten() {
                let [whole, third] = [&whole, &third].map(|sweep| sweep.received(site));
                assert_eq!(
                    whole.unwrap().forces,
                    third.unwrap().forces,
                    "{what} {site}"
                );
            }
            for row in pile.shape().layer(k).unwrap().rows(k) {
                assert_eq!(floats(&whole, &row), floats(&third, &row), "{what} {row:?}");
            }
            if k > 0 {
                // Of the smallest numbers, whichever line is stored, the first in row order is the same.
                let first = |least: [Least; 3]| {
                    let order = |least: &Least| {
                        let [i, j] = least.place;
                        (least.numerator.clone(), j, i, least.direction)
                    };
                    least.into_iter().min_by_key(order)
                };
                let [whole, third] = [whole.least(), third.least()].map(Result::unwrap);
                assert_eq!(first(whole), first(third), "{what}");
            }
        }
    }

    /// Advances by three layers and by all layers at once, through several windows and through a run longer than a
    /// window.
    #[test]
    fn thirds_of_a_small_pile_give_the_same_numbers() {
        for (top, stacking) in [
            (Region::SITE, "+-+--+-+-+++-"),
            (Region::hexagon(2, 3).unwrap(), "-+-++-+-+-+-"),
            (Region::SITE, "(11,17,1,2)"),
        ] {
            let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
            for stops in [3, pile.layers() - 1] {
                compare(&pile, stops);
            }
        }
    }

    /// Windows work the same with any representation of the numbers.
    #[test]
    fn thirds_in_plain_numbers_give_the_same_numbers() {
        let pile = Pile::under(Region::SITE, "+-+--+-+-+++-+".parse().unwrap()).unwrap();
        let last = pile.layers() - 1;
        let lines = LineForces::<BigRational>::new(&pile);
        let mut whole = exact_sweep(&lines, last).unwrap();
        let grid = Grid::of_thirds(pile.shape(), last, 1).unwrap();
        assert!(grid.last < last);
        let cells = Cells::new(&grid, &BigInt::ZERO);
        let mut third = Sweep::<BigRational, Cells<BigInt>>::new(lines, grid, cells).unwrap();
        whole.advance(last, crate::engine::Meter::NONE).unwrap();
        third.advance(last, crate::engine::Meter::NONE).unwrap();
        for site in pile.shape().layer(last).unwrap().rows(last).flatten() {
            let [whole, third] = [whole.received(site), third.received(site)];
            assert_eq!(whole.unwrap().forces, third.unwrap().forces, "{site}");
        }
    }

    #[test]
    fn thirds_give_the_same_numbers_as_whole_layers() {
        for pile in piles() {
            // Layer by layer, and in steps large enough to defer passes.
            for stops in [1, 2, 7, pile.layers() - 1] {
                compare(&pile, stops);
            }
        }
        // Piles large enough for several bands, with the feature `rayon`.
        for stacking in ["+-".repeat(45), "+-++-".repeat(15)] {
            let pile = Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
            compare(&pile, 30);
        }
    }

    /// Returns whether in every window each stored part contains an image of every site, and every sphere from which
    /// the next part receives forces. The corners are raised by `higher`.
    fn parts_suffice(pile: &Pile, higher: i128) -> bool {
        let shape = pile.shape();
        let mut grid = Grid::of_thirds(shape, shape.layers() - 1, 1).unwrap();
        let mut k = 0;
        let part = |grid: &Grid<'_>, k| {
            let mut grid = grid.clone();
            if 3 < k && k < grid.last {
                grid.corner = grid.corner.map(|corner| corner.map(|c| c + higher));
            }
            grid.stored(k).unwrap()
        };
        loop {
            let kept = part(&grid, k);
            let layer = shape.layer(k).unwrap();
            let has = |[i, j]: [i128; 2]| kept.part.contains(i, j);
            let sites = layer.rows(k).flatten();
            let mut sites = sites.map(|site| kept.images([site.i, site.j]));
            if !sites.all(|mut images| images.any(has)) {
                return false;
            }
            if k == grid.end {
                return true;
            }
            if k == grid.last {
                grid = grid.next_window().unwrap().0;
                continue;
            }
            for site in part(&grid, k + 1).part.rows(k + 1).flatten() {
                let lines = Direction::ALL.map(|direction| shape.above(site, direction));
                if !lines
                    .into_iter()
                    .flatten()
                    .all(|above| has([above.i, above.j]))
                {
                    return false;
                }
            }
            k += 1;
        }
    }

    #[test]
    fn stored_parts_suffice_and_narrower_ones_do_not() {
        let mut narrower = 0;
        for pile in piles() {
            assert!(parts_suffice(&pile, 0), "{}", pile.shape().stacking());
            narrower += usize::from(!parts_suffice(&pile, 1));
        }
        assert_eq!(narrower, piles().len());
    }

    #[test]
    fn a_pile_without_symmetry_is_swept_whole() {
        let pile = |top| Pile::under(top, "+-+".parse().unwrap()).unwrap();
        let hexagon = Region::hexagon(3, 2).unwrap();
        let top = *pile(hexagon).shape().sites().next().as_ref().unwrap();
        let one = BigRational::from_integer(1.into());
        assert!(has_threefold_symmetry(&pile(hexagon).weightless()));
        for pile in [
            pile(hexagon).with_load(top, one).unwrap(),
            pile(Region::new(0..=2, 0..=2, 0..=4).unwrap()),
            pile(Region::new(0..=2, 0..=1, 0..=2).unwrap()),
            Pile::discs(4).unwrap(),
            Pile::isosceles(4, BigRational::new(1.into(), 3.into())).unwrap(),
        ] {
            assert!(!has_threefold_symmetry(&pile));
        }
    }
}
