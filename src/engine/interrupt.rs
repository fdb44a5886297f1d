//! Cancellation of long work by another thread.

use crate::Error;

#[cfg(feature = "std")]
pub use with_threads::Interrupt;
#[cfg(feature = "rayon")]
pub(crate) use with_threads::{current, within};

/// Returns an error if the work of the current thread has been cancelled.
///
/// # Errors
/// [`Error::Interrupted`].
pub fn check() -> Result<(), Error> {
    #[cfg(feature = "std")]
    return Interrupt::check();
    #[cfg(not(feature = "std"))]
    Ok(())
}

#[cfg(feature = "std")]
mod with_threads {
    use alloc::sync::Arc;
    use core::cell::RefCell;
    use core::sync::atomic::{AtomicBool, Ordering};

    use crate::Error;

    std::thread_local! {
        static REQUEST: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
    }

    /// A request to cancel work, made by another thread: for Ctrl-C, a button, or a time limit.
    ///
    /// Work inside [`during`](Self::during) checks the request before each row, layer, contact or equation, in all its
    /// threads. It ends with [`Error::Interrupted`] within a fraction of a second. Without a request the results do not
    /// change. A result that is complete before the next check is still returned. If calls of `during` are nested, only
    /// the innermost request is checked.
    ///
    /// # Examples
    /// ```
    /// use std::thread;
    ///
    /// use cannonpile::lattice::Region;
    /// use cannonpile::stacking::Stacking;
    /// use cannonpile::{Error, Interrupt, Pile};
    ///
    /// // A thousand layers of long numbers: seconds of work.
    /// let pile = Pile::under(Region::hexagon(40, 40)?, Stacking::hcp(1000)?)?;
    /// let interrupt = Interrupt::new();
    /// let other = interrupt.clone();
    /// thread::spawn(move || other.request());
    /// assert_eq!(interrupt.during(|| pile.base_extremes()), Err(Error::Interrupted));
    /// # Ok::<(), Error>(())
    /// ```
    #[derive(Clone, Debug, Default)]
    pub struct Interrupt {
        requested: Arc<AtomicBool>,
    }

    impl Interrupt {
        /// Creates a request that has not been made yet. All clones share its state.
        ///
        /// # Examples
        /// ```
        /// use cannonpile::{Error, Interrupt, Pile};
        ///
        /// assert_eq!(Interrupt::new().during(|| Pile::triangular(10)).map(|pile| pile.layers()), Ok(10));
        /// ```
        #[must_use]
        pub fn new() -> Self {
            Self::default()
        }

        /// Makes the request. The work ends at its next check.
        ///
        /// # Examples
        /// ```
        /// use cannonpile::Interrupt;
        ///
        /// let interrupt = Interrupt::new();
        /// interrupt.clone().request();
        /// assert!(interrupt.is_requested());
        /// ```
        pub fn request(&self) {
            self.requested.store(true, Ordering::Relaxed);
        }

        /// Returns whether the request has been made.
        ///
        /// # Examples
        /// ```
        /// use cannonpile::Interrupt;
        ///
        /// assert!(!Interrupt::new().is_requested());
        /// ```
        #[must_use]
        pub fn is_requested(&self) -> bool {
            self.requested.load(Ordering::Relaxed)
        }

        /// Runs `work` on the current thread, and ends it soon after a request.
        ///
        /// # Errors
        /// [`Error::Interrupted`] for any error after a request. Otherwise the error of `work`.
        ///
        /// # Examples
        /// ```
        /// use cannonpile::{Error, Interrupt, Pile};
        ///
        /// let interrupt = Interrupt::new();
        /// interrupt.request();
        /// let refused = interrupt.during(|| Pile::triangular(0));
        /// assert_eq!(refused, Err(Error::Interrupted));
        /// ```
        pub fn during<T, E: From<Error>>(
            &self,
            work: impl FnOnce() -> Result<T, E>,
        ) -> Result<T, E> {
            let done = within(Some(&self.requested), work);
            done.map_err(|error| {
                if self.is_requested() {
                    E::from(Error::Interrupted)
                } else {
                    error
                }
            })
        }

        /// Returns an error if the work of the current thread has been cancelled. Call it in loops around this library.
        ///
        /// # Errors
        /// [`Error::Interrupted`].
        ///
        /// # Examples
        /// ```
        /// use cannonpile::{Error, Interrupt};
        ///
        /// let interrupt = Interrupt::new();
        /// interrupt.request();
        /// // The request applies only to work inside `during`.
        /// assert_eq!(Interrupt::check(), Ok(()));
        /// assert_eq!(interrupt.during(Interrupt::check), Err(Error::Interrupted));
        /// ```
        pub fn check() -> Result<(), Error> {
            let request = REQUEST.try_with(|request| {
                let request = request.borrow();
                request
                    .as_ref()
                    .is_some_and(|request| request.load(Ordering::Relaxed))
            });
            // The thread-local value is gone only while its thread ends, and such a thread does no work.
            match request {
                Ok(true) => Err(Error::Interrupted),
                _ => Ok(()),
            }
        }
    }

    /// Returns the request that the work of the current thread checks.
    #[cfg(feature = "rayon")]
    pub(crate) fn current() -> Option<Arc<AtomicBool>> {
        REQUEST
            .try_with(|request| request.borrow().clone())
            .ok()
            .flatten()
    }

    /// Runs `work` on the current thread with this request.
    pub(crate) fn within<T>(request: Option<&Arc<AtomicBool>>, work: impl FnOnce() -> T) -> T {
        /// Restores the previous request, also when the work panics.
        struct Before(Option<Arc<AtomicBool>>);
        impl Drop for Before {
            fn drop(&mut self) {
                let before = self.0.take();
                let _ = REQUEST.try_with(|request| request.replace(before));
            }
        }
        let before = REQUEST.try_with(|now| now.replace(request.cloned()));
        let _before = Before(before.ok().flatten());
        work()
    }
}
