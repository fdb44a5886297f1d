//! Long work that another thread can end.

use crate::Error;

#[cfg(feature = "std")]
pub use with_threads::Interrupt;
#[cfg(feature = "rayon")]
pub(crate) use with_threads::{current, within};

/// Errors if an end of what this thread does was asked for.
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
        static ASKED: RefCell<Option<Arc<AtomicBool>>> = const { RefCell::new(None) };
    }

    /// A request to end work, made by another thread: for Ctrl-C, a button, a time limit.
    ///
    /// What is done [`during`](Self::during) it looks at the request before each row, layer, contact or equation, in all its
    /// threads, and ends with [`Error::Interrupted`] within a fraction of a second. Without a request nothing is another than
    /// it would be; with one an answer that was found meanwhile is still an answer. Of requests within each other the inner
    /// one counts.
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
        /// A request that was not made yet; its clones are the same one.
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

        /// Asks the work to end.
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

        /// Returns whether the work was asked to end.
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

        /// Does work on this thread that ends soon after a request.
        ///
        /// # Errors
        /// [`Error::Interrupted`] for whatever fails after a request; else those of `work`.
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

        /// Errors if the work that this thread is doing was asked to end: for loops of one's own around this library's.
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
        /// // It is of what is done during it, and of nothing else.
        /// assert_eq!(Interrupt::check(), Ok(()));
        /// assert_eq!(interrupt.during(Interrupt::check), Err(Error::Interrupted));
        /// ```
        pub fn check() -> Result<(), Error> {
            let asked = ASKED.try_with(|asked| {
                let asked = asked.borrow();
                asked
                    .as_ref()
                    .is_some_and(|asked| asked.load(Ordering::Relaxed))
            });
            // A thread that is ending does nothing for anybody.
            match asked {
                Ok(true) => Err(Error::Interrupted),
                _ => Ok(()),
            }
        }
    }

    /// What ends the work of this thread.
    #[cfg(feature = "rayon")]
    pub(crate) fn current() -> Option<Arc<AtomicBool>> {
        ASKED
            .try_with(|asked| asked.borrow().clone())
            .ok()
            .flatten()
    }

    /// Does work that this ends, on this thread.
    pub(crate) fn within<T>(asked: Option<&Arc<AtomicBool>>, work: impl FnOnce() -> T) -> T {
        /// Puts back what was there, also when the work panics.
        struct Before(Option<Arc<AtomicBool>>);
        impl Drop for Before {
            fn drop(&mut self) {
                let before = self.0.take();
                let _ = ASKED.try_with(|asked| asked.replace(before));
            }
        }
        let before = ASKED.try_with(|now| now.replace(asked.cloned()));
        let _before = Before(before.ok().flatten());
        work()
    }
}
