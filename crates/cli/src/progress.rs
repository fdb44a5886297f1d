//! The progress line of a long command: on stderr, if it is a terminal, after the first second.

use std::io::{self, IsTerminal, Write};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// The delay before the line appears.
const DELAY: Duration = Duration::from_secs(1);

/// The time between two updates of the line.
const TICK: Duration = Duration::from_millis(100);

const OF_ROWS: &str =
    "{spinner} {msg} {bar:30} {percent}% of {human_len} rows, {per_sec}, {eta} left";
const OF_STACKINGS: &str =
    "{spinner} {msg} {bar:30} {percent}% of {human_len}, {per_sec}, {eta} left";
const OF_UNKNOWN_LENGTH: &str = "{spinner} {msg}, {elapsed}";

/// A progress line on stderr. Dropping this value removes the line.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// `None` if stderr is not a terminal.
    line: Option<DelayedLine>,
}

/// The thread that shows the line after the delay. Closing the channel ends the thread.
struct DelayedLine {
    ended: Sender<()>,
    thread: JoinHandle<()>,
}

impl Progress {
    /// Begins an action of unknown length. `doing` describes it: `computing the extreme forces`.
    pub(crate) fn begin(doing: &'static str) -> Self {
        Self::new(ProgressBar::no_length(), OF_UNKNOWN_LENGTH, doing)
    }

    /// Begins an action with this number of rows, if it is known.
    pub(crate) fn of_rows(doing: &'static str, rows: Option<u64>) -> Self {
        match rows {
            Some(rows) => Self::new(ProgressBar::new(rows), OF_ROWS, doing),
            None => Self::begin(doing),
        }
    }

    /// Begins an action on this number of stackings.
    pub(crate) fn of_stackings(doing: &'static str, stackings: u64) -> Self {
        Self::new(ProgressBar::new(stackings), OF_STACKINGS, doing)
    }

    fn new(bar: ProgressBar, template: &str, doing: &'static str) -> Self {
        bar.set_draw_target(ProgressDrawTarget::hidden());
        if !io::stderr().is_terminal() {
            return Self { bar, line: None };
        }
        // The templates above are valid. An invalid one would leave the default style.
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(doing);
        let (ended, wait) = mpsc::channel();
        let shown = bar.clone();
        let thread = thread::spawn(move || {
            if wait.recv_timeout(DELAY) == Err(RecvTimeoutError::Timeout) && !shown.is_finished() {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(TICK);
            }
        });
        let line = Some(DelayedLine { ended, thread });
        Self { bar, line }
    }

    /// Adds `count` rows or stackings to the progress.
    pub(crate) fn advance(&self, count: u64) {
        self.bar.inc(count);
    }

    /// Calls `content`, and counts its lines as rows. If stdout is a terminal, the line disappears at the first row.
    pub(crate) fn count<R>(
        &self,
        out: &mut dyn Write,
        to_stdout: bool,
        content: impl FnOnce(&mut dyn Write) -> R,
    ) -> R {
        if self.line.is_none() {
            return content(out);
        }
        content(&mut Counting {
            out,
            bar: &self.bar,
            shown: to_stdout && io::stdout().is_terminal(),
        })
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(DelayedLine { ended, thread }) = self.line.take() {
            drop(ended);
            // The thread never panics.
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}

/// A writer that counts lines.
struct Counting<'a> {
    out: &'a mut dyn Write,
    bar: &'a ProgressBar,
    /// True if the output appears on a terminal.
    shown: bool,
}

impl Write for Counting<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.shown {
            self.bar.finish_and_clear();
        }
        let written = self.out.write(bytes)?;
        let lines = bytes.iter().take(written).filter(|byte| **byte == b'\n');
        self.bar.inc(lines.count() as u64);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
