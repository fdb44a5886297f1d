//! Work of the library: the interpreter is free meanwhile, and Ctrl-C ends it.

use std::io;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use cannonpile::{Error, Interrupt};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::exception::Raised;

/// How often signals are looked at.
const TICK: Duration = Duration::from_millis(50);

/// Does what is known to take no time.
pub(crate) fn quickly<T, E>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, E> + Send,
) -> PyResult<T>
where
    T: Send,
    E: Into<Raised> + Send,
{
    py.detach(work)
        .map_err(|error| error.into().into_exception())
}

/// Does what may take long: in a thread, while this one waits for it and for signals.
///
/// When a signal's handler raises, as that of Ctrl-C does, the work is asked to end, is waited for, and what the handler raised
/// is raised: no thread goes on computing, and nobody writes to an array any more.
pub(crate) fn work<T, E>(py: Python<'_>, work: impl FnOnce() -> Result<T, E> + Send) -> PyResult<T>
where
    T: Send,
    E: From<Error> + Into<Raised> + Send,
{
    let interrupt = Interrupt::new();
    let done = py.detach(|| {
        let (sender, receiver) = mpsc::channel();
        thread::scope(|scope| {
            let worker = || {
                // Nobody waits no more only if this thread has panicked.
                let _ = sender.send(interrupt.during(work));
            };
            let spawned = thread::Builder::new().spawn_scoped(scope, worker);
            spawned.map_err(|error| no_thread(&error))?;
            wait(&receiver, &interrupt, None)
        })
    })?;
    done.map_err(|error| error.into().into_exception())
}

/// As [`work`], of what has steps that cannot be cut short, the factorizations of an interior point. After Ctrl-C the step is
/// given a second; then it goes on in its thread, which ends with it, and the exception has a note that says so.
pub(crate) fn work_of_long_steps<T, E>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, E> + Send + 'static,
) -> PyResult<T>
where
    T: Send + 'static,
    E: From<Error> + Into<Raised> + Send + 'static,
{
    let interrupt = Interrupt::new();
    let done = py.detach(|| {
        let (sender, receiver) = mpsc::channel();
        let of_worker = interrupt.clone();
        let worker = move || {
            // Nobody waits any more where a step was too long.
            let _ = sender.send(of_worker.during(work));
        };
        let spawned = thread::Builder::new().spawn(worker);
        spawned.map_err(|error| no_thread(&error))?;
        wait(&receiver, &interrupt, Some(PATIENCE))
    })?;
    done.map_err(|error| error.into().into_exception())
}

/// How long a step is waited for.
const PATIENCE: Duration = Duration::from_secs(1);

fn no_thread(error: &io::Error) -> PyErr {
    PyRuntimeError::new_err(format!("no thread to work in: {error}"))
}

/// Waits for what is done in another thread, and for signals: after one for so long.
fn wait<T>(
    receiver: &Receiver<T>,
    interrupt: &Interrupt,
    patience: Option<Duration>,
) -> PyResult<T> {
    let mut raised: Option<(PyErr, Instant)> = None;
    loop {
        match receiver.recv_timeout(TICK) {
            Ok(done) => return raised.map_or(Ok(done), |(signal, _)| Err(signal)),
            Err(RecvTimeoutError::Timeout) => {
                let is_late = |at: &Instant| patience.is_some_and(|most| at.elapsed() > most);
                if let Some((signal, _)) = raised.take_if(|(_, at)| is_late(at)) {
                    Python::attach(|py| add_note(py, &signal));
                    return Err(signal);
                }
                #[expect(
                    clippy::redundant_closure_for_method_calls,
                    reason = "only a closure takes an interpreter of any lifetime"
                )]
                let signal = Python::attach(|py| py.check_signals());
                if let Err(signal) = signal {
                    interrupt.request();
                    raised.get_or_insert((signal, Instant::now()));
                }
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err(
                    "the work has ended without an answer",
                ));
            }
        }
    }
}

/// Says that a thread goes on; Python 3.10 knows no notes.
fn add_note(py: Python<'_>, signal: &PyErr) {
    let note =
        "cannonpile: a step that cannot be cut short goes on in a thread, which ends after it";
    let _ = signal.value(py).call_method1("add_note", (note,));
}
