//! The progress of a long command on stderr: a line that changes if it is a terminal, otherwise a line each minute.

use std::io::{self, IsTerminal, Write};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use indicatif::{FormattedDuration, HumanCount, ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::output::print_message;

/// The delay before the line appears on a terminal.
const DELAY: Duration = Duration::from_secs(1);

/// The time between two lines if stderr is not a terminal.
const MINUTE: Duration = Duration::from_secs(60);

/// The time between two updates of the line.
const TICK: Duration = Duration::from_millis(100);

const OF_ROWS: &str =
    "{spinner} {msg} {bar:30} {percent}% of {human_len} rows, {per_sec}, {eta} left";
const OF_STACKINGS: &str =
    "{spinner} {msg} {bar:30} {percent}% of {human_len}, {per_sec}, {eta} left";
const OF_UNKNOWN_LENGTH: &str = "{spinner} {msg}, {elapsed}";

/// The progress on stderr. Dropping this value removes the line from a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// `None` if the system has no thread for it.
    reporter: Option<Reporter>,
}

/// The thread that reports the progress. Closing the channel ends the thread.
struct Reporter {
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
        // The templates above are valid. An invalid one would leave the default style.
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(doing);
        let (ended, wait) = mpsc::channel();
        let shown = bar.clone();
        let report = move || {
            if io::stderr().is_terminal() {
                show(&shown, &wait);
            } else {
                print_each_minute(doing, &shown, &wait);
            }
        };
        let thread = thread::Builder::new().spawn(report).ok();
        let reporter = thread.map(|thread| Reporter { ended, thread });
        Self { bar, reporter }
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
        content(&mut Counting {
            out,
            bar: &self.bar,
            shown: to_stdout && io::stdout().is_terminal(),
        })
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(Reporter { ended, thread }) = self.reporter.take() {
            drop(ended);
            // The thread never panics.
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}

/// Shows the line on a terminal, unless the action ends before the delay.
fn show(bar: &ProgressBar, ended: &Receiver<()>) {
    if ended.recv_timeout(DELAY) == Err(RecvTimeoutError::Timeout) && !bar.is_finished() {
        bar.set_draw_target(ProgressDrawTarget::stderr());
        bar.enable_steady_tick(TICK);
    }
}

/// Prints a line each minute until the action ends.
fn print_each_minute(doing: &str, bar: &ProgressBar, ended: &Receiver<()>) {
    while ended.recv_timeout(MINUTE) == Err(RecvTimeoutError::Timeout) {
        print_message(&line(doing, bar.position(), bar.length(), bar.elapsed()));
    }
}

/// Returns the line about an action that has done this much of `all`, if it is known, in this time.
fn line(doing: &str, done: u64, all: Option<u64>, elapsed: Duration) -> String {
    let far = match all {
        Some(all) if all > 0 => {
            let percent = u128::from(done) * 100 / u128::from(all);
            let (done, all) = (HumanCount(done), HumanCount(all));
            format!(": {done} of {all} ({percent}%)")
        }
        _ if done > 0 => format!(": {}", HumanCount(done)),
        _ => String::new(),
    };
    format!("note: {doing}{far}, after {}", FormattedDuration(elapsed))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_says_what_is_done_how_far_and_since_when() {
        let minutes = |n: u64| Duration::from_secs(60 * n);
        for (done, all, elapsed, expected) in [
            (
                1_234_567,
                Some(33_554_432),
                minutes(1),
                "note: analysing: 1,234,567 of 33,554,432 (3%), after 00:01:00",
            ),
            (
                u64::MAX,
                Some(u64::MAX),
                minutes(90),
                "note: analysing: 18,446,744,073,709,551,615 of 18,446,744,073,709,551,615 (100%), after 01:30:00",
            ),
            (7, None, minutes(2), "note: analysing: 7, after 00:02:00"),
            (0, None, minutes(3), "note: analysing, after 00:03:00"),
            (0, Some(0), minutes(3), "note: analysing, after 00:03:00"),
        ] {
            assert_eq!(line("analysing", done, all, elapsed), expected);
        }
    }
}
