//! The progress of a long command on stderr: a line that changes if it is a terminal, otherwise a line each minute.

use std::io::{self, IsTerminal, Write};
use std::sync::Mutex;
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{FormattedDuration, HumanCount, ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::output::print_message;

const SECOND: Duration = Duration::from_secs(1);

/// The seconds between two lines if stderr is not a terminal.
const MINUTE: u32 = 60;

/// The time between two updates of the line.
const TICK: Duration = Duration::from_millis(100);

const OF_ROWS: &str =
    "{spinner} {msg} {bar:30} {percent}% of {human_len} rows, {per_sec}, {eta} left";
const OF_STACKINGS: &str =
    "{spinner} {msg} {bar:30} {percent}% of {human_len}, {per_sec}, {eta} left";
const OF_UNKNOWN_LENGTH: &str = "{spinner} {msg}, {elapsed}";

/// The action of the command, for the thread of [`watch`].
static NOW: Mutex<Now> = Mutex::new(Now {
    action: None,
    quiet: 0,
});

struct Now {
    /// The named action, and how far it is. `None` between such actions.
    action: Option<(&'static str, ProgressBar)>,
    /// The seconds since the last line.
    quiet: u32,
}

/// Starts the thread that reports the progress of this command. Without a thread, nothing is reported.
pub(crate) fn watch() {
    // Some terminals cannot show a line that changes, such as those with TERM=dumb.
    let (began, is_terminal) = (Instant::now(), !ProgressDrawTarget::stderr().is_hidden());
    let report = move || {
        loop {
            thread::sleep(SECOND);
            let Ok(mut now) = NOW.lock() else { return };
            let line = now.after_a_second(is_terminal, began.elapsed());
            // The command does not wait for a slow reader of stderr.
            drop(now);
            if let Some(line) = line {
                print_message(&line);
            }
        }
    };
    let _ = thread::Builder::new().spawn(report);
}

impl Now {
    /// Shows a named action on a terminal. In all other cases returns a line if the last one was a minute ago.
    fn after_a_second(&mut self, is_terminal: bool, elapsed: Duration) -> Option<String> {
        if is_terminal && let Some((_, bar)) = &self.action {
            if bar.is_hidden() && !bar.is_finished() {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(TICK);
            }
            self.quiet = 0;
            return None;
        }
        self.quiet = (self.quiet + 1) % MINUTE;
        (self.quiet == 0).then(|| match &self.action {
            Some((doing, bar)) => line(doing, bar.position(), bar.length(), elapsed),
            None => line("working", 0, None, elapsed),
        })
    }
}

/// A named action of this command. Dropping this value removes its line from a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    /// The action that this one interrupts.
    outer: Option<(&'static str, ProgressBar)>,
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
        let action = (doing, bar.clone());
        let outer = NOW
            .lock()
            .ok()
            .and_then(|mut now| now.action.replace(action));
        Self { bar, outer }
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
        if let Ok(mut now) = NOW.lock() {
            now.action = self.outer.take();
        }
        self.bar.finish_and_clear();
    }
}

/// Returns the line about an action that has done `done` of `all`, if `all` is known. `elapsed` is the time since the
/// command began.
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

    #[test]
    fn an_action_is_named_again_after_a_shorter_one() {
        // No other test of this crate begins an action.
        let doing = || NOW.lock().unwrap().action.as_ref().map(|(doing, _)| *doing);
        let outer = Progress::begin("checking");
        let inner = Progress::of_rows("reading", Some(3));
        assert_eq!(doing(), Some("reading"));
        drop(inner);
        assert_eq!(doing(), Some("checking"));
        drop(outer);
        assert_eq!(doing(), None);
    }

    #[test]
    fn a_line_is_printed_each_minute_also_outside_of_named_actions() {
        let bar = ProgressBar::new(9);
        bar.set_draw_target(ProgressDrawTarget::hidden());
        bar.inc(7);
        let mut now = Now {
            action: None,
            quiet: 0,
        };
        let mut lines = Vec::new();
        for second in 1..=200 {
            // The named action begins and ends between two lines.
            now.action = (70..130)
                .contains(&second)
                .then(|| ("reading", bar.clone()));
            let line = now.after_a_second(false, Duration::from_secs(second));
            lines.extend(line.map(|line| (second, line)));
        }
        let expected = [
            (60, "note: working, after 00:01:00"),
            (120, "note: reading: 7 of 9 (77%), after 00:02:00"),
            (180, "note: working, after 00:03:00"),
        ];
        assert_eq!(
            lines,
            expected.map(|(second, line)| (second, line.to_owned()))
        );
    }
}
