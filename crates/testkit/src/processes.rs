//! Child processes of tests, whose waits all end, and the parts of tests that need a program that is missing.

use std::env;
use std::fs::OpenOptions;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Output};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

/// The longest wait for a child process. It only ends tests that hang: a loaded machine needs far less.
pub const LONGEST_WAIT: Duration = Duration::from_secs(300);

/// A child process. Dropping this value kills the process, so a failed test leaves none.
pub struct Process(Child);

impl Process {
    /// Starts a command. Its input, output and errors are those that `command` sets.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        command.spawn().map(Self)
    }

    /// The number of the process.
    pub fn id(&self) -> u32 {
        self.0.id()
    }

    /// The pipe to the standard input of the process. It can be taken once.
    pub fn stdin(&mut self) -> ChildStdin {
        self.0.stdin.take().expect("a pipe to stdin")
    }

    /// The pipe from the standard output of the process. It can be taken once.
    pub fn stdout(&mut self) -> ChildStdout {
        self.0.stdout.take().expect("a pipe from stdout")
    }

    /// The exit status, if the process has ended.
    pub fn status(&mut self) -> Option<ExitStatus> {
        self.0.try_wait().expect("the status of a child")
    }

    /// Waits until the process has ended, and returns what it wrote to its pipes. Panics after [`LONGEST_WAIT`].
    pub fn output(mut self) -> Output {
        drop(self.0.stdin.take());
        let stdout = in_background(self.0.stdout.take());
        let stderr = in_background(self.0.stderr.take());
        let (stdout, stderr) = (stdout(), stderr());
        let start = Instant::now();
        let status = loop {
            if let Some(status) = self.status() {
                break status;
            }
            assert!(
                start.elapsed() < LONGEST_WAIT,
                "process {} does not end",
                self.id()
            );
            thread::sleep(Duration::from_millis(1));
        };
        Output {
            status,
            stdout,
            stderr,
        }
    }

    /// Sends `input` to the process from another thread, and returns its [`output`](Self::output). The process may end
    /// before it has read everything.
    pub fn output_of(mut self, input: impl FnOnce(ChildStdin) + Send + 'static) -> Output {
        let stdin = self.stdin();
        thread::spawn(move || input(stdin));
        self.output()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Reads a pipe, if there is one, in another thread. The returned function waits for all bytes.
fn in_background(pipe: Option<impl Read + Send + 'static>) -> impl FnOnce() -> Vec<u8> {
    waiting(move || {
        let mut bytes = Vec::new();
        if let Some(mut pipe) = pipe {
            pipe.read_to_end(&mut bytes).expect("a pipe is read");
        }
        bytes
    })
}

/// Calls `work` in another thread and returns its result. Panics after [`LONGEST_WAIT`].
pub fn within<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    waiting(work)()
}

fn waiting<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> impl FnOnce() -> T {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || sender.send(work()));
    move || {
        let result = receiver.recv_timeout(LONGEST_WAIT);
        result.unwrap_or_else(|error| panic!("work in another thread did not end well: {error}"))
    }
}

/// Reports in one line what a test leaves out, and why. The caller passes afterwards.
///
/// The line appears on stderr, and is added to `left-out.txt` in the target folder. `.ci/door` expects this file to be
/// absent where every program is installed.
pub fn left_out(what: &str) {
    let line = format!("left out: {what}\n");
    // `eprint!` would be captured by the test runner.
    let _ = io::stderr().write_all(line.as_bytes());
    // A file that cannot be written is no reason to fail.
    if let Some(folder) = target_folder() {
        let path = folder.join("left-out.txt");
        let file = OpenOptions::new().create(true).append(true).open(path);
        let _ = file.and_then(|mut file| file.write_all(line.as_bytes()));
    }
}

/// The target folder, in which cargo built this test.
fn target_folder() -> Option<PathBuf> {
    let program = env::current_exe().ok()?;
    let is_target = |folder: &&Path| folder.join("CACHEDIR.TAG").exists();
    program.ancestors().find(is_target).map(Path::to_owned)
}
