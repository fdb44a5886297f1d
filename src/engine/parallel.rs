//! Parallel work with the feature `rayon`. Without the feature, the same functions process one item after the other.
//!
//! The engines use it for bands of rows of a sweep, for rows that are written into slices, and for halves of a table.

use core::ops::Range;

#[cfg(feature = "rayon")]
use super::interrupt;
use crate::Error;

/// Whether several threads are possible.
pub(crate) const HAS_THREADS: bool = cfg!(feature = "rayon");

/// Returns the number of threads available for work.
#[must_use]
pub fn threads() -> usize {
    #[cfg(feature = "rayon")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "rayon"))]
    1
}

/// Returns the first row of the second half of the work, and the number of spheres before it. Returns `None` if no row
/// is left for the second half.
///
/// The first half is for `threads / 2` of the `threads` threads. It has the fewest rows that contain this share of the
/// spheres.
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

/// Calls two functions, in parallel if there are threads, and returns both results.
fn join<A: Send, B: Send>(
    one: impl FnOnce() -> A + Send,
    other: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "rayon")]
    {
        let request = interrupt::current();
        rayon::join(
            || interrupt::within(request.as_ref(), one),
            || interrupt::within(request.as_ref(), other),
        )
    }
    #[cfg(not(feature = "rayon"))]
    (one(), other())
}

/// Calls two functions, in parallel if there are threads.
///
/// # Errors
/// The error of the first one, or else of the second one.
pub(crate) fn share(
    one: impl FnOnce() -> Result<(), Error> + Send,
    other: impl FnOnce() -> Result<(), Error> + Send,
) -> Result<(), Error> {
    let (first, second) = join(one, other);
    first.and(second)
}

/// Calls `work` with each item, in any order, in parallel if there are threads.
///
/// # Errors
/// The error of one of the items that failed.
pub fn try_for_each<I: Send, E: Send>(
    items: alloc::vec::Vec<I>,
    work: impl Fn(I) -> Result<(), E> + Send + Sync,
) -> Result<(), E> {
    #[cfg(feature = "rayon")]
    if items.len() > 1 && threads() > 1 {
        use rayon::iter::{IntoParallelIterator, ParallelIterator};
        let request = interrupt::current();
        return items
            .into_par_iter()
            .try_for_each(|item| interrupt::within(request.as_ref(), || work(item)));
    }
    items.into_iter().try_for_each(work)
}

/// Returns the result of `work` for each item, in the order of the items. Works in parallel if there are threads.
pub fn map<I: Send, O: Send>(
    items: alloc::vec::Vec<I>,
    work: impl Fn(I) -> O + Send + Sync,
) -> alloc::vec::Vec<O> {
    #[cfg(feature = "rayon")]
    if items.len() > 1 && threads() > 1 {
        use rayon::iter::{IntoParallelIterator, ParallelIterator};
        let request = interrupt::current();
        return items
            .into_par_iter()
            .map(|item| interrupt::within(request.as_ref(), || work(item)))
            .collect();
    }
    items.into_iter().map(work).collect()
}

#[cfg(feature = "rayon")]
#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::thread;

    use super::*;
    use crate::Interrupt;

    fn pool(threads: usize) -> rayon::ThreadPool {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap()
    }

    /// Returns start + … + (end − 1) by recursive halving.
    fn sum(numbers: core::ops::Range<u64>) -> u64 {
        let middle = numbers.start.midpoint(numbers.end);
        if middle == numbers.start {
            return middle;
        }
        let (mut lower, mut upper) = (0, 0);
        let shared = share(
            || {
                lower = sum(numbers.start..middle);
                Ok(())
            },
            || {
                upper = sum(middle..numbers.end);
                Ok(())
            },
        );
        assert_eq!(shared, Ok(()));
        lower + upper
    }

    /// Two items wait for each other, which never ends without parallel work.
    #[test]
    fn items_are_worked_on_at_once() {
        use std::sync::Barrier;
        let two = || alloc::vec![1, 2];
        let work = move || {
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
        };
        cannonpile_testkit::processes::within(move || pool(2).install(work));
    }

    #[test]
    fn shared_work_is_done_in_and_outside_of_pools() {
        for threads in [1, 2, 3] {
            let pool = pool(threads);
            assert_eq!(pool.install(|| sum(0..1000)), 499_500);
            // Two tasks in the same pool at once.
            let sums = pool.install(|| rayon::join(|| sum(0..1000), || sum(0..2000)));
            assert_eq!(sums, (499_500, 1_999_000));
        }
        // Several tasks from outside a pool at once.
        thread::scope(|scope| {
            let sums = [(); 4].map(|()| scope.spawn(|| sum(0..300)));
            assert!(sums.into_iter().all(|sum| sum.join().unwrap() == 44_850));
        });
    }

    #[test]
    fn errors_panics_and_requests_are_reported_from_both_halves() {
        let refused = || Err(Error::Interrupted);
        let check = super::super::interrupt::check;
        let check_both_halves = || {
            assert_eq!(share(refused, || Ok(())), refused());
            assert_eq!(share(|| Ok(()), refused), refused());
            let panics = || panic!("on purpose");
            let one = catch_unwind(AssertUnwindSafe(|| share(panics, || Ok(()))));
            let other = catch_unwind(AssertUnwindSafe(|| share(|| Ok(()), panics)));
            assert!(one.is_err() && other.is_err());
            let interrupt = Interrupt::new();
            interrupt.request();
            assert_eq!(interrupt.during(|| share(|| Ok(()), check)), refused());
            assert_eq!(interrupt.during(|| share(check, || Ok(()))), refused());
        };
        check_both_halves();
        pool(2).install(check_both_halves);
    }
}
