//! Long computations, with the interpreter lock released and cancellation by Ctrl-C.

use std::io;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use cannonpile::{Error, Interrupt};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::exception::Raised;

/// The interval between checks for signals.
const TICK: Duration = Duration::from_millis(50);

/// Runs a computation that is known to be short.
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

/// Runs a computation that may be long in another thread. The calling thread waits for it and checks for signals.
///
/// If a signal handler raises, as that of Ctrl-C does, the computation is cancelled and awaited, and the exception
/// is raised. So no thread continues to compute or to write into an array.
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
                // The receiver is missing only if the waiting thread has panicked.
                let _ = sender.send(interrupt.during(work));
            };
            let spawned = thread::Builder::new().spawn_scoped(scope, worker);
            spawned.map_err(|error| no_thread(&error))?;
            wait(&receiver, &interrupt, None)
        })
    })?;
    done.map_err(|error| error.into().into_exception())
}

/// Runs a computation with steps that cannot be interrupted, such as the factorisations of an interior-point
/// method.
///
/// After Ctrl-C the thread waits one second for the current step. Then the step continues in its thread, which ends
/// after it, and the exception has a note about this.
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
            // The receiver is missing if a step was too long to wait for.
            let _ = sender.send(of_worker.during(work));
        };
        let spawned = thread::Builder::new().spawn(worker);
        spawned.map_err(|error| no_thread(&error))?;
        wait(&receiver, &interrupt, Some(PATIENCE))
    })?;
    done.map_err(|error| error.into().into_exception())
}

/// The waiting time for a step.
const PATIENCE: Duration = Duration::from_secs(1);

fn no_thread(error: &io::Error) -> PyErr {
    PyRuntimeError::new_err(format!("cannot start a thread: {error}"))
}

/// Waits for another thread and checks for signals. After a signal it waits for `patience` at most.
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
                    reason = "only a closure accepts an interpreter of any lifetime"
                )]
                let signal = Python::attach(|py| py.check_signals());
                if let Err(signal) = signal {
                    interrupt.request();
                    raised.get_or_insert((signal, Instant::now()));
                }
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err(
                    "the computation ended without a result",
                ));
            }
        }
    }
}

/// Adds a note that the thread continues. Python 3.10 has no notes.
fn add_note(py: Python<'_>, signal: &PyErr) {
    let note =
        "cannonpile: a step that cannot be interrupted continues in a thread, which ends after it";
    let _ = signal.value(py).call_method1("add_note", (note,));
}
