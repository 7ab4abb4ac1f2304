//! `cutaway._native`: the part of the Python module that is in Rust.
//!
//! Python holds a [`Scene`](scene::Scene): a document, the files that were read for it, and what it was last drawn as. Every call takes plain values
//! and arrays and gives plain values and arrays; names, doubts about them and results with methods are in the package next to it,
//! which is Python.
//!
//! No call takes the interpreter down. What is long runs without the interpreter's lock ([`door`]); a panic below becomes an error; and a
//! process that was forked from one that has drawn is refused, because threads and devices do not survive that.
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
