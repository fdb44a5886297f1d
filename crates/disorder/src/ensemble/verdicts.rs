//! Verdicts of the caller's judge on stability with horizontal contacts.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use cannonpile::Pile;
use cannonpile::lattice::{Region, Sign};
use cannonpile::shape::Anchor;
use cannonpile::stacking::Stacking;

use super::Ensemble;
use crate::Error;

/// A function that decides whether a pile is stable with horizontal contacts.
pub(super) type Judge<'j, E> = dyn Fn(&Pile) -> Result<bool, E> + Sync + 'j;

/// A cache of verdicts on the stackings of one class, by the signs from the top. The judge is called once for each
/// stacking, unless two threads need the same verdict at the same time.
pub(super) struct Verdicts<'j, E> {
    ensemble: &'j Ensemble,
    judge: &'j Judge<'j, E>,
    known: Mutex<BTreeMap<Vec<Sign>, bool>>,
}

impl<'j, E: From<Error>> Verdicts<'j, E> {
    pub(super) fn new(ensemble: &'j Ensemble, judge: &'j Judge<'j, E>) -> Self {
        Self {
            ensemble,
            judge,
            known: Mutex::default(),
        }
    }

    /// Returns whether the stacking with these signs is stable with horizontal contacts. Its bottom layer is `bottom`,
    /// which the signs determine.
    pub(super) fn is_stable(&self, signs: &[Sign], bottom: Region) -> Result<bool, E> {
        // A thread that panics leaves the map intact, because it only inserts under the lock.
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known().get(signs).copied();
        if let Some(found) = found {
            return Ok(found);
        }
        let stacking = Stacking::from_signs(signs.iter().copied()).map_err(Error::from)?;
        // A pile with horizontal contacts has weight and, on a base, no loads.
        let pile = match self.ensemble.anchor() {
            Anchor::Top(_) => self.ensemble.pile(stacking)?,
            Anchor::Base(_) => Pile::on(bottom, stacking).map_err(Error::from)?,
        };
        let stands = (self.judge)(&pile)?;
        known().insert(signs.to_vec(), stands);
        Ok(stands)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::{Choice, FirstSign, RandomStackings, Shard};

    /// An error type of the caller.
    #[derive(Debug, PartialEq)]
    enum Failure {
        Judge,
        Run(Error),
    }

    impl From<Error> for Failure {
        fn from(error: Error) -> Self {
            Self::Run(error)
        }
    }

    fn touching() -> Result<Ensemble, Error> {
        let stackings = RandomStackings::new(7, FirstSign::Plus)?;
        Ensemble::under(Region::SITE, stackings)?.with_horizontal_contacts()
    }

    #[test]
    fn the_judge_is_called_once_for_a_stacking() -> Result<(), Error> {
        let calls = AtomicUsize::new(0);
        let judge = |_: &Pile| {
            calls.fetch_add(1, Ordering::Relaxed);
            Ok::<_, Error>(true)
        };
        let ensemble = touching()?;
        let verdicts = Verdicts::new(&ensemble, &judge);
        for signs in [[Sign::Plus, Sign::Minus], [Sign::Plus, Sign::Minus]] {
            assert!(verdicts.is_stable(&signs, Region::hexagon(2, 2)?)?);
        }
        assert_eq!(calls.into_inner(), 1);
        Ok(())
    }

    #[test]
    fn errors_of_the_judge_and_of_the_run_reach_the_caller() -> Result<(), Error> {
        let judge = |_: &Pile| Err(Failure::Judge);
        let run = |ensemble: Ensemble, choice: &Choice| {
            ensemble.run_judged(choice, Shard::WHOLE, &|_| {}, &judge)
        };
        assert_eq!(run(touching()?, &Choice::All), Err(Failure::Judge));
        let stackings = RandomStackings::new(60, FirstSign::Plus)?;
        let large = Ensemble::under(Region::SITE, stackings)?;
        let refused = run(large, &Choice::All);
        assert!(matches!(
            refused,
            Err(Failure::Run(Error::TooManyStackings { .. }))
        ));
        // Without horizontal contacts the run does not call the judge.
        let stackings = RandomStackings::new(7, FirstSign::Plus)?;
        let sloping = Ensemble::under(Region::SITE, stackings)?;
        assert!(run(sloping, &Choice::All).is_ok());
        Ok(())
    }
}
