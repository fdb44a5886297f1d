//! One layer of a sweep, as numerators of a scalar, with deferred passes.

use alloc::vec::Vec;
use core::ops::Range;

use num_traits::Zero;

use super::bands::make;
use super::grid::{Grid, Layer, Moves, Pass, assert_none_deferred};
use super::plane::{Plane, Ramps};
use crate::each::Each;
use crate::scalar::{Algebra, Ring};
use crate::{Error, formula};

/// The number of passes that are deferred and then made together. They are made earlier if a number is read.
const MAX_DEFERRED: usize = 8;

/// One number for each line of a layer, and the deferred passes with their increments.
#[derive(Clone, Debug)]
pub(crate) struct Cells<V> {
    plane: Plane<V>,
    deferred: Vec<(Pass, [V; 3])>,
}

impl<V: Clone> Cells<V> {
    pub(crate) fn new(grid: &Grid<'_>, zero: &V) -> Self {
        Self {
            plane: Plane::new(grid, zero),
            deferred: Vec::new(),
        }
    }

    /// Returns the numbers on consecutive lines, by direction.
    pub(super) fn slices(&self, cells: [Range<usize>; 3]) -> [&[V]; 3] {
        assert_none_deferred(&self.deferred);
        self.plane.slices(cells)
    }
}

impl<T: Algebra> Layer<T> for Cells<T::Numerator> {
    fn pass(
        &mut self,
        grid: &Grid<'_>,
        pass: &Pass,
        increments: &[T::Numerator; 3],
    ) -> Result<(), Error> {
        self.deferred.push((*pass, increments.clone()));
        if self.deferred.len() == MAX_DEFERRED {
            return Layer::<T>::catch_up(self, grid);
        }
        Ok(())
    }

    fn catch_up(&mut self, grid: &Grid<'_>) -> Result<(), Error> {
        let deferred = core::mem::take(&mut self.deferred);
        let ramps = |pass: &Pass, increments| {
            let times = |w: &_, n| formula::force(T::Numerator::from_integer(n), w);
            alloc::vec![Ramps::new(pass, increments, times)]
        };
        let passes = deferred.iter().map(|(pass, w)| (*pass, ramps(pass, w)));
        let passes: Vec<_> = passes.collect();
        let plane = core::slice::from_mut(&mut self.plane);
        make(plane, grid, &passes, |_, _| (), formula::half_turn::<T>)
    }

    fn add_at(&mut self, cells: [usize; 3], values: &[T::Numerator; 3]) -> Result<(), Error> {
        assert_none_deferred(&self.deferred);
        self.plane.add_to(cells, values);
        Ok(())
    }

    fn move_to(&mut self, next: &Grid<'_>, moves: &Moves) {
        assert_none_deferred(&self.deferred);
        let zero = T::Numerator::zero();
        self.plane.move_to(&mut Vec::new(), next, moves, &zero);
    }

    fn at(&self, cells: [usize; 3]) -> [T::Numerator; 3] {
        assert_none_deferred(&self.deferred);
        self.plane.carried(cells).each(Clone::clone)
    }
}
