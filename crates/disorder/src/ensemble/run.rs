//! A run over one shard, in pieces. With the feature `rayon` it uses all cores.

use core::ops::Range;

use cannonpile::Pile;
use cannonpile::engine::try_for_each;
use cannonpile::lattice::Sign;
use num_bigint::BigInt;

use super::draw::Sampler;
use super::layer::Numerator;
use super::setup::{Setup, Task, class_of, too_many_faults};
use super::verdicts::{Judge, Verdicts};
use super::walk::walk;
use super::{Choice, Ensemble, Shard, Tally, WithFaults};
use crate::Error;
use crate::error::bug;

impl Ensemble {
    /// Counts the forces of all stackings or samples of a shard.
    ///
    /// # Errors
    /// * [`Error::TooManyStackings`] for a shard of more than 2²⁴ enumerated stackings.
    /// * [`TooLarge`](cannonpile::Error::TooLarge) for layers that do not fit in memory, for more than 10⁵ bins, and
    ///   for more than 2⁶² contact forces.
    /// * [`Error::NoJudge`] with horizontal contacts.
    /// * [`Error::NoStacking`] for a base that supports no stacking of this height.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Samples, Shard, Tally};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(9, FirstSign::Random)?;
    /// let ensemble = Ensemble::under(Region::SITE, stackings)?;
    /// let half = BigRational::new(1.into(), 2.into());
    /// let drawn = Choice::Drawn(Samples::new(100, 1, half)?);
    /// let whole = ensemble.run(&drawn, Shard::WHOLE)?;
    /// // The shards can run on different machines.
    /// let parts: Result<Vec<_>, _> = (1..=3).map(|part| ensemble.run(&drawn, Shard::new(part, 3)?)).collect();
    /// assert_eq!(Tally::merge(&parts?), Ok(whole));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn run(&self, choice: &Choice, shard: Shard) -> Result<Tally, Error> {
        self.run_observed(choice, shard, &|_| {})
    }

    /// Returns the result of [`run`](Self::run), and reports its progress. Each call of the observer receives the
    /// number of stackings that were computed since the last call.
    ///
    /// # Errors
    /// As for [`run`](Self::run).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    /// use std::sync::atomic::{AtomicU64, Ordering};
    ///
    /// let stackings = RandomStackings::new(9, FirstSign::Plus)?;
    /// let ensemble = Ensemble::under(Region::SITE, stackings)?;
    /// let done = AtomicU64::new(0);
    /// let count = |more| { done.fetch_add(more, Ordering::Relaxed); };
    /// ensemble.run_observed(&Choice::All, Shard::WHOLE, &count)?;
    /// assert_eq!(done.into_inner(), 128);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn run_observed(
        &self,
        choice: &Choice,
        shard: Shard,
        observer: &(dyn Fn(u64) + Sync),
    ) -> Result<Tally, Error> {
        self.run_with(choice, shard, observer, None)
    }

    /// Returns the result of [`run_observed`](Self::run_observed) for an ensemble that also counts the stackings that
    /// are stable with horizontal contacts. The judge decides whether a pile is.
    ///
    /// The run calls the judge only for piles that are unstable without horizontal contacts. Each of them ends with a
    /// sign change, and is stable without its last layer. The judge may be called from several threads at once, and
    /// must return the same verdict for the same pile. It is not called for an ensemble that does not count these
    /// stackings.
    ///
    /// # Errors
    /// As for [`run`](Self::run), and those of the judge. If the judge fails several times, one of its errors is returned.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{ContactSet, Choice, Ensemble, Error, FirstSign, RandomStackings, Shard};
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(7, FirstSign::Plus)?;
    /// let touching = Ensemble::under(Region::SITE, stackings)?.with_horizontal_contacts()?;
    /// // HCP of five layers, continued straight, is stable only with horizontal contacts. For any pile the crate
    /// // `cannonpile-horizontal` decides it with a proof: `Ok(equilibrium(pile)?.claim == Claim::Stands)`.
    /// let judge = |pile: &Pile| Ok::<_, Error>(pile.shape().stacking().to_string() == "+-+-+");
    /// let tally = touching.run_judged(&Choice::All, Shard::WHOLE, &|_| {}, &judge)?;
    /// assert_eq!(tally.standing(ContactSet::Sloping), Some(11_u32.into()));
    /// assert_eq!(tally.standing(ContactSet::WithHorizontal), Some(12_u32.into()));
    ///
    /// // There is no default for the judge.
    /// assert_eq!(touching.run(&Choice::All, Shard::WHOLE), Err(Error::NoJudge));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn run_judged<E: From<Error> + Send>(
        &self,
        choice: &Choice,
        shard: Shard,
        observer: &(dyn Fn(u64) + Sync),
        judge: &(dyn Fn(&Pile) -> Result<bool, E> + Sync),
    ) -> Result<Tally, E> {
        self.run_with(choice, shard, observer, Some(judge))
    }

    fn run_with<E: From<Error> + Send>(
        &self,
        choice: &Choice,
        shard: Shard,
        observer: &(dyn Fn(u64) + Sync),
        judge: Option<&Judge<'_, E>>,
    ) -> Result<Tally, E> {
        Run {
            ensemble: self,
            choice,
            shard,
            task: &Task::new(self, choice, shard)?,
            observer,
            judge,
        }
        .tally()
    }

    /// Returns the number of stackings or samples of a shard. Two mirror images with the same forces count as one. On a
    /// base the number includes the stackings that are left out.
    ///
    /// # Errors
    /// As for [`run`](Self::run), except [`Error::NoJudge`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(9, FirstSign::Random)?;
    /// let ensemble = Ensemble::under(Region::SITE, stackings)?;
    /// assert_eq!(ensemble.size(&Choice::All, Shard::new(1, 4)?)?, 32);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn size(&self, choice: &Choice, shard: Shard) -> Result<u64, Error> {
        let Range { start, end } = Task::new(self, choice, shard)?.range;
        Ok(end - start)
    }
}

/// A run over the stackings or samples of one shard.
struct Run<'r, E> {
    ensemble: &'r Ensemble,
    choice: &'r Choice,
    shard: Shard,
    task: &'r Task,
    observer: &'r (dyn Fn(u64) + Sync),
    /// The function that decides stability with horizontal contacts, if the ensemble counts it.
    judge: Option<&'r Judge<'r, E>>,
}

/// The constants and the verdicts of the stackings that are walked together.
struct Class<'r, T, E> {
    setup: Setup<T>,
    verdicts: Option<Verdicts<'r, E>>,
}

/// The number of samples that are sorted and walked together.
const DRAWN: u64 = 1 << 13;

/// The largest number of pieces of a large enumeration.
const PIECES: u64 = 1 << 7;

/// The number of pieces that are counted before their tallies are added.
const AT_ONCE: usize = 1 << 6;

impl<E: From<Error> + Send> Run<'_, E> {
    /// Returns the tally. The integers are as wide as the bound requires.
    fn tally(&self) -> Result<Tally, E> {
        if self.task.fits(64) {
            self.in_numbers::<i64>()
        } else if self.task.fits(128) {
            self.in_numbers::<i128>()
        } else {
            self.in_numbers::<BigInt>()
        }
    }

    fn in_numbers<T: Numerator>(&self) -> Result<Tally, E> {
        let has_held = self.ensemble.has_horizontal_contacts();
        let judge = self.judge.filter(|_| has_held);
        if has_held && judge.is_none() {
            return Err(Error::NoJudge.into());
        }
        let class = |setup| Class {
            setup,
            verdicts: judge.map(|judge| Verdicts::new(self.ensemble, judge)),
        };
        let setups = self.task.setups::<T>(self.ensemble)?;
        let classes: Vec<_> = setups.into_iter().map(|setup| setup.map(class)).collect();
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
                |(range, counted)| self.count(&classes, range, counted),
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
        classes: &[Option<Class<'_, T, E>>],
        range: Range<u64>,
        tally: &mut Tally,
    ) -> Result<(), E> {
        let length = range.end - range.start;
        let mut list: Vec<_> = match self.choice {
            Choice::All => range.map(|index| self.task.order.signs(index)).collect(),
            Choice::Drawn(samples) => {
                let first = self.ensemble.stackings().first();
                let sampler = Sampler::new(samples, first, self.task.steps)?;
                let mut drawn: Vec<_> = range.map(|n| sampler.sample(n)).collect();
                drawn.sort_unstable();
                drawn
            }
        };
        let class = |signs: &Vec<Sign>| class_of(self.ensemble, signs);
        // This sort is stable, so the stackings of each class stay sorted.
        list.sort_by_key(class);
        for list in list.chunk_by(|one, other| class(one) == class(other)) {
            let found = list.first().and_then(|signs| classes.get(class(signs)));
            match found.ok_or_else(|| bug("every stacking has a class"))? {
                Some(class) => Self::count_class(class, list, tally)?,
                None => self.leave_out(list, tally)?,
            }
        }
        (self.observer)(length);
        Ok(())
    }

    /// Counts stackings of one class.
    fn count_class<T: Numerator>(
        Class { setup, verdicts }: &Class<'_, T, E>,
        list: &[Vec<Sign>],
        tally: &mut Tally,
    ) -> Result<(), E> {
        let counted = walk(setup, verdicts.as_ref(), list)?;
        let kinds = counted.all.iter().zip(&counted.standing).zip(&counted.held);
        for (faults, (((all, standing), held), with)) in kinds.zip(&mut tally.faults).enumerate() {
            let held = verdicts.is_some().then_some(*held);
            with.add(&WithFaults::of([all, standing], held, setup, faults)?);
        }
        Ok(())
    }

    /// Counts stackings that the base does not support.
    fn leave_out(&self, list: &[Vec<Sign>], tally: &mut Tally) -> Result<(), Error> {
        for signs in list {
            let changes = signs.windows(2).filter(|pair| pair.first() != pair.last());
            let with = tally.faults.get_mut(changes.count());
            let with = with.ok_or_else(too_many_faults)?;
            if let Some(left_out) = &mut with.left_out {
                *left_out += self.task.order.factor;
            }
        }
        Ok(())
    }
}
