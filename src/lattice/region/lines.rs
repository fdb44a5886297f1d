//! How many spheres lie on the lines above a site, within a run.

use core::cmp::Ordering;
use core::ops::{Range, Sub};

use super::Region;
use crate::lattice::{Sign, count};

impl Region {
    /// Returns how many of the `steps` layers above (i, j), stacked with one sign, have a sphere on each of its lines.
    ///
    /// The least of [`count::bounds_above`], each of which grows by one per step down and vanishes at its surface. None
    /// outside the region.
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
        if !self.contains(i, j) {
            return [0; 3];
        }
        let bounds = count::bounds_above(&i, &j, &self.lower, &self.upper, &steps, sign);
        bounds.map(|[m, a, b, c]| m.min(a).min(b).min(c))
    }

    /// Returns how [`spheres_above`](Self::spheres_above) goes on along row `j`, within the region.
    pub(crate) fn row_counts(&self, j: i128, sign: Sign, steps: i128) -> [Trapezoid; 3] {
        self.counts(sign, steps).in_row(j)
    }

    /// Returns how [`spheres_above`](Self::spheres_above) goes on along any row, within the region.
    pub(crate) fn counts(&self, sign: Sign, steps: i128) -> Counts {
        let constant = |at_zero| Linear {
            at_zero,
            along: [0, 0],
        };
        let [i, j] = [[1, 0], [0, 1]].map(|along| Linear { at_zero: 0, along });
        let (lower, upper) = (self.lower.map(constant), self.upper.map(constant));
        let bounds = count::bounds_above(&i, &j, &lower, &upper, &constant(steps), sign);
        Counts { steps, bounds }
    }
}

/// What bounds the counts on the lines above the sites of a region, by direction.
pub(crate) struct Counts {
    steps: i128,
    bounds: [[Linear; 4]; 3],
}

impl Counts {
    /// Returns how the counts go on along row `j`.
    #[inline]
    pub(crate) fn in_row(&self, j: i128) -> [Trapezoid; 3] {
        self.bounds.each_ref().map(|bounds| {
            let count = Trapezoid {
                cap: self.steps,
                rises: None,
                falls: None,
            };
            bounds
                .iter()
                .fold(count, |count, bound| count.bounded_by(bound, j))
        })
    }
}

/// A function of i and j that is linear in both: its value at (0, 0), and by how much it grows along i and j.
#[derive(Clone, Copy)]
struct Linear {
    at_zero: i128,
    along: [i8; 2],
}

impl Sub<&Self> for Linear {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        let [[i, j], [other_i, other_j]] = [self.along, rhs.along];
        Self {
            at_zero: self.at_zero - rhs.at_zero,
            along: [i - other_i, j - other_j],
        }
    }
}

/// min(cap, i − rises, falls − i): how a count runs along a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Trapezoid {
    pub(crate) cap: i128,
    pub(crate) rises: Option<i128>,
    pub(crate) falls: Option<i128>,
}

impl Trapezoid {
    /// The lesser of the count and a function that rises by one along the row, falls by one, or is level.
    #[inline]
    fn bounded_by(self, bound: &Linear, j: i128) -> Self {
        let [along_i, along_j] = bound.along;
        let at_zero = match along_j {
            0 => bound.at_zero,
            1 => bound.at_zero + j,
            slope => bound.at_zero + i128::from(slope) * j,
        };
        match along_i.cmp(&0) {
            Ordering::Equal => Self {
                cap: self.cap.min(at_zero),
                ..self
            },
            Ordering::Greater => Self {
                rises: Some(self.rises.map_or(-at_zero, |from| from.max(-at_zero))),
                ..self
            },
            Ordering::Less => Self {
                falls: Some(self.falls.map_or(at_zero, |until| until.min(at_zero))),
                ..self
            },
        }
    }

    #[cfg(test)]
    fn at(&self, i: i128) -> i128 {
        let rise = self.rises.map_or(self.cap, |from| i - from);
        let fall = self.falls.map_or(self.cap, |until| until - i);
        self.cap.min(rise).min(fall)
    }
}

/// A count along a row: it rises by one from place to place, then it is level, then it falls by one.
pub(crate) struct Slopes {
    cap: i64,
    /// Places along the row where the count would be zero.
    rises: i64,
    falls: i64,
    level: Range<usize>,
}

/// Values by count, along a piece of a row.
pub(crate) struct Along<'v, V> {
    /// Where the count rises.
    pub(crate) up: &'v [V],
    /// Between the slopes; none if there is nothing between them.
    pub(crate) level: Option<&'v V>,
    /// Where it falls: from the last of them to the first.
    pub(crate) down: &'v [V],
}

impl Slopes {
    /// Of a row of `n` places that begins at `start`; it fits in memory, and so do all counts.
    pub(crate) fn new(count: Trapezoid, start: i128, n: usize) -> Self {
        const FAR: i64 = i64::MAX / 4;
        #[expect(clippy::cast_possible_truncation, reason = "|i| ≤ FAR")]
        // Not a default: what is further off than any row is long is on the same side of the row from there.
        let near = |i: i128| i.clamp(-i128::from(FAR), FAR.into()) as i64;
        let cap = near(count.cap);
        let rises = count.rises.map_or(-FAR, |from| near(from - start));
        let falls = count.falls.map_or(FAR, |until| near(until - start));
        let inside = |place: i64| usize::try_from(place.max(0)).map_or(n, |place| place.min(n));
        // It may fall again before it has risen to the cap.
        let meet = (rises + falls).div_euclid(2) + 1;
        let rise = inside(meet.min(rises + cap));
        let fall = inside(falls - cap + 1).max(rise);
        Self {
            cap,
            rises,
            falls,
            level: rise..fall,
        }
    }

    /// `values[count]` along a piece of the row; as many as there are places, unless `values` is too short for a count.
    pub(crate) fn along<'v, V>(&self, piece: Range<usize>, values: &'v [V]) -> Along<'v, V> {
        // Not a default: the part of a slope that lies in the piece.
        let inside = |place: usize| place.clamp(piece.start, piece.end);
        let (rise, fall) = (inside(self.level.start), inside(self.level.end));
        // Counts from one place of the row to another, of which the first is the least.
        let counts = |least: Option<i64>, places: usize| -> &'v [V] {
            let first = least.and_then(|least| usize::try_from(least).ok());
            match first.and_then(|first| values.get(first..)) {
                Some(values) => values.get(..places).unwrap_or(values),
                // Too few values: the slices are then shorter than the piece, which is refused where they are written.
                None => &[],
            }
        };
        let place = |place: usize| i64::try_from(place).ok();
        let cap = usize::try_from(self.cap).ok();
        let first = place(piece.start).map(|start| start - self.rises);
        let last = place(piece.end).map(|end| self.falls - end + 1);
        Along {
            up: counts(first, rise - piece.start),
            level: cap.and_then(|cap| values.get(cap)).filter(|_| rise < fall),
            down: counts(last, piece.end - fall),
        }
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;

    /// The counts along a row, met in two pieces.
    fn met(slopes: &Slopes, length: usize) -> Vec<i128> {
        let counts: Vec<i128> = (0..20).collect();
        let middle = length / 3;
        let pieces = [0..middle, middle..length].map(|piece| {
            let places = piece.len();
            let Along { up, level, down } = slopes.along(piece, &counts);
            let same = places - up.len() - down.len();
            let level = level.map_or_else(Vec::new, |count| alloc::vec![*count; same]);
            let down: Vec<i128> = down.iter().rev().copied().collect();
            [up, &level, &down].concat()
        });
        pieces.concat()
    }

    /// A row at a time or a site at a time, it is the same count.
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
                    let counts = region.row_counts(row.j, sign, steps);
                    let length = usize::try_from(row.i.end - row.i.start).unwrap();
                    let along =
                        counts.map(|count| met(&Slopes::new(count, row.i.start, length), length));
                    for (place, i) in row.i.enumerate() {
                        let of_site = region.spheres_above(i, row.j, sign, steps);
                        assert_eq!(
                            counts.map(|count| count.at(i)),
                            of_site,
                            "{region} {i} {}",
                            row.j
                        );
                        assert_eq!(along.each_ref().map(|counts| counts[place]), of_site);
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 500);
    }
}
