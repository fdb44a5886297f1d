//! Counts of spheres on the lines above a site, within a run.

use core::cmp::Ordering;
use core::ops::Range;

use super::Region;
use crate::Error;
use crate::error::bug;
use crate::lattice::{Sign, count};

impl Region {
    /// Returns the number of spheres above (i, j) on each of its lines, within the `steps` layers above it that are
    /// stacked with one sign.
    ///
    /// Each number is the minimum of [`count::bounds_above`]. All are zero if the site is outside the region or `steps`
    /// < 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Region, Sign};
    ///
    /// // Layer 5 of the paper's pile: (k−i−j, i, j).
    /// let layer = Region::triangle(6)?;
    /// assert_eq!(layer.spheres_above(1, 2, Sign::Plus, 5), [2, 1, 2]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    #[inline]
    pub fn spheres_above(&self, i: i128, j: i128, sign: Sign, steps: i128) -> [i128; 3] {
        if steps < 1 || !self.contains(i, j) {
            return [0; 3];
        }
        let [a, b, c] = count::bounds_above(&i, &j, &self.lower, &self.upper, &steps, sign);
        let least = |[m, a, b, c]: [i128; 4]| m.min(a).min(b).min(c);
        [least(a), least(b), least(c)]
    }

    /// Returns [`spheres_above`](Self::spheres_above) as a function of the position along row `j`, from the site (i, j)
    /// on, within the region.
    pub(crate) fn row_counts(&self, [i, j]: [i128; 2], sign: Sign, steps: i128) -> [Trapezoid; 3] {
        let bounds = count::bounds_above(&i, &j, &self.lower, &self.upper, &steps, sign);
        Trapezoid::from_bounds(bounds, sign)
    }

    /// Returns a region that fits in memory, with coordinates relative to `origin`.
    ///
    /// # Errors
    /// [`Error::Bug`] if the region is too large, or too far from the origin.
    pub(crate) fn relative_to(&self, [x, y]: [i128; 2]) -> Result<Nearby, Error> {
        let relative = |[i, j, s]: [i128; 3]| -> Result<_, Error> {
            Ok([small(i - x)?, small(j - y)?, small(s - x - y)?])
        };
        Ok(Nearby {
            lower: relative(self.lower)?,
            upper: relative(self.upper)?,
        })
    }
}

/// Returns `n` as an `i64` if |n| ≤ [`LONG`].
///
/// # Errors
/// [`Error::Bug`] for another number.
pub(crate) fn small(n: i128) -> Result<i64, Error> {
    let small = i64::try_from(n).ok();
    let small = small.filter(|n| (-LONG..=LONG).contains(n));
    small.ok_or_else(|| bug("a layer that is swept fits in memory"))
}

/// A region that fits in memory, in machine integers relative to a nearby site.
pub(crate) struct Nearby {
    lower: [i64; 3],
    upper: [i64; 3],
}

impl Nearby {
    /// Returns the range of i in row `j` of the region.
    #[inline]
    pub(crate) fn row(&self, j: i64) -> Range<i64> {
        let ([x0, _, s0], [x1, _, s1]) = (self.lower, self.upper);
        x0.max(s0 - j)..x1.min(s1 - j) + 1
    }

    /// Returns [`spheres_above`](Region::spheres_above) along the row from the site (i, j) on, for `n` positions within
    /// the region. The site and `steps` must be within [`LONG`].
    #[inline]
    pub(crate) fn counts_in_row(
        &self,
        [i, j]: [i64; 2],
        n: usize,
        (sign, steps): (Sign, i64),
    ) -> [Slopes; 3] {
        let Self { lower, upper } = self;
        let bounds = count::bounds_above(&i, &j, lower, upper, &steps, sign);
        let [a, b, c] = Trapezoid::from_bounds(bounds, sign);
        [Slopes::new(a, n), Slopes::new(b, n), Slopes::new(c, n)]
    }
}

/// A count along a row, min(cap, rises + p, falls − p), where p is the position relative to a starting site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Trapezoid<N = i128> {
    pub(crate) cap: N,
    pub(crate) rises: Option<N>,
    pub(crate) falls: Option<N>,
}

impl<N: Copy + Ord> Trapezoid<N> {
    /// Returns the counts along a row from their [bounds](count::bounds_above) at its first position.
    #[inline]
    fn from_bounds(bounds: [[N; 4]; 3], sign: Sign) -> [Self; 3] {
        // With a constant sign, the compiler determines which bounds rise and which fall.
        match sign {
            Sign::Plus => Self::from_bounds_under::<true>(bounds),
            Sign::Minus => Self::from_bounds_under::<false>(bounds),
        }
    }

    #[inline]
    fn from_bounds_under<const IS_PLUS: bool>([a, b, c]: [[N; 4]; 3]) -> [Self; 3] {
        let sign = if IS_PLUS { Sign::Plus } else { Sign::Minus };
        // Bounds are linear in i. So the bounds at i = 1 without constants are the differences along the row.
        let [along_a, along_b, along_c] =
            count::bounds_above(&1_i64, &0, &[0; 3], &[0; 3], &0, sign);
        let count = |[cap, x, y, z]: [N; 4], [_, along_x, along_y, along_z]: [i64; 4]| {
            let level = Self {
                cap,
                rises: None,
                falls: None,
            };
            let count = level.bounded_by(x, along_x).bounded_by(y, along_y);
            count.bounded_by(z, along_z)
        };
        [count(a, along_a), count(b, along_b), count(c, along_c)]
    }

    /// Adds a bound that rises by `difference` at each position: by 1, 0 or −1.
    #[inline]
    fn bounded_by(self, bound: N, difference: i64) -> Self {
        let least = |other: Option<N>| Some(other.into_iter().fold(bound, N::min));
        match difference.cmp(&0) {
            Ordering::Equal => Self {
                cap: self.cap.min(bound),
                ..self
            },
            Ordering::Greater => Self {
                rises: least(self.rises),
                ..self
            },
            Ordering::Less => Self {
                falls: least(self.falls),
                ..self
            },
        }
    }
}

impl Trapezoid {
    /// Returns the count with machine integers, for a row that fits in memory.
    pub(crate) fn near(self) -> Trapezoid<i64> {
        #[expect(clippy::cast_possible_truncation, reason = "|n| ≤ LONG")]
        // A bound that is farther away than the length of any row takes effect on the same side of the
        // row after clamping.
        let near = |n: i128| n.clamp(-i128::from(LONG), LONG.into()) as i64;
        Trapezoid {
            cap: near(self.cap),
            rises: self.rises.map(near),
            falls: self.falls.map(near),
        }
    }

    #[cfg(test)]
    fn at(&self, p: i128) -> i128 {
        let rise = self.rises.map_or(self.cap, |rises| rises + p);
        let fall = self.falls.map_or(self.cap, |falls| falls - p);
        self.cap.min(rise).min(fall)
    }
}

/// A length that exceeds the length of every row in memory.
const LONG: i64 = FAR / 16;

/// The value of a bound that does not exist. It exceeds sums of a few numbers of magnitude up to [`LONG`].
const FAR: i64 = i64::MAX / 4;

/// A count along a row. It rises by one per position, then is constant, then falls by one per position.
pub(crate) struct Slopes {
    /// The counts on the rising part.
    up: Range<usize>,
    /// The constant count between the slopes, as a range of length one. It is empty if the constant part is empty.
    level: Range<usize>,
    /// The counts on the falling part, from the last position to the first.
    down: Range<usize>,
}

/// The values that belong to the counts along a row.
pub(crate) struct Along<'v, V> {
    /// The values on the rising part.
    pub(crate) up: &'v [V],
    /// The value between the slopes, or `None` if the constant part is empty.
    pub(crate) level: Option<&'v V>,
    /// The values on the falling part, from the last position to the first.
    pub(crate) down: &'v [V],
}

impl Slopes {
    /// Returns the slopes for a row of `n` positions. The row must fit in memory, and the bounds must be sums of a few
    /// numbers within [`LONG`].
    #[inline]
    pub(crate) fn new(Trapezoid { cap, rises, falls }: Trapezoid<i64>, n: usize) -> Self {
        // A missing bound is replaced by one that never takes effect.
        let (rises, falls) = (rises.unwrap_or(FAR), falls.unwrap_or(FAR));
        let inside =
            |position: i64| usize::try_from(position.max(0)).map_or(n, |position| position.min(n));
        // The count may begin to fall before it reaches the cap.
        let meet = (falls - rises).div_euclid(2) + 1;
        let rise = inside(meet.min(cap - rises));
        let fall = inside(falls - cap + 1).max(rise);
        let counts = |least: i64, positions: usize| {
            // `along` rejects a count below zero, since it has no value.
            let least = usize::try_from(least).unwrap_or(usize::MAX);
            if positions == 0 {
                0..0
            } else {
                least..least.saturating_add(positions)
            }
        };
        // Every row in memory is shorter.
        let last = falls + 1 - i64::try_from(n).unwrap_or(FAR);
        Self {
            up: counts(rises, rise),
            level: counts(cap, usize::from(rise < fall)),
            down: counts(last, n - fall),
        }
    }

    /// Returns `values[count]` for each position of the row.
    ///
    /// # Errors
    /// [`Error::Bug`] if `values` is too short for a count.
    #[inline]
    pub(crate) fn along<'v, V>(&self, values: &'v [V]) -> Result<Along<'v, V>, Error> {
        let of = |counts: &Range<usize>| values.get(counts.clone());
        match (of(&self.up), of(&self.level), of(&self.down)) {
            (Some(up), Some(level), Some(down)) => Ok(Along {
                up,
                level: level.first(),
                down,
            }),
            _ => Err(bug("every count along a row has its value")),
        }
    }
}

impl<'v, V> Along<'v, V> {
    /// Returns the value at a position that is followed by `after` more. `level` is the value between the slopes.
    #[inline]
    pub(crate) fn at(&self, position: usize, after: usize, level: &'v V) -> &'v V {
        let slope = self.up.get(position).or_else(|| self.down.get(after));
        slope.unwrap_or(level)
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;

    /// Returns the counts along a row, after comparing them with the counts position by position.
    fn counts_along(slopes: &Slopes, length: usize) -> Vec<i128> {
        let counts: Vec<i128> = (0..20).collect();
        let along = slopes.along(&counts).unwrap();
        let Along { up, level, down } = along;
        let between = level.unwrap_or(&-1);
        let same = length - up.len() - down.len();
        let level = level.map_or_else(Vec::new, |count| alloc::vec![*count; same]);
        let down: Vec<i128> = down.iter().rev().copied().collect();
        let met = [up, &level, &down].concat();
        let by_position =
            (0..length).map(|position| *along.at(position, length - 1 - position, between));
        assert_eq!(met, by_position.collect::<Vec<_>>());
        met
    }

    /// Counting by rows and counting by sites give the same result.
    #[test]
    fn rows_count_as_sites_do() {
        let shapes = [
            Region::triangle(5),
            Region::hexagon(3, 4),
            Region::new(-2..=3, 0..=2, -1..=4),
        ];
        let mut compared = 0;
        for region in shapes.map(|region| region.unwrap()) {
            for (sign, steps) in [Sign::Plus, Sign::Minus]
                .into_iter()
                .flat_map(|sign| (0..6).map(move |m| (sign, m)))
            {
                for row in region.rows(0) {
                    let start = [row.i.start, row.j];
                    let counts = region.row_counts(start, sign, steps);
                    let length = usize::try_from(row.i.end - row.i.start).unwrap();
                    let along = counts
                        .map(|count| counts_along(&Slopes::new(count.near(), length), length));
                    let nearby = region.relative_to([1, -2]).unwrap();
                    let [i, j] = [start[0] - 1, start[1] + 2].map(|n| small(n).unwrap());
                    assert_eq!((nearby.row(j).start, nearby.row(j).count()), (i, length));
                    let run = (sign, small(steps).unwrap());
                    let slopes = nearby.counts_in_row([i, j], length, run);
                    let in_memory = slopes.each_ref().map(|slopes| counts_along(slopes, length));
                    assert_eq!(in_memory, along);
                    for (p, i) in (0..).zip(row.i.clone()) {
                        let of_site = region.spheres_above(i, row.j, sign, steps);
                        let position = usize::try_from(p).unwrap();
                        assert_eq!(
                            counts.map(|count| count.at(p)),
                            of_site,
                            "{region} {i} {}",
                            row.j
                        );
                        assert_eq!(along.each_ref().map(|counts| counts[position]), of_site);
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 500);
    }
}
