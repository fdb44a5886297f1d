//! A number for each line of a layer, and what a pass adds to it.

use alloc::vec::Vec;
use core::ops::{Add, Range};

use super::grid::{Grid, Moves, Pass, Piece};
use crate::formula;

/// A number for each line of a layer, by direction, in the cells of the last layer.
#[derive(Clone, Debug)]
pub(super) struct Plane<V>(pub(super) [Vec<V>; 3]);

/// What the spheres of a pass come to on a line: `ramps[direction][n]` for n of them.
pub(super) struct Ramps<V>(pub(super) [Vec<V>; 3]);

impl<V: Clone + PartialEq> Ramps<V> {
    /// From what one sphere adds to its lines, and what `n` of it are.
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

    /// The ramps of a part of each number, if all of them have it.
    pub(super) fn try_map<U>(&self, part: impl Fn(&V) -> Option<U>) -> Option<Ramps<U>> {
        let of_line = |ramp: &Vec<V>| ramp.iter().map(&part).collect::<Option<Vec<U>>>();
        let [a, b, c] = self.0.each_ref().map(of_line);
        Some(Ramps([a?, b?, c?]))
    }
}

impl<V: Clone> Plane<V> {
    pub(super) fn slices_mut(&mut self) -> [&mut [V]; 3] {
        self.0.each_mut().map(Vec::as_mut_slice)
    }

    pub(super) fn new(grid: &Grid<'_>, zero: &V) -> Self {
        Self(core::array::from_fn(
            |_| alloc::vec![zero.clone(); grid.cells],
        ))
    }

    /// Takes the numbers to the cells of the next window: those of a direction in other memory, which is left with what
    /// they had.
    pub(super) fn move_to(&mut self, other: &mut Vec<V>, next: &Grid<'_>, moves: &Moves, zero: &V) {
        let images = moves.images.iter();
        let images: Vec<_> = images
            .map(|Piece { from, to, .. }| (to, self.0[from.0][from.1].clone()))
            .collect();
        for (line, numbers) in self.0.iter_mut().enumerate() {
            other.clear();
            // With room for windows to come: memory that grows by little each time leaves gaps that nothing fits in.
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

    /// What the three lines of a sphere carry.
    pub(super) fn carried(&self, [a, b, c]: [usize; 3]) -> [&V; 3] {
        let Self([alpha, beta, gamma]) = self;
        [&alpha[a], &beta[b], &gamma[c]]
    }

    /// What consecutive lines carry, by direction.
    pub(super) fn slices(&self, [a, b, c]: [Range<usize>; 3]) -> [&[V]; 3] {
        let Self([alpha, beta, gamma]) = self;
        [&alpha[a], &beta[b], &gamma[c]]
    }
}

impl<V: Clone + for<'a> Add<&'a V, Output = V>> Plane<V> {
    /// Adds to the three lines of a sphere.
    pub(super) fn add_to(&mut self, cells: [usize; 3], values: &[V; 3]) {
        for ((line, cell), value) in self.0.iter_mut().zip(cells).zip(values) {
            // A cell of the grid.
            line[cell] = formula::transmitted(line[cell].clone(), value);
        }
    }
}

/// The cells of a row by direction.
pub(super) fn row<'r, V>(
    [alpha, beta, gamma]: &'r mut [&mut [V]; 3],
    [a, b, c]: [Range<usize>; 3],
) -> [&'r mut [V]; 3] {
    [&mut alpha[a], &mut beta[b], &mut gamma[c]]
}
