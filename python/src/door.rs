//! The door between Python and the library: locks, errors, panics and forks.
//!
//! Invalid input raises a `ValueError` with the library's message, including its `help:`. A missing file raises a
//! `FileNotFoundError`. A missing adapter and bugs of the library raise a `RuntimeError`.
//!
//! Long work runs on a separate thread, so that Ctrl-C is raised at once. The interrupted work still runs to its end,
//! because the library cannot stop halfway. Later calls that need the same scene or the device wait for it; they can be interrupted too.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use cutaway::Error;
use pyo3::exceptions::{PyFileNotFoundError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// Result of a call to the library.
pub(crate) type Result<T> = cutaway::Result<T>;

/// Id of the process that first used the library; 0 before the first use.
static OWNER: AtomicU32 = AtomicU32::new(0);

/// Longest time between two checks for Python signals.
const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

/// Stack size of a worker thread: that of a process's main thread.
const STACK_BYTES: usize = 8 << 20;

/// Runs long work without the interpreter lock; a Python interrupt is raised meanwhile.
pub(crate) fn detached<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> PyResult<T> {
    stoppable(py, |_| work())
}

/// The same for work that checks whether it should stop.
pub(crate) fn stoppable<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> Result<T> + Send + 'static,
) -> PyResult<T> {
    must_be_owner()?;
    let stop = Arc::new(AtomicBool::new(false));
    let (sender, mut receiver) = mpsc::channel();
    let flag = stop.clone();
    let thread = thread::Builder::new().stack_size(STACK_BYTES);
    let begun = thread.spawn(move || {
        let done = catch_unwind(AssertUnwindSafe(|| work(&flag)));
        // After an interrupt no one receives the result.
        let _ = sender.send(done);
    });
    let lost = |what: String| {
        let help = "close other programs, and try again";
        PyRuntimeError::new_err(format!("{what}\n  help: {help}"))
    };
    begun.map_err(|e| lost(format!("no thread can be started: {e}")))?;
    let done = loop {
        let waited = py.detach(move || (receiver.recv_timeout(BETWEEN_LOOKS), receiver));
        receiver = waited.1;
        match waited.0 {
            Ok(done) => break done,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(lost("a worker thread ended without a result".to_owned()));
            }
            Err(RecvTimeoutError::Timeout) => py
                .check_signals()
                .inspect_err(|_| stop.store(true, Ordering::Relaxed))?,
        }
    };
    match done {
        Ok(result) => result.map_err(raised),
        Err(panic) => Err(PyRuntimeError::new_err(format!(
            "cutaway is at fault: {}\n  help: please report this, with the scene that caused it",
            words_of(&*panic)
        ))),
    }
}

/// Returns an error in a forked child process: it has no copy of the threads, so it would wait for them for ever.
fn must_be_owner() -> PyResult<()> {
    let own = process::id();
    match OWNER.compare_exchange(0, own, Ordering::Relaxed, Ordering::Relaxed) {
        Ok(_) => Ok(()),
        Err(owner) if owner == own => Ok(()),
        Err(_) => Err(PyRuntimeError::new_err(
            "this process was forked from one that had used cutaway, and has no access to its threads and device\n  \
             help: start processes with multiprocessing.get_context(\"spawn\"), or use cutaway only in the forked ones",
        )),
    }
}

/// Converts an error of the library to a Python exception.
pub(crate) fn raised(error: Error) -> PyErr {
    let words = error.to_string();
    match &error {
        Error::Missing(_) => PyFileNotFoundError::new_err(words),
        Error::File { .. } | Error::Input { .. } | Error::Limit(_) => PyValueError::new_err(words),
        _ => PyRuntimeError::new_err(words),
    }
}

fn words_of(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("no message")
}
