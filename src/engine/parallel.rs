//! Work on all cores, with the feature `rayon`; one after the other without it.

#[cfg(feature = "rayon")]
use core::sync::atomic::{AtomicBool, Ordering};

#[cfg(feature = "rayon")]
use super::interrupt;
use crate::Error;
#[cfg(feature = "rayon")]
use crate::error::bug;

/// How often a thread looks for the end of what it shared, about a microsecond each time, before it sleeps.
#[cfg(feature = "rayon")]
const PATIENCE: usize = 200;

/// Whether there may be several.
pub(crate) const HAS_THREADS: bool = cfg!(feature = "rayon");

/// How many threads there are to work on.
pub(crate) fn threads() -> usize {
    #[cfg(feature = "rayon")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "rayon"))]
    1
}

/// Does two things, at once where there are threads, and returns what comes of them.
pub(crate) fn join<A: Send, B: Send>(
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "rayon")]
    {
        let asked = interrupt::current();
        rayon::join(
            || interrupt::within(asked.as_ref(), one),
            || interrupt::within(asked.as_ref(), other),
        )
    }
    #[cfg(not(feature = "rayon"))]
    (one(), other())
}

/// Does two things, at once where there are threads: one of them on this thread, also if it is none of theirs, so that none has
/// to be woken if one stands by ([`with_one_standing_by`]).
///
/// # Errors
/// Those of both.
pub(crate) fn share(
    one: impl FnOnce() -> Result<(), Error> + Send,
    other: impl FnOnce() -> Result<(), Error> + Send,
) -> Result<(), Error> {
    #[cfg(feature = "rayon")]
    if rayon::current_thread_index().is_none() {
        let asked = interrupt::current();
        let ended = &AtomicBool::new(false);
        let mut others = None;
        let to_others = &mut others;
        let ones = rayon::in_place_scope(|scope| {
            scope.spawn(|_| {
                let _ended = Ended(ended);
                *to_others = Some(interrupt::within(asked.as_ref(), other));
            });
            let ones = one();
            // It ends soon, if it was begun as soon: this thread would not be woken as soon.
            let mut looks = 0..PATIENCE;
            while looks.next().is_some() && !ended.load(Ordering::Acquire) {
                std::thread::yield_now();
            }
            ones
        });
        return match others {
            Some(others) => ones.and(others),
            None => Err(bug("a scope ends when all of it is done")),
        };
    }
    let (ones, others) = join(one, other);
    ones.and(others)
}

/// Set when what it is made for ends, in whatever way.
#[cfg(feature = "rayon")]
struct Ended<'e>(&'e AtomicBool);

#[cfg(feature = "rayon")]
impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

/// Does something while a thread stands by for what is shared meanwhile ([`share`]): a thread that sleeps is woken in as
/// long as a layer takes.
///
/// It ends when the work does, or what that thread took on for others. It is the first that another thread takes of what this
/// one shares out: so none that waits for its own share comes to stand by for itself.
pub(crate) fn with_one_standing_by<A>(work: impl FnOnce() -> A) -> A {
    #[cfg(feature = "rayon")]
    if threads() > 1 {
        let ended = &AtomicBool::new(false);
        return rayon::in_place_scope(|scope| {
            scope.spawn(|_| {
                while !ended.load(Ordering::Acquire) {
                    if rayon::yield_now() != Some(rayon::Yield::Executed) {
                        // Both threads may be on one core.
                        std::thread::yield_now();
                    }
                }
            });
            let _ended = Ended(ended);
            work()
        });
    }
    work()
}

/// Does something with each item, in any order, at once where there are threads. Of items that fail, returns one's error.
#[cfg(feature = "ensemble")]
pub(crate) fn try_for_each<I: Send, E: Send>(
    items: alloc::vec::Vec<I>,
    work: impl Fn(I) -> Result<(), E> + Send + Sync,
) -> Result<(), E> {
    #[cfg(feature = "rayon")]
    if items.len() > 1 && threads() > 1 {
        use rayon::iter::{IntoParallelIterator, ParallelIterator};
        let asked = interrupt::current();
        return items
            .into_par_iter()
            .try_for_each(|item| interrupt::within(asked.as_ref(), || work(item)));
    }
    items.into_iter().try_for_each(work)
}

/// Returns what comes of each item, in their order, worked out at once where there are threads.
#[cfg(feature = "horizontal")]
pub(crate) fn map<I: Send, O: Send>(
    items: alloc::vec::Vec<I>,
    work: impl Fn(I) -> O + Send + Sync,
) -> alloc::vec::Vec<O> {
    #[cfg(feature = "rayon")]
    if items.len() > 1 && threads() > 1 {
        use rayon::iter::{IntoParallelIterator, ParallelIterator};
        let asked = interrupt::current();
        return items
            .into_par_iter()
            .map(|item| interrupt::within(asked.as_ref(), || work(item)))
            .collect();
    }
    items.into_iter().map(work).collect()
}
