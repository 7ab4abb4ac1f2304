//! The device of the process: opened when it is first needed, and shared by all scenes, because opening it takes longer than a frame.

use std::sync::{Mutex, PoisonError};

use cutaway::{Gpu, GpuOptions, Session};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::door::{Result, detached};

static SESSION: Mutex<Option<Session>> = Mutex::new(None);

/// Runs a function with the session of the process; one call at a time.
///
/// # Errors
///
/// No adapter, with the package that provides one; and the errors of the function.
pub(crate) fn with_session<T>(work: impl FnOnce(&mut Session) -> Result<T>) -> Result<T> {
    let mut session = SESSION.lock().unwrap_or_else(|poisoned| {
        // A panic may have left the session in an inconsistent state, so it is discarded.
        let mut session = PoisonError::into_inner(poisoned);
        *session = None;
        SESSION.clear_poison();
        session
    });
    let session = match &mut *session {
        Some(session) => session,
        empty => empty.insert(Session::new(Gpu::open(&GpuOptions::default())?)),
    };
    work(session)
}

/// The adapter: `name`, `backend`, `driver`, and `software`, true if it runs on the CPU.
#[pyfunction]
pub(crate) fn adapter(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let report = detached(py, || {
        with_session(|session| Ok(session.gpu().report().clone()))
    })?;
    let about = PyDict::new(py);
    about.set_item("name", report.name)?;
    about.set_item("backend", report.backend)?;
    about.set_item("driver", report.driver)?;
    about.set_item("software", report.software)?;
    Ok(about)
}
