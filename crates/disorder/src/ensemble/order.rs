//! The order of all stackings.

use cannonpile::lattice::Sign;

use super::{Choice, Ensemble};
use crate::Error;
use crate::FirstSign;
use crate::error::bug;

/// The order of all stackings of an ensemble: that of their signs from the top, + before −.
#[derive(Clone, Copy, Debug)]
pub(super) struct Order {
    /// The first sign, where it is given, or one of two mirror images is walked for both.
    first: Option<Sign>,
    /// The number of signs that are not given.
    pub(super) free: u32,
    /// How many stackings each stands for.
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
        let halves = both && ensemble.is_its_own_mirror_image();
        let first = if halves { Some(Sign::Plus) } else { given };
        let free = if first.is_some() {
            steps.saturating_sub(1)
        } else {
            steps
        };
        Ok(Self {
            first,
            free: u32::try_from(free).map_err(|_| bug("layers that fit in memory are few"))?,
            factor: if halves { 2 } else { 1 },
        })
    }

    /// The first sign, where it is given.
    pub(super) const fn first(&self) -> Option<Sign> {
        self.first
    }

    /// How many there are, if places are counted in 62 bits.
    pub(super) fn total(&self) -> Option<u64> {
        (self.free < 62).then(|| 1 << self.free)
    }

    /// The signs of the stacking at a place of the order.
    pub(super) fn signs(&self, place: u64) -> Vec<Sign> {
        let free = (0..self.free).rev().map(|bit| match place >> bit & 1 {
            0 => Sign::Plus,
            _ => Sign::Minus,
        });
        self.first.into_iter().chain(free).collect()
    }
}
