//! The tabulated closed form: all contact forces of a straight pile, copied into slices.
//!
//! A straight pile has few distinct forces: along a line they are 1, 2, 3, … increments. The closed form would convert
//! and round a number for each contact. The table rounds each distinct force once. The rows of the pile are pieces of
//! the table.
//!
//! For example, take the three spheres of row j = 1 in layer k = 3 under one sphere. Their contact forces, in
//! increments, are
//!
//! ```text
//! i             0  1  2
//! α, k−i−j+1    3  2  1    the table backwards
//! β, i+1        1  2  3    the table forwards
//! γ, j+1        2  2  2    one entry
//! ```
//!
//! Under any other top, the force in each direction rises, is level, and falls along a row. A row needs no other row
//! and no memory of its own. So two halves of the layers are filled in parallel.

use alloc::vec::Vec;
use core::ops::Range;

use num_bigint::BigUint;
use num_traits::ToPrimitive;

use super::interrupt::check as check_interrupt;
use super::lines::LineForces;
use super::parallel;
use super::slices::split_front;
use crate::Error;
use crate::error::bug;
use crate::lattice::{Along, Dimension, Row, Sign, Slopes};
use crate::scalar::Algebra;
use crate::shape::Shape;

/// The distinct contact forces of a straight pile, by direction: the values of 1, 2, 3, … increments.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table<V> {
    /// By direction. Entry n is the value of n+1 increments.
    tables: [Vec<V>; 3],
    shape: Shape,
}

/// The maximum number of increments in a table. In a pile of so many layers under one sphere, the contact forces fill
/// 4·10¹⁸ bytes as `f64`.
const MOST: i128 = 1_000_000;

impl<V> Table<V> {
    /// Returns the table of the values of n ≤ `most` increments along a line.
    ///
    /// Returns `None` for piles with sign changes or loads, for weights other than mg, for discs, and for more than a
    /// million increments.
    ///
    /// # Errors
    /// Those of `value`.
    pub(crate) fn new<T: Algebra>(
        lines: &LineForces<'_, T>,
        most: i128,
        value: impl Fn(i128, usize) -> Result<V, Error>,
    ) -> Result<Option<Self>, Error> {
        let shape = lines.shape;
        let is_bare = lines.pile.has_unit_weights() && !lines.has_scalar_loads;
        let applies =
            is_bare && shape.stacking().is_straight() && shape.dimension() == Dimension::Three;
        if !applies || most > MOST {
            return Ok(None);
        }
        let table = |line: usize| {
            (1..=most)
                .map(|n| value(n, line))
                .collect::<Result<Vec<V>, Error>>()
        };
        Ok(Some(Self {
            tables: [table(0)?, table(1)?, table(2)?],
            shape: shape.clone(),
        }))
    }
}

/// The smallest number of spheres that justifies a thread.
const WORTH_A_THREAD: u32 = 1 << 15;

impl<V: Clone + Send + Sync> Table<V> {
    /// Writes the contact forces below the spheres of `layers` into slices with one entry for each sphere, layer after
    /// layer. The layers must be above the floor. Halves are written in parallel if there are threads.
    pub(crate) fn fill(&self, layers: Range<i128>, slices: [&mut [V]; 3]) -> Result<(), Error> {
        let Some((upper, lower)) = self.halves(&layers) else {
            let mut rest = slices;
            for k in layers {
                self.fill_layer(k, &mut rest)?;
            }
            return Ok(());
        };
        let spheres = self.shape.spheres_in(upper.clone()).to_usize();
        let mut rest = slices;
        let above = split_front(&mut rest, spheres.ok_or_else(too_short)?)?;
        parallel::share(|| self.fill(upper, above), || self.fill(lower, rest))
    }

    /// Splits some layers into two parts with similar numbers of spheres. Returns `None` if a second thread would not
    /// save time.
    fn halves(&self, layers: &Range<i128>) -> Option<(Range<i128>, Range<i128>)> {
        let spheres = self.shape.spheres_in(layers.clone());
        if !parallel::HAS_THREADS || spheres < BigUint::from(2 * WORTH_A_THREAD) {
            return None;
        }
        // Under one sphere, the number of spheres grows with the cube of the depth, so half of them lie in the upper
        // 0.8 of the height. Under a larger top this part is smaller.
        let mut inside = layers.start + 1..layers.end;
        let middle = inside.find(|k| self.shape.spheres_in(layers.start..*k) * 2_u32 >= spheres)?;
        Some((layers.start..middle, middle..layers.end))
    }

    /// Writes the forces below layer `k` into the front of the slices, and removes that part from them.
    fn fill_layer(&self, k: i128, rest: &mut [&mut [V]; 3]) -> Result<(), Error> {
        for row in self.shape.layer(k)?.rows(k) {
            check_interrupt()?;
            let spheres = usize::try_from(row.i.end - row.i.start).map_err(|_| too_short())?;
            let slices = split_front(rest, spheres)?;
            if self.shape.is_pyramid() {
                self.fill_row_of_pyramid(row.j, slices)?;
            } else {
                self.fill_row(&row, slices)?;
            }
        }
        Ok(())
    }

    /// Writes the forces below consecutive spheres of a row of any straight pile. For spheres on the floor, these are
    /// the forces that they would transmit to a further layer.
    pub(crate) fn fill_row(&self, row: &Row, slices: [&mut [V]; 3]) -> Result<(), Error> {
        let region = self.shape.layer(row.k)?;
        let shape = &self.shape;
        // All steps of a straight pile have one sign.
        let sign = match shape.sign_below(row.k).or(shape.sign_below(row.k - 1)) {
            Some(sign) => sign,
            // In a single layer no sphere is above another, so either sign will do.
            None if shape.layers() == 1 => Sign::Plus,
            None => return Err(bug("each of several layers has a step above or below it")),
        };
        let counts = region.row_counts([row.i.start, row.j], sign, row.k);
        for ((count, table), slice) in counts.into_iter().zip(&self.tables).zip(slices) {
            let n = slice.len();
            write(&Slopes::new(count.near(), n).along(table)?, slice)?;
        }
        Ok(())
    }

    /// Writes the forces below row `j` of a layer under one sphere.
    fn fill_row_of_pyramid(&self, j: i128, [a, b, c]: [&mut [V]; 3]) -> Result<(), Error> {
        let [alpha, beta, gamma] = &self.tables;
        let n = a.len();
        let (Some(alpha), Some(beta)) = (alpha.get(..n), beta.get(..n)) else {
            return Err(too_short());
        };
        // One loop fills both slices. Two loops, or a copy, take 1.5 times as long on rows this short.
        let values = alpha.iter().rev().zip(beta);
        for ((a, b), (down, up)) in a.iter_mut().zip(b).zip(values) {
            (*a, *b) = (down.clone(), up.clone());
        }
        let same = usize::try_from(j).ok().and_then(|j| gamma.get(j));
        c.fill(same.ok_or_else(too_short)?.clone());
        Ok(())
    }
}

fn too_short() -> Error {
    bug("a table has every force of its pile, and slices have the length that was checked")
}

/// Writes a row of forces that rise, are level, and fall.
fn write<V: Clone>(along: &Along<'_, V>, row: &mut [V]) -> Result<(), Error> {
    let Along { up, level, down } = *along;
    let same = row.len().checked_sub(up.len() + down.len());
    let same = same.ok_or_else(too_short)?;
    let (rising, rest) = row.split_at_mut(up.len());
    let (middle, falling) = rest.split_at_mut(same);
    rising.clone_from_slice(up);
    match level {
        Some(value) => middle.fill(value.clone()),
        None if middle.is_empty() => {}
        None => return Err(too_short()),
    }
    for (force, value) in falling.iter_mut().zip(down.iter().rev()) {
        *force = value.clone();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg_attr(debug_assertions, should_panic(expected = "a table has every force"))]
    fn a_force_that_is_not_in_the_table_is_a_bug() {
        let nothing = Along {
            up: &[],
            level: None,
            down: &[],
        };
        assert_eq!(write::<i64>(&nothing, &mut []), Ok(()));
        let written = write(&nothing, &mut [0]);
        assert!(matches!(written, Err(Error::Bug { .. })));
    }

    /// Layers are halved from 2^16 spheres on: 72 layers have 64,824, and 73 have 67,525. A single layer is never
    /// halved.
    #[cfg(feature = "rayon")]
    #[test]
    fn halves_have_equal_numbers_of_spheres_up_to_one_layer() {
        let table = |layers| Table::<i64> {
            tables: [const { Vec::new() }; 3],
            shape: Shape::pyramid(layers, Dimension::Three).unwrap(),
        };
        assert_eq!(table(72).halves(&(0..72)), None);
        assert_eq!(table(400).halves(&(380..381)), None);
        for (layers, range) in [(73, 0..73), (200, 0..200), (200, 150..160), (400, 380..383)] {
            let table = table(layers);
            let spheres = |range| table.shape.spheres_in(range);
            let (upper, lower) = table.halves(&range).unwrap();
            let middle = upper.end;
            assert_eq!((upper, lower), (range.start..middle, middle..range.end));
            assert!(range.start < middle && middle < range.end);
            let all = spheres(range.clone());
            assert!(spheres(range.start..middle) * 2_u32 >= all);
            assert!(spheres(range.start..middle - 1) * 2_u32 < all);
        }
    }
}
