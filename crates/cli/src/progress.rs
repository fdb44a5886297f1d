//! How far a long command has come: a line on stderr, if that is a terminal, from the first second on.

use std::io::{self, IsTerminal, Write};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// What is done in less is not spoken of.
const SHORT: Duration = Duration::from_secs(1);

/// How often the line is drawn.
const TICK: Duration = Duration::from_millis(100);

const OF_ROWS: &str =
    "{spinner} {msg} {bar:30} {percent}% of {human_len} rows, {per_sec}, {eta} left";
const OF_STACKINGS: &str =
    "{spinner} {msg} {bar:30} {percent}% of {human_len}, {per_sec}, {eta} left";
const WITHOUT_END: &str = "{spinner} {msg}, {elapsed}";

/// A line on stderr that goes away when this is dropped.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// None if there is no terminal.
    late: Option<Late>,
}

/// What shows the line after a while: a thread, and a channel whose end ends it.
struct Late {
    ended: Sender<()>,
    thread: JoinHandle<()>,
}

impl Progress {
    /// Begins something of unknown length; `doing` says what, as in `finding the extreme forces`.
    pub(crate) fn begin(doing: &'static str) -> Self {
        Self::new(ProgressBar::no_length(), WITHOUT_END, doing)
    }

    /// Begins something that takes so many rows, as far as that is known.
    pub(crate) fn of_rows(doing: &'static str, rows: Option<u64>) -> Self {
        match rows {
            Some(rows) => Self::new(ProgressBar::new(rows), OF_ROWS, doing),
            None => Self::begin(doing),
        }
    }

    /// Begins something that goes through so many stackings.
    pub(crate) fn of_stackings(doing: &'static str, stackings: u64) -> Self {
        Self::new(ProgressBar::new(stackings), OF_STACKINGS, doing)
    }

    fn new(bar: ProgressBar, template: &str, doing: &'static str) -> Self {
        bar.set_draw_target(ProgressDrawTarget::hidden());
        if !io::stderr().is_terminal() {
            return Self { bar, late: None };
        }
        // The templates are ours; without one there is still a bar.
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(doing);
        let (ended, wait) = mpsc::channel();
        let shown = bar.clone();
        let thread = thread::spawn(move || {
            if wait.recv_timeout(SHORT) == Err(RecvTimeoutError::Timeout) && !shown.is_finished() {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(TICK);
            }
        });
        let late = Some(Late { ended, thread });
        Self { bar, late }
    }

    /// Notes that so many rows more are done.
    pub(crate) fn advance(&self, rows: u64) {
        self.bar.inc(rows);
    }

    /// Writes what `content` writes, and counts its lines as rows; to a terminal the rows themselves show how far it is.
    pub(crate) fn count<R>(
        &self,
        out: &mut dyn Write,
        to_stdout: bool,
        content: impl FnOnce(&mut dyn Write) -> R,
    ) -> R {
        if self.late.is_none() {
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
        if let Some(Late { ended, thread }) = self.late.take() {
            drop(ended);
            // It does nothing that could fail.
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}

/// A writer that counts lines.
struct Counting<'a> {
    out: &'a mut dyn Write,
    bar: &'a ProgressBar,
    /// Whether the lines are seen as they are written.
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
