//! Progress reports for tables and files.

/// The number of rows between reports.
const ROWS: u64 = 4096;

/// A counter of rows that reports from time to time. The last report is made on drop.
pub(crate) struct Progress<O: FnMut(u64)> {
    observer: O,
    pending: u64,
}

impl<O: FnMut(u64)> Progress<O> {
    pub(crate) fn new(observer: O) -> Self {
        let pending = 0;
        Self { observer, pending }
    }

    /// Counts a row.
    pub(crate) fn row(&mut self) {
        self.pending += 1;
        if self.pending == ROWS {
            self.report();
        }
    }

    fn report(&mut self) {
        (self.observer)(self.pending);
        self.pending = 0;
    }
}

impl<O: FnMut(u64)> Drop for Progress<O> {
    fn drop(&mut self) {
        if self.pending > 0 {
            self.report();
        }
    }
}
