//! Telling how far a file has come.

/// How many rows are done before the next call.
const ROWS: u64 = 4096;

/// Counts rows, and tells of them from time to time, of the last when it is dropped.
pub(super) struct Progress<'o> {
    observer: &'o mut dyn FnMut(u64),
    untold: u64,
}

impl<'o> Progress<'o> {
    pub(super) fn of(observer: &'o mut dyn FnMut(u64)) -> Self {
        Self {
            observer,
            untold: 0,
        }
    }

    /// A row more is done.
    pub(super) fn row(&mut self) {
        self.untold += 1;
        if self.untold == ROWS {
            self.tell();
        }
    }

    fn tell(&mut self) {
        (self.observer)(self.untold);
        self.untold = 0;
    }
}

impl Drop for Progress<'_> {
    fn drop(&mut self) {
        if self.untold > 0 {
            self.tell();
        }
    }
}
