//! The only module that names `wgpu`: the device, programs made of plans, read-back and timing.

mod bind;
mod device;
mod draw;
mod pipelines;
mod program;
mod readback;
mod real;
mod timing;
mod viewport;
mod words;

pub use device::{AdapterReport, Gpu, GpuOptions};
pub use program::Program;
pub(crate) use program::words_from_layers;
pub use timing::{ClockSet, PassTime, RunTimes};
pub use words::{POISON, run_words, run_words_with};
