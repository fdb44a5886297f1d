//! What lines carry, as the forces below the spheres of a row.

use crate::formula::{half_turn, transmitted};
use crate::scalar::Algebra;

/// What turns the numbers that lines carry into forces below a layer.
pub(super) struct Below<T: Algebra> {
    /// What an ordinary sphere of the layer adds.
    pub(super) own: [T::Numerator; 3],
    /// The denominator.
    pub(super) scale: T::Numerator,
    /// Whether the sign changes at the layer, and what is carried is not turned yet.
    pub(super) turns: bool,
    /// Whether a force may be too great for the scalar.
    pub(super) may_overflow: bool,
}

impl<T: Algebra> Below<T> {
    /// Writes the forces below a row, and returns whether all are numbers.
    pub(super) fn write(&self, carried: [&[T::Numerator]; 3], out: [&mut [T]; 3]) -> bool {
        // In loops of their own: looking at each number takes half as long again.
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
        match T::from_ratio(force, &self.scale) {
            Some(value) => {
                let defined = is_defined(&value);
                *out = value;
                defined
            }
            None => false,
        }
    }
}
