//! Makes several deferred passes of a sweep together, row by row: loop tiling, as a wavefront over rows.
//!
//! A pass ([`grid`](super::grid)) changes every number of a layer, with little arithmetic for each. Several passes,
//! made one after the other, would move the whole layer through the caches each time. In a wavefront, each row of cells
//! is still in the cache when the next pass needs it.
//!
//! # Dependencies
//! A sphere of row j has its lines α and β in the cells of row j. Its line γ is in the cells of row j + o, where o is
//! the net number of + steps down to the last layer. Consider two consecutive passes, to layers with the offsets o and
//! o′. The second pass can process row j when the first one has processed the rows j and j + o′ − o. So the second pass
//! follows max(0, o′ − o) rows behind the first one.
//!
//! For three passes with o′ − o = 1 each time, the rows are processed in this order:
//!
//! ```text
//! time      0   1   2   3   4   5
//! pass 1    0   1   2   3   …
//! pass 2        0   1   2   3   …
//! pass 3            0   1   2   3
//! ```
//!
//! # Bands of rows
//! The rows are halved recursively into *bands*, at most one for each thread, and the bands are processed in parallel.
//! In either half, each pass omits the rows that depend on the other half. These are |o′ − o| more rows than in the
//! previous pass. For o′ − o = −1 the halves A and B are
//!
//! ```text
//! pass 1    A A A A A A B B B B B B
//! pass 2    A A A A A A . B B B B B
//! pass 3    A A A A A A . . B B B B
//! ```
//!
//! When both halves are complete, one thread processes the omitted rows (dots) around the border. This is a split
//! tiling: no row is computed twice, and the result does not depend on the number of bands.

use alloc::vec::Vec;
use core::ops::{Add, Range};

use num_traits::ToPrimitive;

use super::grid::{Grid, Pass};
use super::parallel;
use super::plane::{Plane, Ramps, row};
use crate::each::Each;
use crate::lattice::{Along, Nearby, Sign, Slopes, small};
use crate::{Error, formula};

/// The smallest number of updates that justifies a thread.
const WORTH_A_THREAD: usize = 1 << 13;

/// The number of rows of each pass that are processed in one plane before the next plane: few enough for the cache, and
/// enough for long consecutive reads.
const BLOCK: usize = 16;

/// Consecutive passes, each with the values that it adds in every plane.
pub(super) type Passes<V> = [(Pass, Vec<Ramps<V>>)];

/// Makes consecutive passes in all planes. Each pass adds its increments, and applies `turn` where it ends at a sign
/// change.
///
/// The planes are independent, except that `begin` is called before the first pass processes a row of a plane. It
/// receives the planes up to this one, and the cells of the row. The planes above are processed before.
///
/// # Errors
/// [`Error::Bug`] if a line has no cell.
pub(super) fn make<V>(
    planes: &mut [Plane<V>],
    grid: &Grid<'_>,
    passes: &Passes<V>,
    begin: impl Fn(&mut [[&mut [V]; 3]], &[Range<usize>; 3]) + Send + Sync,
    turn: impl Fn(&[V; 3]) -> [V; 3] + Send + Sync,
) -> Result<(), Error>
where
    V: Clone + Send + Sync + for<'a> Add<&'a V, Output = V>,
{
    let number = bands_worth(passes, planes.len());
    make_whole(number, planes, grid, passes, (begin, turn))
}

/// Makes the passes over whole layers, in at most `number` bands.
///
/// # Errors
/// As for [`make`].
fn make_whole<V>(
    number: i128,
    planes: &mut [Plane<V>],
    grid: &Grid<'_>,
    passes: &Passes<V>,
    (begin, turn): (
        impl Fn(&mut [[&mut [V]; 3]], &[Range<usize>; 3]) + Send + Sync,
        impl Fn(&[V; 3]) -> [V; 3] + Send + Sync,
    ),
) -> Result<(), Error>
where
    V: Clone + Send + Sync + for<'a> Add<&'a V, Output = V>,
{
    let whole = Band {
        rows: passes.iter().map(|(pass, _)| pass.rows()).collect(),
        starts: [0; 3],
        planes: planes.iter_mut().map(Plane::slices_mut).collect(),
    };
    whole.make_in_bands(number, grid, passes, (&begin, &turn))
}

/// Returns the number of bands for these passes: 1 where more threads would cost more than they save.
fn bands_worth<V>(passes: &Passes<V>, planes: usize) -> i128 {
    let sites = |(Pass { stored, .. }, _): &(Pass, _)| {
        // This count decides only whether threads are used.
        stored.part.site_count().to_usize().unwrap_or(usize::MAX)
    };
    let numbers = passes.iter().map(sites).fold(0, usize::saturating_add);
    let worth = numbers.saturating_mul(3 * planes) / WORTH_A_THREAD;
    // The order matters: a call of `threads` may start the thread pool, so the amount of work is compared first.
    if worth < 2 || parallel::threads() < 2 {
        return 1;
    }
    let Some((first, _)) = passes.first() else {
        return 1;
    };
    // Around a border, each pass omits |o′ − o| more rows than the previous one.
    let shifts = || passes.iter().map(|(pass, _)| pass.stored.shift);
    let steps = shifts().zip(shifts().skip(1)).map(|(o, next)| next - o);
    let lost: i128 = steps.map(i128::abs).sum();
    let rows = first.rows();
    let most = (rows.end - rows.start) / (2 * lost + 2);
    // More bands than threads would only add borders, and one thread alone processes the rows around a border.
    (worth.min(parallel::threads()) as i128).min(most).max(1)
}

/// The rows to process, one range for each pass.
type RowsByPass = Vec<Range<i128>>;

/// A band of rows with the cells of their lines in every plane, and the rows that each pass processes.
struct Band<'c, V> {
    rows: RowsByPass,
    /// The index of the first cell of each slice, by direction.
    starts: [usize; 3],
    planes: Vec<[&'c mut [V]; 3]>,
}

impl<V> Band<'_, V> {
    /// Returns the border after the first half of the bands: the row of the first pass at which the second half begins,
    /// and the row of its γ cells. The border is never the first row.
    fn border(&self, number: i128, passes: &Passes<V>) -> Option<[i128; 2]> {
        let ((pass, _), rows) = (passes.first()?, self.rows.first()?.clone());
        let sites = |j| {
            let row = pass.stored.part.row(j);
            row.end - row.start
        };
        let (border, _) = parallel::cut(rows, number, sites)?;
        Some([border, border + pass.stored.shift])
    }

    /// Splits the band before a row of the first pass. In either part, each pass processes the rows that depend on that
    /// part alone. Also returns, for each pass, the remaining rows around the border.
    ///
    /// # Errors
    /// [`Error::Bug`] for a row that has no cells.
    fn split_before(
        &mut self,
        [border, gamma]: [i128; 2],
        grid: &Grid<'_>,
        passes: &Passes<V>,
    ) -> Result<([Band<'_, V>; 2], RowsByPass), Error> {
        let shifts = || passes.iter().map(|(pass, _)| pass.stored.shift);
        // Row j depends on the rows j and j + step of the previous pass.
        let steps = shifts().zip(shifts().skip(1)).map(|(o, next)| next - o);
        let around = steps.scan(border..border, |around, step| {
            around.start = around.start.min(around.start - step);
            around.end = around.end.max(around.end - step);
            Some(around.clone())
        });
        let around: Vec<_> = core::iter::once(border..border).chain(around).collect();
        let by_pass = |of: fn(&Range<i128>, &Range<i128>) -> Range<i128>| {
            let rows = self.rows.iter().zip(&around);
            rows.map(|(rows, around)| of(rows, around)).collect()
        };
        let before = by_pass(|rows, around| rows.start..rows.end.min(around.start));
        let behind = by_pass(|rows, around| rows.start.max(around.end)..rows.end);
        let omitted =
            by_pass(|rows, around| rows.start.max(around.start)..rows.end.min(around.end));
        // The cells of α and β are cut at the row `border`, and those of γ at the row `gamma`.
        let own = grid.row_start(border)?;
        let starts = [own, own, grid.row_start(gamma)?];
        let mut parts = [(before, self.starts), (behind, starts)].each(|(rows, starts)| Band {
            rows,
            starts,
            planes: Vec::with_capacity(self.planes.len()),
        });
        let lengths = [0, 1, 2].each(|line| starts[line] - self.starts[line]);
        for [a, b, c] in &mut self.planes {
            let (a, a_behind) = a.split_at_mut(lengths[0]);
            let (b, b_behind) = b.split_at_mut(lengths[1]);
            let (c, c_behind) = c.split_at_mut(lengths[2]);
            parts[0].planes.push([a, b, c]);
            parts[1].planes.push([a_behind, b_behind, c_behind]);
        }
        Ok((parts, omitted))
    }
}

impl<V: Clone + Send + Sync + for<'a> Add<&'a V, Output = V>> Band<'_, V> {
    /// Makes all passes over their rows, in at most `number` bands, in parallel if there are threads. Then processes
    /// the rows omitted around the borders.
    ///
    /// # Errors
    /// As for [`make`](Self::make).
    fn make_in_bands(
        mut self,
        number: i128,
        grid: &Grid<'_>,
        passes: &Passes<V>,
        (begin, turn): (
            &(impl Fn(&mut [[&mut [V]; 3]], &[Range<usize>; 3]) + Send + Sync),
            &(impl Fn(&[V; 3]) -> [V; 3] + Send + Sync),
        ),
    ) -> Result<(), Error> {
        let several = number > 1;
        if let Some(border) = several.then(|| self.border(number, passes)).flatten() {
            let ([before, behind], omitted) = self.split_before(border, grid, passes)?;
            let half = number / 2;
            parallel::share(
                || before.make_in_bands(half, grid, passes, (begin, turn)),
                || behind.make_in_bands(number - half, grid, passes, (begin, turn)),
            )?;
            self.rows = omitted;
        }
        self.make(grid, passes, begin, turn)
    }
}

/// One row of a pass.
struct Step {
    /// The position of the pass among the passes.
    place: usize,
    /// The cells of the lines of the row, by direction.
    cells: [Range<usize>; 3],
    /// For each of these lines, the number of spheres of the pass.
    counts: [Slopes; 3],
}

/// The geometry of a pass, in machine integers relative to the origin of the grid.
struct NearbyPass {
    /// The times at which the rows are processed. Row j is processed at the time j + `delay`.
    times: Range<i64>,
    delay: i64,
    region: Nearby,
    /// The stored spheres of the region.
    part: Nearby,
    shift: i64,
    sign: Sign,
    steps: i64,
}

impl NearbyPass {
    /// # Errors
    /// [`Error::Bug`] for a pass that does not fit in memory.
    fn new(pass: &Pass, delay: i128, rows: &Range<i128>, grid: &Grid<'_>) -> Result<Self, Error> {
        let time = |row| small(row - grid.origin[1] + delay);
        Ok(Self {
            times: time(rows.start)?..time(rows.end)?,
            delay: small(delay)?,
            region: pass.region.relative_to(grid.origin)?,
            part: pass.stored.part.relative_to(grid.origin)?,
            shift: small(pass.stored.shift)?,
            sign: pass.run.sign,
            steps: small(pass.k - pass.from)?,
        })
    }

    /// Returns the cells of the row that is processed at a time.
    ///
    /// # Errors
    /// [`Error::Bug`] if a line has no cell.
    #[inline]
    fn cells(&self, time: i64, grid: &Grid<'_>) -> Result<[Range<usize>; 3], Error> {
        let j = time - self.delay;
        grid.nearby_row(j, &self.part.row(j), self.shift)
    }

    /// Returns the counts of the row that is processed at a time, for its `n` positions.
    #[inline]
    fn counts(&self, time: i64, n: usize) -> [Slopes; 3] {
        let j = time - self.delay;
        let start = [self.part.row(j).start, j];
        self.region.counts_in_row(start, n, (self.sign, self.steps))
    }
}

impl<V: Clone + for<'a> Add<&'a V, Output = V>> Band<'_, V> {
    /// Makes all passes over their rows. Each pass follows as many rows behind the previous one as its dependencies
    /// require.
    ///
    /// # Errors
    /// [`Error::Bug`] if a line has no cell.
    fn make(
        mut self,
        grid: &Grid<'_>,
        passes: &Passes<V>,
        begin: &impl Fn(&mut [[&mut [V]; 3]], &[Range<usize>; 3]),
        turn: &impl Fn(&[V; 3]) -> [V; 3],
    ) -> Result<(), Error> {
        let mut delay = 0;
        let mut delays = Vec::with_capacity(passes.len());
        for (place, (pass, _)) in passes.iter().enumerate() {
            let before = place.checked_sub(1).and_then(|before| passes.get(before));
            // The first pass depends on no other.
            delay += match before {
                Some((before, _)) => (pass.stored.shift - before.stored.shift).max(0),
                None => 0,
            };
            delays.push(delay);
        }
        let nearby = passes.iter().zip(&delays).zip(&self.rows);
        let nearby =
            nearby.map(|(((pass, _), delay), rows)| NearbyPass::new(pass, *delay, rows, grid));
        let nearby = nearby.collect::<Result<Vec<NearbyPass>, _>>()?;
        let filled = || nearby.iter().filter(|pass| !pass.times.is_empty());
        let start = filled().map(|pass| pass.times.start).min();
        let end = filled().map(|pass| pass.times.end).max();
        let (Some(start), Some(end)) = (start, end) else {
            return Ok(());
        };
        let block = BLOCK * passes.len();
        let mut steps = Vec::with_capacity(block);
        for time in start..end {
            for (place, pass) in nearby.iter().enumerate() {
                if pass.times.contains(&time) {
                    let mut cells = pass.cells(time, grid)?;
                    for (cells, start) in cells.iter_mut().zip(self.starts) {
                        *cells = cells.start - start..cells.end - start;
                    }
                    let n = cells[0].len();
                    steps.push(Step {
                        place,
                        cells,
                        counts: pass.counts(time, n),
                    });
                    if steps.len() == block {
                        self.make_steps(&steps, passes, begin, turn)?;
                        steps.clear();
                    }
                }
            }
        }
        self.make_steps(&steps, passes, begin, turn)
    }

    /// Makes consecutive steps in every plane, from the top plane down.
    ///
    /// # Errors
    /// [`Error::Bug`] for a count without a value.
    fn make_steps(
        &mut self,
        steps: &[Step],
        passes: &Passes<V>,
        begin: &impl Fn(&mut [[&mut [V]; 3]], &[Range<usize>; 3]),
        turn: &impl Fn(&[V; 3]) -> [V; 3],
    ) -> Result<(), Error> {
        for p in (0..self.planes.len()).rev() {
            for step in steps {
                let (pass, ramps) = &passes[step.place];
                if step.place == 0 {
                    begin(&mut self.planes[..=p], &step.cells);
                }
                let (Ramps([a, b, c]), [alpha, beta, gamma]) = (&ramps[p], &step.counts);
                let along = [alpha.along(a)?, beta.along(b)?, gamma.along(c)?];
                let rows = row(&mut self.planes[p], step.cells.clone());
                if pass.turns {
                    add_and_turn(rows, &along, turn);
                } else {
                    for (row, along) in rows.into_iter().zip(&along) {
                        add(row, along);
                    }
                }
            }
        }
        Ok(())
    }
}

/// Adds the increments of three rows, and turns the forces at a sign change.
fn add_and_turn<V: Clone + for<'a> Add<&'a V, Output = V>>(
    [alpha, beta, gamma]: [&mut [V]; 3],
    along @ [a, b, c]: &[Along<'_, V>; 3],
    turn: &impl Fn(&[V; 3]) -> [V; 3],
) {
    /// For at most this number of positions outside the level part, one loop over them is faster than one loop for each
    /// part of the rows.
    const FEW: usize = 16;
    let n = alpha.len();
    let up = a.up.len().max(b.up.len()).max(c.up.len());
    let down = a.down.len().max(b.down.len()).max(c.down.len());
    let (Some(level_a), Some(level_b), Some(level_c), true) =
        (a.level, b.level, c.level, up + down <= FEW)
    else {
        return add_then_turn([alpha, beta, gamma], along, turn);
    };
    let sum = |x: &V, w| formula::transmitted(x.clone(), w);
    // Where all three counts are level, the same three values are added everywhere.
    let level = up..(n - down).max(up);
    turn_disjoint(
        &mut alpha[level.clone()],
        &mut beta[level.clone()],
        &mut gamma[level.clone()],
        &|[x, y, z]: &[V; 3]| turn(&[sum(x, level_a), sum(y, level_b), sum(z, level_c)]),
    );
    for place in (0..level.start).chain(level.end..n) {
        let after = n - 1 - place;
        let (x, y, z) = (&mut alpha[place], &mut beta[place], &mut gamma[place]);
        [*x, *y, *z] = turn(&[
            sum(x, a.at(place, after, level_a)),
            sum(y, b.at(place, after, level_b)),
            sum(z, c.at(place, after, level_c)),
        ]);
    }
}

// Not inlined, to keep the common path small.
#[inline(never)]
fn add_then_turn<V: Clone + for<'a> Add<&'a V, Output = V>>(
    mut rows: [&mut [V]; 3],
    along: &[Along<'_, V>; 3],
    turn: &impl Fn(&[V; 3]) -> [V; 3],
) {
    for (row, along) in rows.iter_mut().zip(along) {
        add(row, along);
    }
    let [alpha, beta, gamma] = rows;
    turn_disjoint(alpha, beta, gamma, turn);
}

/// Applies `turn` to three disjoint rows. As function parameters, the slices are known not to overlap.
#[inline(never)]
fn turn_disjoint<V: Clone>(
    a: &mut [V],
    b: &mut [V],
    c: &mut [V],
    turn: &impl Fn(&[V; 3]) -> [V; 3],
) {
    let n = a.len().min(b.len()).min(c.len());
    let (a, b, c) = (&mut a[..n], &mut b[..n], &mut c[..n]);
    for place in 0..n {
        let turned = turn(&[a[place].clone(), b[place].clone(), c[place].clone()]);
        [a[place], b[place], c[place]] = turned;
    }
}

/// Adds the increments of a row.
fn add<V: Clone + for<'a> Add<&'a V, Output = V>>(row: &mut [V], along: &Along<'_, V>) {
    let Along { up, level, down } = *along;
    let (rising, rest) = row.split_at_mut(up.len());
    let (same, falling) = rest.split_at_mut(rest.len() - down.len());
    add_each(rising, up.iter());
    if let Some(value) = level {
        add_same(same, value);
    }
    add_each(falling, down.iter().rev());
}

fn add_each<'v, V: Clone + 'v + for<'a> Add<&'a V, Output = V>>(
    row: &mut [V],
    values: impl Iterator<Item = &'v V>,
) {
    for (sum, value) in row.iter_mut().zip(values) {
        *sum = formula::transmitted(sum.clone(), value);
    }
}

fn add_same<V: Clone + for<'a> Add<&'a V, Output = V>>(row: &mut [V], value: &V) {
    for sum in row {
        *sum = formula::transmitted(sum.clone(), value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Region;
    use crate::shape::Shape;

    /// Returns the passes down to the last layer, without increments.
    fn passes_of(shape: &Shape, grid: &Grid<'_>) -> Vec<(Pass, Vec<Ramps<i64>>)> {
        let last = shape.layers() - 1;
        let (mut passes, mut k) = (Vec::new(), 0);
        while let Some(pass) = grid.pass(k, last).unwrap() {
            passes.push((pass, Vec::new()));
            k = pass.k;
        }
        passes
    }

    /// Makes all passes of a pile in groups of `at_a_time`, in two planes and in at most `number` bands. Each group first
    /// moves `carried` times the lower number to the upper plane. The numbers stay small, and `turn` is asymmetric.
    fn swept(shape: &Shape, at_a_time: usize, number: i128, carried: i64) -> [[Vec<i64>; 3]; 2] {
        const SMALL: i64 = 10_007;
        let last = shape.layers() - 1;
        let grid = Grid::new(shape, last, 1).unwrap();
        let mut planes = [Plane::new(&grid, &0), Plane::new(&grid, &0)];
        let mut passes = passes_of(shape, &grid);
        for (pass, ramps) in &mut passes {
            let times = |w: &i64, n: i128| w * i64::try_from(n).unwrap();
            let increments = [[1, 2, 5], [3, 1, 4]];
            ramps.extend(increments.map(|increments| Ramps::new(pass, &increments, times)));
        }
        let turn = |[a, b, c]: &[i64; 3]| {
            [2 * b + 3 * c - a, a + 7 * b - c, 5 * a - b + c].map(|x| x.rem_euclid(SMALL))
        };
        let begin = |up_to: &mut [[&mut [i64]; 3]], cells: &[Range<usize>; 3]| {
            if let [lower, upper] = up_to {
                let lower = row(lower, cells.clone()).into_iter().flatten();
                for (lower, upper) in lower.zip(row(upper, cells.clone()).into_iter().flatten()) {
                    *upper = (*upper + carried * *lower) % SMALL;
                    *lower -= carried * *lower;
                }
            }
        };
        for passes in passes.chunks(at_a_time) {
            make_whole(number, &mut planes, &grid, passes, (begin, turn)).unwrap();
        }
        planes.map(|Plane(lines)| lines)
    }

    #[test]
    fn bands_give_the_same_numbers_as_whole_layers() {
        let alternating = "+-".repeat(9);
        let mut compared = 0;
        for stacking in [
            alternating.as_str(),
            "-++-+---+-+-++",
            "+++--+-----+",
            "-+-+",
        ] {
            for top in [
                Region::hexagon(25, 18),
                Region::triangle(30),
                Region::hexagon(2, 1),
            ] {
                let shape = Shape::under(top.unwrap(), stacking.parse().unwrap()).unwrap();
                for at_a_time in [1, 2, 5, 8] {
                    let plain = swept(&shape, 1, 1, 0);
                    assert_eq!(
                        swept(&shape, at_a_time, 1, 0),
                        plain,
                        "{stacking} {at_a_time}"
                    );
                    let whole = swept(&shape, at_a_time, 1, 1);
                    for number in [2, 3, 7] {
                        let bands = swept(&shape, at_a_time, number, 1);
                        assert_eq!(bands, whole, "{stacking} {at_a_time} {number}");
                        compared += 1;
                    }
                }
            }
        }
        assert_eq!(compared, 144);
    }

    /// Cuts small layers into 2 to 9 bands, each of few rows.
    #[test]
    fn bands_of_low_layers_give_the_same_numbers() {
        for (side, stacking) in [(12, "+-+-+-+-"), (20, "-++-+--+"), (31, "+++---+-")] {
            let top = Region::triangle(side).unwrap();
            let shape = Shape::under(top, stacking.parse().unwrap()).unwrap();
            let whole = swept(&shape, 8, 1, 1);
            for number in 2..=9 {
                let bands = swept(&shape, 8, number, 1);
                assert_eq!(bands, whole, "{stacking} {number}");
            }
        }
    }

    /// Checks that a column of many rows is cut no more often than there are bands, since each cut waits for both
    /// halves.
    #[test]
    fn rows_are_not_cut_for_less_than_a_band() {
        let column = Region::new(0..=0, 0..=99_999, 0..=99_999).unwrap();
        let shape = Shape::under(column, "+-".parse().unwrap()).unwrap();
        let whole = swept(&shape, 2, 1, 1);
        let bands = swept(&shape, 2, 2, 1);
        assert_eq!(bands, whole);
    }

    const TOPS: [&str; 4] = ["triangle:30", "hexagon:25,18", "hexagon:2,1", "triangle:1"];

    fn shape(top: &str, stacking: &str) -> Shape {
        let (top, stacking) = (top.parse().unwrap(), stacking.parse().unwrap());
        Shape::under(top, stacking).unwrap()
    }

    /// The rows before a border hold at least their share of the spheres. Without the last of these rows they hold
    /// less.
    #[test]
    fn a_border_is_where_the_first_bands_have_their_share() {
        let mut borders = 0;
        for top in TOPS {
            let shape = shape(top, "-+-+++-");
            let grid = Grid::new(&shape, shape.layers() - 1, 1).unwrap();
            let passes = passes_of(&shape, &grid);
            let (pass, _) = &passes[0];
            let rows = pass.rows();
            let before = |border| {
                let sites = (rows.start..border).map(|j| pass.stored.part.row(j).count());
                i128::try_from(sites.sum::<usize>()).unwrap()
            };
            for number in 2..8 {
                let band = Band::<i64> {
                    rows: alloc::vec![rows.clone()],
                    starts: [0; 3],
                    planes: Vec::new(),
                };
                let share = before(rows.end) * (number / 2);
                let Some([border, gamma]) = band.border(number, &passes) else {
                    assert!(before(rows.end - 1) * number < share, "{top} {number}");
                    continue;
                };
                assert!(
                    (rows.start + 1..rows.end).contains(&border),
                    "{top} {number}"
                );
                assert!(before(border) * number >= share, "{top} {number}");
                let is_first = border == rows.start + 1;
                assert!(
                    is_first || before(border - 1) * number < share,
                    "{top} {number}"
                );
                assert_eq!(gamma, border + pass.stored.shift);
                borders += 1;
            }
        }
        assert!(borders > 15, "{borders}");
    }

    /// Three limits apply: the threads, the work for each thread, and the rows to omit on both sides of a border.
    /// Checks that the number of bands is the largest one within them.
    #[cfg(feature = "rayon")]
    #[test]
    fn bands_are_as_many_as_the_limits_allow() {
        let mut limited = [0; 3];
        for (top, stacking) in [
            ("triangle:30", "+-+-+-+-"),
            ("triangle:90", "+-+-+-+-"),
            ("hexagon:90,90", "++--++--"),
            ("hexagon:400,9", "+++---+++---"),
            ("triangle:300", "+"),
            ("triangle:1", "+-+-"),
        ] {
            let shape = shape(top, stacking);
            let grid = Grid::new(&shape, shape.layers() - 1, 1).unwrap();
            let passes = passes_of(&shape, &grid);
            let sites = |(pass, _): &(Pass, _)| {
                pass.rows()
                    .map(|j| pass.stored.part.row(j).count())
                    .sum::<usize>()
            };
            let sites: usize = passes.iter().map(sites).sum();
            let lost = passes
                .windows(2)
                .map(|two| (two[1].0.stored.shift - two[0].0.stored.shift).abs())
                .sum::<i128>();
            let rows = i128::try_from(passes[0].0.rows().count()).unwrap();
            for planes in [1, 4] {
                for threads in [1, 2, 5] {
                    let pool = rayon::ThreadPoolBuilder::new()
                        .num_threads(threads)
                        .build()
                        .unwrap();
                    let number = pool.install(|| bands_worth(&passes, planes));
                    let fits = |number: i128| {
                        let bands = usize::try_from(number).unwrap();
                        [
                            bands <= threads,
                            bands * WORTH_A_THREAD <= 3 * planes * sites,
                            number * (2 * lost + 2) <= rows,
                        ]
                    };
                    assert!(number == 1 || fits(number) == [true; 3], "{top} {threads}");
                    let more = fits(number + 1);
                    assert!(more.contains(&false), "{top} {threads}: {number}");
                    for (limited, fits) in limited.iter_mut().zip(more) {
                        *limited += usize::from(!fits);
                    }
                }
            }
        }
        assert!(limited.iter().all(|limited| *limited > 3), "{limited:?}");
    }
}
