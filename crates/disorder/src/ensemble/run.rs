//! A part, walked in pieces: on all cores, with the feature `rayon`.

use core::ops::Range;

use cannonpile::engine::try_for_each;
use num_bigint::BigInt;

use super::draw::Sampler;
use super::layer::Numerator;
use super::setup::{Setup, Task};
use super::verdicts::{Judge, Verdicts};
use super::walk::walk;
use super::{Choice, Ensemble, Shard, Tally, WithFaults};
use crate::Error;

/// A walk through the stackings of a part, piece by piece.
pub(super) struct Run<'r, E> {
    pub(super) ensemble: &'r Ensemble,
    pub(super) choice: &'r Choice,
    pub(super) shard: Shard,
    pub(super) task: &'r Task,
    pub(super) observer: &'r (dyn Fn(u64) + Sync),
    /// Decides which stackings stand with horizontal contacts, if the ensemble counts them.
    pub(super) judge: Option<&'r Judge<'r, E>>,
}

/// How many samples are drawn before they are sorted and walked.
const DRAWN: u64 = 1 << 13;

/// The pieces that all stackings are cut into, at most, where they are many.
const PIECES: u64 = 1 << 7;

/// How many pieces are counted before they are put together.
const AT_ONCE: usize = 1 << 6;

impl<E: From<Error> + Send> Run<'_, E> {
    /// What is counted, in numbers that are as wide as they must be.
    pub(super) fn tally(&self) -> Result<Tally, E> {
        if self.task.fits(64) {
            self.in_numbers::<i64>()
        } else if self.task.fits(128) {
            self.in_numbers::<i128>()
        } else {
            self.in_numbers::<BigInt>()
        }
    }

    fn in_numbers<T: Numerator>(&self) -> Result<Tally, E> {
        let verdicts = match (self.ensemble.has_horizontal_contacts, self.judge) {
            (false, _) => None,
            (true, Some(judge)) => Some(Verdicts::new(self.ensemble, judge)),
            (true, None) => return Err(Error::NoJudge.into()),
        };
        let setup = self.task.setup::<T>(self.ensemble)?;
        let nothing = || Tally::nothing(self.ensemble.clone(), self.choice.clone(), self.shard);
        let mut tally = nothing()?;
        let mut pieces = self.pieces();
        loop {
            let ranges: Vec<_> = pieces.by_ref().take(AT_ONCE).collect();
            if ranges.is_empty() {
                return Ok(tally);
            }
            let mut counted = ranges
                .iter()
                .map(|_| nothing())
                .collect::<Result<Vec<_>, _>>()?;
            try_for_each(
                ranges.into_iter().zip(&mut counted).collect(),
                |(range, counted)| self.count(&setup, verdicts.as_ref(), range, counted),
            )?;
            for counted in &counted {
                tally.add(counted);
            }
        }
    }

    /// The part, cut up.
    fn pieces(&self) -> impl Iterator<Item = Range<u64>> + use<E> {
        let Range { start, end } = self.task.range;
        let length = match self.choice {
            // Beginnings of which all stackings are walked, if there are many.
            Choice::All => ((end - start) / PIECES).max(1 << 8).next_power_of_two(),
            Choice::Drawn(_) => DRAWN,
        };
        let first = start / length;
        let after = end.div_ceil(length);
        let pieces = (first..after).map(move |piece| {
            let from = piece * length;
            // The last piece of all 2⁶⁴ − 1 samples would end beyond the last number.
            from.max(start)..from.saturating_add(length).min(end)
        });
        // Of nothing, which is in the middle of a piece, there is no piece.
        pieces.filter(|piece| !piece.is_empty())
    }

    /// Counts a piece.
    fn count<T: Numerator>(
        &self,
        setup: &Setup<T>,
        verdicts: Option<&Verdicts<'_, E>>,
        range: Range<u64>,
        tally: &mut Tally,
    ) -> Result<(), E> {
        let length = range.end - range.start;
        let list: Vec<_> = match self.choice {
            Choice::All => range.map(|index| self.task.order.signs(index)).collect(),
            Choice::Drawn(samples) => {
                let first = self.ensemble.stackings.first();
                let sampler = Sampler::new(samples, first, setup.steps)?;
                let mut drawn: Vec<_> = range.map(|n| sampler.sample(n)).collect();
                drawn.sort_unstable();
                drawn
            }
        };
        let counted = walk(setup, verdicts, &list)?;
        let has_held = self.ensemble.has_horizontal_contacts;
        let kinds = counted.all.iter().zip(&counted.standing).zip(&counted.held);
        for (faults, (((all, standing), held), with)) in kinds.zip(&mut tally.faults).enumerate() {
            let held = has_held.then_some(*held);
            *with = WithFaults::of([all, standing], held, setup, faults)?;
        }
        (self.observer)(length);
        Ok(())
    }
}
