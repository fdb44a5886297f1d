//! Conversion of the forces that lines carry into contact forces below the spheres of a row.

use crate::formula::{half_turn, transmitted};
use crate::scalar::{Algebra, Numerators};

/// Converts the forces that lines carry into contact forces below a layer.
pub(super) struct Below<T: Algebra> {
    /// The increments of an ordinary sphere of the layer.
    pub(super) own: [T::Numerator; 3],
    /// The denominator of the forces.
    pub(super) scale: T::Numerator,
    /// True if the sign changes at the layer and the carried forces are not turned yet.
    pub(super) turns: bool,
    /// True if a force may overflow the scalar.
    pub(super) may_overflow: bool,
}

impl<T: Algebra> Below<T> {
    /// Writes the forces below a row, and returns whether all of them are defined.
    pub(super) fn write(&self, carried: [&[T::Numerator]; 3], out: [&mut [T]; 3]) -> bool {
        // Each case has its own loop, because a check of each value makes a loop take 1.5 times as long.
        match (self.turns, self.may_overflow) {
            (false, false) => self.write_checked(carried, out, |_| true),
            (false, true) => self.write_checked(carried, out, T::is_defined),
            (true, _) => self.write_turned(carried, out),
        }
    }

    #[inline]
    fn write_checked(
        &self,
        carried: [&[T::Numerator]; 3],
        out: [&mut [T]; 3],
        is_defined: impl Fn(&T) -> bool,
    ) -> bool {
        let mut defined = true;
        for ((carried, out), own) in carried.into_iter().zip(out).zip(&self.own) {
            for (force, out) in carried.iter().zip(out) {
                defined &= self.put(transmitted(force.clone(), own), out, &is_defined);
            }
        }
        defined
    }

    fn write_turned(&self, [a, b, c]: [&[T::Numerator]; 3], out: [&mut [T]; 3]) -> bool {
        let mut defined = true;
        let carried = a.iter().zip(b).zip(c);
        let [to_a, to_b, to_c] = out;
        for (((a, b), c), ((to_a, to_b), to_c)) in carried.zip(to_a.iter_mut().zip(to_b).zip(to_c))
        {
            let turned = half_turn::<T>(&[a.clone(), b.clone(), c.clone()]);
            for ((force, out), own) in turned.into_iter().zip([to_a, to_b, to_c]).zip(&self.own) {
                defined &= self.put(transmitted(force, own), out, &T::is_defined);
            }
        }
        defined
    }

    #[inline]
    fn put(&self, force: T::Numerator, out: &mut T, is_defined: &impl Fn(&T) -> bool) -> bool {
        match force.over(&self.scale) {
            Some(value) => {
                let defined = is_defined(&value);
                *out = value;
                defined
            }
            None => false,
        }
    }
}
