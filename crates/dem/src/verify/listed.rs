//! The measured forces of pairs of spheres, which a table lists once or twice.

use super::measured::Measured;
use super::refusal::Fault;

/// The order of the two spheres in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// The sphere with the smaller number is first.
    Forward,
    /// The sphere with the greater number is first.
    Backward,
    /// The row has no order: a contact point belongs to both spheres.
    Unknown,
}

/// The rows of a pair so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Listed {
    Never,
    Once(Order),
    /// In two rows that agree.
    Twice,
    /// In two rows with different forces.
    Differently,
}

impl Listed {
    /// Returns the state after another row. `None` for a third row, and for another force in the same order, as in a
    /// table of several steps.
    pub(super) fn after(self, order: Order, agrees: bool) -> Option<Self> {
        match self {
            Self::Never => Some(Self::Once(order)),
            Self::Once(_) if agrees => Some(Self::Twice),
            Self::Once(before) if before == order && order != Order::Unknown => None,
            Self::Once(_) => Some(Self::Differently),
            Self::Twice | Self::Differently => None,
        }
    }
}

/// A force for each contact. Vectors take memory only if there are any.
#[derive(Default)]
pub(super) struct Forces {
    /// The memory starts as zeros, so the system allocates only the pages that are written.
    pub(super) along: Vec<f64>,
    /// The vector on the sphere with the smaller number; NaN if none was measured.
    pub(super) vectors: Vec<[f64; 3]>,
    /// The tangential force on this sphere; NaN if none was measured.
    tangentials: Vec<[f64; 3]>,
}

impl Forces {
    /// Stores the force of a contact, one of `contacts`.
    pub(super) fn set(
        &mut self,
        slot: usize,
        contacts: usize,
        measured: &Measured,
    ) -> Result<(), Fault> {
        let beyond = || Fault::of_bug("every contact has a slot");
        if self.along.is_empty() {
            self.along = vec![0.0; contacts];
        }
        *self.along.get_mut(slot).ok_or_else(beyond)? = measured.force;
        for (vectors, vector) in [
            (&mut self.vectors, measured.vector),
            (&mut self.tangentials, measured.tangential),
        ] {
            let Some(vector) = vector else { continue };
            if vectors.is_empty() {
                *vectors = vec![[f64::NAN; 3]; contacts];
            }
            *vectors.get_mut(slot).ok_or_else(beyond)? = vector;
        }
        Ok(())
    }

    /// Returns the stored force of a contact between two spheres.
    pub(super) fn get(&self, slot: usize, ids: [u64; 2]) -> Option<Measured> {
        let at = |vectors: &[[f64; 3]]| {
            let vector = vectors.get(slot).copied();
            vector.filter(|[x, ..]| !x.is_nan())
        };
        Some(Measured {
            ids,
            force: *self.along.get(slot)?,
            vector: at(&self.vectors),
            tangential: at(&self.tangentials),
            is_length: false,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_is_listed_twice_at_most() {
        use Listed::{Differently, Never, Once, Twice};
        use Order::{Backward, Forward, Unknown};
        for order in [Forward, Backward, Unknown] {
            for agrees in [false, true] {
                assert_eq!(Never.after(order, agrees), Some(Once(order)));
                assert_eq!(Twice.after(order, agrees), None);
                assert_eq!(Differently.after(order, agrees), None);
            }
            assert_eq!(Once(order).after(order, true), Some(Twice));
        }
        assert_eq!(Once(Forward).after(Backward, true), Some(Twice));
        assert_eq!(Once(Forward).after(Backward, false), Some(Differently));
        assert_eq!(Once(Unknown).after(Unknown, false), Some(Differently));
        assert_eq!(Once(Forward).after(Forward, false), None);
        assert_eq!(Once(Backward).after(Backward, false), None);
        // A byte is all that a second row costs.
        assert_eq!(size_of::<Listed>(), 1);
    }
}
