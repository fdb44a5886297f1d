//! The progress of a long command on stderr: a line that changes if it is a terminal, otherwise a line each minute.

use std::env;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use crate::output::print_message;

const SECOND: Duration = Duration::from_secs(1);

/// The seconds between two lines if stderr is not a terminal.
const MINUTE: u32 = 60;

/// Returns to the first column, and erases the line of a terminal.
const ERASE: &str = "\r\x1b[K";

/// The action of the command, for the thread of [`watch`].
static NOW: Mutex<Now> = Mutex::new(Now {
    action: None,
    quiet: 0,
    is_drawn: false,
});

struct Now {
    /// The named action. `None` between such actions.
    action: Option<Arc<Action>>,
    /// The seconds since the last line.
    quiet: u32,
    /// True if a terminal shows a line about the action.
    is_drawn: bool,
}

/// A named action, and how far it is.
struct Action {
    doing: &'static str,
    began: Instant,
    done: AtomicU64,
    all: Option<u64>,
    /// True if the output of the action has taken the place of its line.
    is_hidden: AtomicBool,
}

/// Starts the thread that reports the progress of this command. Without a thread, nothing is reported.
pub(crate) fn watch() {
    // Some terminals cannot show a line that changes, such as those with TERM=dumb.
    let can_erase = env::var_os("TERM").is_some_and(|kind| kind != "dumb");
    let (began, is_terminal) = (Instant::now(), can_erase && io::stderr().is_terminal());
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
        if is_terminal && let Some(action) = &self.action {
            if !action.is_hidden.load(Ordering::Relaxed) {
                let line = action.line(action.began.elapsed());
                let left = action.left();
                // A line that is too long for the terminal is cut off, not wrapped.
                let _ = write!(io::stderr(), "\x1b[?7l{ERASE}{line}{left}\x1b[?7h");
                self.is_drawn = true;
            }
            self.quiet = 0;
            return None;
        }
        self.quiet = (self.quiet + 1) % MINUTE;
        (self.quiet == 0).then(|| match &self.action {
            Some(action) => format!("note: {}", action.line(elapsed)),
            None => format!("note: working, after {}", clock(elapsed)),
        })
    }

    /// Removes the line from a terminal.
    fn erase(&mut self) {
        if core::mem::take(&mut self.is_drawn) {
            let _ = write!(io::stderr(), "{ERASE}");
        }
    }
}

/// A named action of this command. Dropping this value removes its line from a terminal.
pub(crate) struct Progress {
    action: Arc<Action>,
    /// The action that this one interrupts.
    outer: Option<Arc<Action>>,
}

impl Progress {
    /// Begins an action of unknown length. `doing` describes it: `computing the extreme forces`.
    pub(crate) fn begin(doing: &'static str) -> Self {
        Self::of_rows(doing, None)
    }

    /// Begins an action with this number of rows or stackings, if it is known.
    pub(crate) fn of_rows(doing: &'static str, all: Option<u64>) -> Self {
        let action = Arc::new(Action {
            doing,
            began: Instant::now(),
            done: AtomicU64::new(0),
            all,
            is_hidden: AtomicBool::new(false),
        });
        let now = NOW.lock().ok();
        let outer = now.and_then(|mut now| now.action.replace(action.clone()));
        Self { action, outer }
    }

    /// Adds `count` rows or stackings to the progress.
    pub(crate) fn advance(&self, count: u64) {
        self.action.done.fetch_add(count, Ordering::Relaxed);
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
            progress: self,
            shown: to_stdout && io::stdout().is_terminal(),
        })
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Ok(mut now) = NOW.lock() {
            now.action = self.outer.take();
            now.erase();
        }
    }
}

impl Action {
    /// Returns what is done, how far it is, and the time since it or the command began.
    fn line(&self, elapsed: Duration) -> String {
        let (doing, done) = (self.doing, self.done.load(Ordering::Relaxed));
        let far = match self.all {
            Some(all) if all > 0 => {
                let percent = u128::from(done) * 100 / u128::from(all);
                format!(": {} of {} ({percent}%)", grouped(&done), grouped(&all))
            }
            _ if done > 0 => format!(": {}", grouped(&done)),
            _ => String::new(),
        };
        format!("{doing}{far}, after {}", clock(elapsed))
    }

    /// Returns the time that is left if the speed stays the same.
    fn left(&self) -> String {
        let done = self.done.load(Ordering::Relaxed);
        let left = self.all.and_then(|all| all.checked_sub(done));
        let seconds = left.and_then(|left| {
            let left = u128::from(self.began.elapsed().as_secs()) * u128::from(left);
            u64::try_from(left.checked_div(done.into())?).ok()
        });
        seconds.map_or_else(String::new, |seconds| {
            format!(", {} left", clock(Duration::from_secs(seconds)))
        })
    }
}

/// Returns an integer with commas between its thousands.
pub(crate) fn grouped(n: &impl ToString) -> String {
    let digits = n.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    let groups: Vec<_> = groups.map(String::from_utf8_lossy).collect();
    groups.join(",")
}

/// Returns hours, minutes and seconds.
fn clock(time: Duration) -> String {
    let (minutes, seconds) = (time.as_secs() / 60, time.as_secs() % 60);
    format!("{:02}:{:02}:{seconds:02}", minutes / 60, minutes % 60)
}

/// A writer that counts lines.
struct Counting<'a> {
    out: &'a mut dyn Write,
    progress: &'a Progress,
    /// True if the output appears on a terminal.
    shown: bool,
}

impl Write for Counting<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let is_hidden = &self.progress.action.is_hidden;
        if self.shown
            && !is_hidden.swap(true, Ordering::Relaxed)
            && let Ok(mut now) = NOW.lock()
        {
            now.erase();
        }
        let written = self.out.write(bytes)?;
        let lines = bytes.iter().take(written).filter(|byte| **byte == b'\n');
        self.progress.advance(lines.count() as u64);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn action(done: u64, all: Option<u64>) -> Action {
        Action {
            doing: "analysing",
            began: Instant::now(),
            done: AtomicU64::new(done),
            all,
            is_hidden: AtomicBool::new(false),
        }
    }

    #[test]
    fn line_says_what_is_done_how_far_and_since_when() {
        let minutes = |n: u64| Duration::from_secs(60 * n);
        for (done, all, elapsed, expected) in [
            (
                1_234_567,
                Some(33_554_432),
                minutes(1),
                "analysing: 1,234,567 of 33,554,432 (3%), after 00:01:00",
            ),
            (
                u64::MAX,
                Some(u64::MAX),
                minutes(90),
                "analysing: 18,446,744,073,709,551,615 of 18,446,744,073,709,551,615 (100%), after 01:30:00",
            ),
            (7, None, minutes(2), "analysing: 7, after 00:02:00"),
            (0, None, minutes(3), "analysing, after 00:03:00"),
            (0, Some(0), minutes(3), "analysing, after 00:03:00"),
        ] {
            assert_eq!(action(done, all).line(elapsed), expected);
        }
    }

    #[test]
    fn remaining_time_is_in_proportion_to_the_rest() {
        let mut action = action(30, Some(120));
        action.began -= Duration::from_secs(1000);
        assert_eq!(action.left(), ", 00:50:00 left");
        for (done, all) in [(0, Some(9)), (7, None), (9, Some(7))] {
            action = Action {
                done: AtomicU64::new(done),
                all,
                ..action
            };
            assert_eq!(action.left(), "");
        }
    }

    #[test]
    fn an_action_is_named_again_after_a_shorter_one() {
        // No other test of this crate begins an action.
        let doing = || {
            NOW.lock()
                .unwrap()
                .action
                .as_ref()
                .map(|action| action.doing)
        };
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
        let named = Arc::new(action(7, Some(9)));
        let mut now = Now {
            action: None,
            quiet: 0,
            is_drawn: false,
        };
        let mut lines = Vec::new();
        for second in 1..=200 {
            // The named action begins and ends between two lines.
            now.action = (70..130).contains(&second).then(|| named.clone());
            let line = now.after_a_second(false, Duration::from_secs(second));
            lines.extend(line.map(|line| (second, line)));
        }
        let expected = [
            (60, "note: working, after 00:01:00"),
            (120, "note: analysing: 7 of 9 (77%), after 00:02:00"),
            (180, "note: working, after 00:03:00"),
        ];
        assert_eq!(
            lines,
            expected.map(|(second, line)| (second, line.to_owned()))
        );
    }
}
