//! One number for each line of a layer, and the increments of a pass.

use alloc::vec::Vec;
use core::ops::{Add, Range};

use super::grid::{Grid, Moves, Pass, Piece};
use crate::each::Each;
use crate::formula;

/// One number for each line of a layer, by direction, in the cells of the grid.
#[derive(Clone, Debug)]
pub(super) struct Plane<V>(pub(super) [Vec<V>; 3]);

/// The increments that a pass adds to a line: `ramps[direction][n]` for n spheres.
pub(super) struct Ramps<V>(pub(super) [Vec<V>; 3]);

impl<V: Clone + PartialEq> Ramps<V> {
    /// Returns the ramps of a pass from the increments of one sphere and a function for n times an increment.
    pub(super) fn new<W: PartialEq>(
        pass: &Pass,
        increments: &[W; 3],
        times: impl Fn(&W, i128) -> V,
    ) -> Self {
        let ramp = |w: &W| -> Vec<V> {
            let counts = 0..=pass.greatest_count();
            counts.map(|n| times(w, n)).collect()
        };
        let [a, b, c] = increments;
        let alpha = ramp(a);
        let beta = if a == b { alpha.clone() } else { ramp(b) };
        let gamma = if a == c { alpha.clone() } else { ramp(c) };
        Self([alpha, beta, gamma])
    }
}

impl<V: Clone> Plane<V> {
    pub(super) fn slices_mut(&mut self) -> [&mut [V]; 3] {
        self.0.each_mut().each(Vec::as_mut_slice)
    }

    pub(super) fn new(grid: &Grid<'_>, zero: &V) -> Self {
        Self([(); 3].each(|()| alloc::vec![zero.clone(); grid.cells]))
    }

    /// Moves the numbers to the cells of the next window. The numbers of each direction are copied into the buffer
    /// `other`, which then replaces their old storage.
    pub(super) fn move_to(&mut self, other: &mut Vec<V>, next: &Grid<'_>, moves: &Moves, zero: &V) {
        let images = moves.images.iter();
        let images: Vec<_> = images
            .map(|Piece { from, to, .. }| (to, self.0[from.0][from.1].clone()))
            .collect();
        for (line, numbers) in self.0.iter_mut().enumerate() {
            other.clear();
            // `reserve` allocates extra room for later windows. A buffer that grew slightly each time would leave holes
            // in the heap that are too small for reuse.
            other.reserve(next.cells);
            other.resize(next.cells, zero.clone());
            for Piece { from, to, length } in moves.rows.iter().filter(|row| row.to.0 == line) {
                let row = &numbers[from.1..from.1 + length];
                other[to.1..to.1 + length].clone_from_slice(row);
            }
            for (to, image) in images.iter().filter(|(to, _)| to.0 == line) {
                other[to.1] = image.clone();
            }
            core::mem::swap(numbers, other);
        }
    }

    /// Returns the numbers on the three lines of a sphere.
    pub(super) fn carried(&self, [a, b, c]: [usize; 3]) -> [&V; 3] {
        let Self([alpha, beta, gamma]) = self;
        [&alpha[a], &beta[b], &gamma[c]]
    }

    /// Returns the numbers on consecutive lines, by direction.
    pub(super) fn slices(&self, [a, b, c]: [Range<usize>; 3]) -> [&[V]; 3] {
        let Self([alpha, beta, gamma]) = self;
        [&alpha[a], &beta[b], &gamma[c]]
    }
}

impl<V: Clone + for<'a> Add<&'a V, Output = V>> Plane<V> {
    /// Adds values to the three lines of a sphere.
    pub(super) fn add_to(&mut self, cells: [usize; 3], values: &[V; 3]) {
        for ((line, cell), value) in self.0.iter_mut().zip(cells).zip(values) {
            // The cells come from the grid, so they are in range.
            line[cell] = formula::transmitted(line[cell].clone(), value);
        }
    }
}

/// Returns the slices of a row, by direction.
pub(super) fn row<'r, V>(
    [alpha, beta, gamma]: &'r mut [&mut [V]; 3],
    [a, b, c]: [Range<usize>; 3],
) -> [&'r mut [V]; 3] {
    [&mut alpha[a], &mut beta[b], &mut gamma[c]]
}
