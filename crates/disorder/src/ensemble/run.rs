//! A run over one shard, in pieces. With the feature `rayon` it uses all cores.

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

/// A run over the stackings or samples of one shard.
pub(super) struct Run<'r, E> {
    pub(super) ensemble: &'r Ensemble,
    pub(super) choice: &'r Choice,
    pub(super) shard: Shard,
    pub(super) task: &'r Task,
    pub(super) observer: &'r (dyn Fn(u64) + Sync),
    /// The function that decides stability with horizontal contacts, if the ensemble counts it.
    pub(super) judge: Option<&'r Judge<'r, E>>,
}

/// The number of samples that are sorted and walked together.
const DRAWN: u64 = 1 << 13;

/// The largest number of pieces of a large enumeration.
const PIECES: u64 = 1 << 7;

/// The number of pieces that are counted before their tallies are added.
const AT_ONCE: usize = 1 << 6;

impl<E: From<Error> + Send> Run<'_, E> {
    /// Returns the tally. The integers are as wide as the bound requires.
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

    /// Returns the indices of the pieces.
    fn pieces(&self) -> impl Iterator<Item = Range<u64>> + use<E> {
        let Range { start, end } = self.task.range;
        let length = match self.choice {
            // Pieces start at multiples of a power of two, so that few beginnings occur in two pieces.
            Choice::All => ((end - start) / PIECES).max(1 << 8).next_power_of_two(),
            Choice::Drawn(_) => DRAWN,
        };
        let first = start / length;
        let after = end.div_ceil(length);
        let pieces = (first..after).map(move |piece| {
            let from = piece * length;
            // With 2⁶⁴ − 1 samples the end of the last piece would overflow.
            from.max(start)..from.saturating_add(length).min(end)
        });
        // An empty range would yield one empty piece.
        pieces.filter(|piece| !piece.is_empty())
    }

    /// Counts one piece.
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
