//! Work on all cores, with the feature `rayon`; one after the other without it.

#[cfg(feature = "rayon")]
use super::interrupt;

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

/// Does something while a thread stands by for what is shared out meanwhile ([`join`]): a thread that sleeps is woken in as
/// long as a layer takes.
///
/// It ends when the work does, or what that thread took on for others. It is the first that another thread takes of what this
/// one shares out: so none that waits for its own share comes to stand by for itself.
pub(crate) fn with_one_standing_by<A>(work: impl FnOnce() -> A) -> A {
    #[cfg(feature = "rayon")]
    if threads() > 1 {
        use core::sync::atomic::{AtomicBool, Ordering};
        /// Set when the work ends, in whatever way.
        struct Ended<'e>(&'e AtomicBool);
        impl Drop for Ended<'_> {
            fn drop(&mut self) {
                self.0.store(true, Ordering::Release);
            }
        }
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
