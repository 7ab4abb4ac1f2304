//! The only module that names `wgpu`: the device, programs made of plans, read-back and timing.

mod bind;
mod composite;
mod device;
mod draw;
mod pipelines;
mod program;
mod readback;
mod real;
mod report;
mod timing;
mod viewport;
mod words;

pub use ::wgpu;
pub use ::wgpu::CommandEncoder;
pub(crate) use composite::Compositor;
pub use composite::{Target, TargetDepth};
pub use device::{AdapterReport, Gpu, GpuOptions};
#[doc(hidden)]
pub use program::Program;
pub(crate) use program::words_from_layers;
pub(crate) use report::Report;
pub use timing::{ClockSet, PassTime, RunTimes};
#[doc(hidden)]
pub use words::{POISON, run_words, run_words_with};
