//! `cutaway._native`: the Rust part of the Python module.
//!
//! Python holds a `Scene`: a document, the files read for it, and its last drawn model. Every call takes and returns
//! plain values and arrays. Argument names, warnings and result classes with methods are defined in the Python package next to this
//! crate.
//!
//! No call can crash the interpreter. Long work runs without the interpreter's lock (`door`), and a panic becomes a Python error. Calls
//! in a process forked from one that used the library return an error, because threads and devices do not survive a fork.
//!
//! Cost: arrays are copied once in, and once out.

mod arrays;
mod camera;
mod capped;
mod compare;
mod device;
mod door;
mod opened;
mod render;
mod scene;
mod section;
mod state;
mod store;
mod values;

use pyo3::prelude::*;

/// The functions and classes of `cutaway._native`.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<scene::Scene>()?;
    module.add_function(wrap_pyfunction!(device::adapter, module)?)?;
    module.add_function(wrap_pyfunction!(render::png, module)?)?;
    module.add_function(wrap_pyfunction!(values::values, module)?)?;
    Ok(())
}
