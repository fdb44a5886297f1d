//! Work on all cores, with the feature `rayon`; one after the other without it.

use core::ops::Range;

#[cfg(feature = "rayon")]
use super::interrupt;
use crate::Error;

/// Whether there may be several.
pub(crate) const HAS_THREADS: bool = cfg!(feature = "rayon");

/// How many threads there are to work on.
#[must_use]
pub fn threads() -> usize {
    #[cfg(feature = "rayon")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "rayon"))]
    1
}

/// Returns before which row those rows end that are for the first half of so many threads: where they have their share of the
/// spheres, or just more; and how many spheres that is. `None` if it were all rows.
pub(crate) fn cut(
    mut rows: Range<i128>,
    threads: i128,
    spheres: impl Fn(i128) -> i128,
) -> Option<(i128, i128)> {
    let all: i128 = rows.clone().map(&spheres).sum();
    let mut before = spheres(rows.next()?);
    let border = rows.find(|row| {
        let is_border = before * threads >= all * (threads / 2);
        if !is_border {
            before += spheres(*row);
        }
        is_border
    });
    border.map(|border| (border, before))
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

/// Does two things, at once where there are threads: one of them on this thread, also if it is none of the pool's, so that it
/// need not be woken when the other ends.
///
/// # Errors
/// Those of both.
pub(crate) fn share(
    one: impl FnOnce() -> Result<(), Error> + Send,
    other: impl FnOnce() -> Result<(), Error> + Send,
) -> Result<(), Error> {
    #[cfg(feature = "rayon")]
    if rayon::current_thread_index().is_none() {
        return standing_by::share_from_outside(one, other);
    }
    let (ones, others) = join(one, other);
    ones.and(others)
}

/// Does something while a thread of the pool looks out for what is shared meanwhile ([`share`]): one that sleeps is woken in as
/// long as a layer takes.
pub(crate) fn with_one_standing_by<A>(work: impl FnOnce() -> A) -> A {
    #[cfg(feature = "rayon")]
    if threads() > 1 {
        return standing_by::during(work);
    }
    work()
}

#[cfg(feature = "rayon")]
mod standing_by {
    use alloc::sync::Arc;
    use core::cell::Cell;
    use core::sync::atomic::{AtomicBool, Ordering};
    use std::thread::yield_now;

    use crate::Error;
    use crate::engine::interrupt;
    use crate::error::bug;

    std::thread_local! {
        /// Whether this thread stands by, or works while another does: then it does not stand by for others as well, who would
        /// keep it from what it waits for.
        static IS_ENGAGED: Cell<bool> = const { Cell::new(false) };
    }

    /// How often a thread looks for the end of what it shared, about a microsecond each time, before it sleeps.
    const PATIENCE: usize = 200;

    /// Set when what it is made for ends, in whatever way.
    pub(super) struct Ends<'e>(pub(super) &'e AtomicBool);

    impl Drop for Ends<'_> {
        fn drop(&mut self) {
            self.0.store(true, Ordering::Release);
        }
    }

    /// Whether this thread was engaged before; it is, until this is dropped.
    struct Engaged(bool);

    impl Engaged {
        fn new() -> Self {
            Self(IS_ENGAGED.replace(true))
        }
    }

    impl Drop for Engaged {
        fn drop(&mut self) {
            IS_ENGAGED.set(self.0);
        }
    }

    /// Does something while another thread stands by. Nobody waits for that thread, which may have taken on other work, or have
    /// had no time at all.
    pub(super) fn during<A>(work: impl FnOnce() -> A) -> A {
        let _engaged = Engaged::new();
        let ended = Arc::new(AtomicBool::new(false));
        let _ends = Ends(&ended);
        let ended = Arc::clone(&ended);
        rayon::spawn(move || stand_by(&ended));
        work()
    }

    pub(super) fn stand_by(ended: &AtomicBool) {
        let engaged = Engaged::new();
        if engaged.0 {
            return;
        }
        while !ended.load(Ordering::Acquire) {
            if rayon::yield_now() != Some(rayon::Yield::Executed) {
                // Both threads may be on one core.
                yield_now();
            }
        }
    }

    /// Does one thing on this thread, which is none of the pool's, and the other on one that is.
    pub(super) fn share_from_outside(
        one: impl FnOnce() -> Result<(), Error>,
        other: impl FnOnce() -> Result<(), Error> + Send,
    ) -> Result<(), Error> {
        let asked = interrupt::current();
        let ended = &AtomicBool::new(false);
        let mut others = None;
        let to_others = &mut others;
        let ones = rayon::in_place_scope(|scope| {
            scope.spawn(|_| {
                let _ends = Ends(ended);
                *to_others = Some(interrupt::within(asked.as_ref(), other));
            });
            let ones = one();
            // It ends soon, if it was begun as soon: this thread would not be woken as soon.
            let mut looks = 0..PATIENCE;
            while looks.next().is_some() && !ended.load(Ordering::Acquire) {
                yield_now();
            }
            ones
        });
        match others {
            Some(others) => ones.and(others),
            None => Err(bug("a scope ends when all of it is done")),
        }
    }
}

/// Does something with each item, in any order, at once where there are threads. Of items that fail, returns one's error.
pub fn try_for_each<I: Send, E: Send>(
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
pub fn map<I: Send, O: Send>(
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

#[cfg(feature = "rayon")]
#[cfg(test)]
mod tests {
    use core::sync::atomic::AtomicBool;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::thread;

    use super::*;
    use crate::Interrupt;

    fn pool(threads: usize) -> rayon::ThreadPool {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap()
    }

    /// 1 + 2 + … + n, by halves of halves, each with somebody standing by.
    fn sum(numbers: core::ops::Range<u64>) -> u64 {
        let middle = numbers.start.midpoint(numbers.end);
        if middle == numbers.start {
            return middle;
        }
        let (mut lower, mut upper) = (0, 0);
        let shared = with_one_standing_by(|| {
            share(
                || {
                    lower = sum(numbers.start..middle);
                    Ok(())
                },
                || {
                    upper = sum(middle..numbers.end);
                    Ok(())
                },
            )
        });
        assert_eq!(shared, Ok(()));
        lower + upper
    }

    /// Two things that wait for each other, which would never end one after the other.
    #[test]
    fn items_are_worked_on_at_once() {
        use std::sync::Barrier;
        let two = || alloc::vec![1, 2];
        pool(2).install(|| {
            assert_eq!(threads(), 2);
            let barrier = Barrier::new(2);
            let twice = map(two(), |n| {
                barrier.wait();
                2 * n
            });
            assert_eq!(twice, [2, 4]);
            let waited = try_for_each(two(), |_| {
                barrier.wait();
                Ok::<(), ()>(())
            });
            assert_eq!(waited, Ok(()));
        });
    }

    /// Nobody knows when a thread comes to stand by: it may be too late.
    #[test]
    fn nothing_stands_by_for_what_has_ended() {
        standing_by::stand_by(&AtomicBool::new(true));
    }

    #[test]
    fn what_is_shared_is_done_in_and_outside_of_pools() {
        for threads in [1, 2, 3] {
            let pool = pool(threads);
            assert_eq!(pool.install(|| sum(0..1000)), 499_500);
            // Others in the same pool at once.
            let sums = pool.install(|| rayon::join(|| sum(0..1000), || sum(0..2000)));
            assert_eq!(sums, (499_500, 1_999_000));
        }
        // Others from outside at once.
        thread::scope(|scope| {
            let sums = [(); 4].map(|()| scope.spawn(|| sum(0..300)));
            assert!(sums.into_iter().all(|sum| sum.join().unwrap() == 44_850));
        });
    }

    /// Else a thread would stand by for ever.
    #[test]
    fn ends_are_seen_however_work_ends() {
        let (ended, unwound) = (AtomicBool::new(false), AtomicBool::new(false));
        drop(standing_by::Ends(&ended));
        let panicked = catch_unwind(|| {
            let _ends = standing_by::Ends(&unwound);
            panic!("on purpose");
        });
        assert!(panicked.is_err() && ended.into_inner() && unwound.into_inner());
    }

    #[test]
    fn errors_panics_and_requests_are_heard_in_both_halves() {
        let refused = || Err(Error::Interrupted);
        let check = super::super::interrupt::check;
        let heard = || {
            assert_eq!(share(refused, || Ok(())), refused());
            assert_eq!(share(|| Ok(()), refused), refused());
            let panics = || panic!("on purpose");
            let one = catch_unwind(AssertUnwindSafe(|| share(panics, || Ok(()))));
            let other = catch_unwind(AssertUnwindSafe(|| share(|| Ok(()), panics)));
            assert!(one.is_err() && other.is_err());
            let whole = catch_unwind(|| with_one_standing_by(|| panic!("on purpose")));
            assert!(whole.is_err());
            let interrupt = Interrupt::new();
            interrupt.request();
            assert_eq!(interrupt.during(|| share(|| Ok(()), check)), refused());
            assert_eq!(interrupt.during(|| share(check, || Ok(()))), refused());
        };
        heard();
        pool(2).install(heard);
    }
}
