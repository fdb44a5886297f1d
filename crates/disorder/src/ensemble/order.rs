//! The order of enumeration of stackings.

use cannonpile::lattice::Sign;

use super::{Choice, Ensemble};
use crate::Error;
use crate::FirstSign;
use crate::error::bug;

/// The stackings of an ensemble in lexicographic order of their signs from the top, with + before −.
#[derive(Clone, Copy, Debug)]
pub(super) struct Order {
    /// The first sign, if it is the same in all enumerated stackings.
    first: Option<Sign>,
    /// The number of signs that vary.
    pub(super) free: u32,
    /// The number of stackings with the same forces that each enumerated stacking represents.
    pub(super) factor: u32,
}

impl Order {
    pub(super) fn new(ensemble: &Ensemble, choice: &Choice, steps: usize) -> Result<Self, Error> {
        let given = match ensemble.stackings().first() {
            FirstSign::Plus => Some(Sign::Plus),
            FirstSign::Minus => Some(Sign::Minus),
            FirstSign::Random => None,
        };
        let both = *choice == Choice::All && given.is_none() && steps > 0;
        // Of two mirror images one is enumerated.
        let halves = both && ensemble.is_its_own_mirror_image();
        let first = if halves { Some(Sign::Plus) } else { given };
        // A single layer has no sign.
        let first = first.filter(|_| steps > 0);
        let free = steps - usize::from(first.is_some());
        Ok(Self {
            first,
            free: u32::try_from(free).map_err(|_| bug("layers that fit in memory are few"))?,
            factor: if halves { 2 } else { 1 },
        })
    }

    /// Returns the number of enumerated stackings. `None` if it is 2⁶² or more.
    pub(super) fn total(&self) -> Option<u64> {
        (self.free < 62).then(|| 1 << self.free)
    }

    /// Returns the signs of the stacking with this index.
    pub(super) fn signs(&self, index: u64) -> Vec<Sign> {
        let free = (0..self.free).rev().map(|bit| match index >> bit & 1 {
            0 => Sign::Plus,
            _ => Sign::Minus,
        });
        self.first.into_iter().chain(free).collect()
    }
}
