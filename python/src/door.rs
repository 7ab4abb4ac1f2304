//! The door between Python and the library: locks, errors, panics and forks.
//!
//! What is bad input is a `ValueError` with the words of the library, its `help:` included. A file that is not there is a
//! `FileNotFoundError`. Want of an adapter, and faults of the library itself, are a `RuntimeError`.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process;
use std::sync::atomic::{AtomicU32, Ordering};

use cutaway::Error;
use pyo3::exceptions::{PyFileNotFoundError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// Result of what is asked of the library.
pub(crate) type Result<T> = cutaway::Result<T>;

/// The process that first came through the door; 0 before.
static OWNER: AtomicU32 = AtomicU32::new(0);

/// Runs what takes time without the lock of the interpreter.
pub(crate) fn detached<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T> + Send,
) -> PyResult<T> {
    must_be_owner()?;
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    match done {
        Ok(result) => result.map_err(raised),
        Err(panic) => Err(PyRuntimeError::new_err(format!(
            "cutaway is at fault: {}\n  help: please report this with the scene that it happened with",
            words_of(&*panic)
        ))),
    }
}

/// Refuses a child that was forked: its threads are not there, and waiting for them would never end.
fn must_be_owner() -> PyResult<()> {
    let own = process::id();
    match OWNER.compare_exchange(0, own, Ordering::Relaxed, Ordering::Relaxed) {
        Ok(_) => Ok(()),
        Err(owner) if owner == own => Ok(()),
        Err(_) => Err(PyRuntimeError::new_err(
            "this process was forked from one that has used cutaway, whose threads and device it does not have\n  \
             help: start processes by multiprocessing.get_context(\"spawn\"), or use cutaway in them alone",
        )),
    }
}

/// An error of the library as Python has it.
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
        .unwrap_or("it does not say how")
}
