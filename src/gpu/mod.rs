//! The device, programs made from plans, read-back and timing. No other module names `wgpu`.

mod adapter;
mod arrival;
mod clip;
mod clip_layout;
mod composite;
mod device;
mod draw;
mod layer_words;
mod open;
mod pick;
mod programs;
mod readback;
mod report;
mod resource;
#[cfg(not(target_arch = "wasm32"))]
mod sub_pixel;
mod target;
mod timing;
mod uniforms;
mod viewport;
mod words;

pub use ::wgpu;
pub use ::wgpu::{BindGroup, CommandEncoder};
pub use adapter::AdapterReport;
pub use clip::clip_wgsl;
pub(crate) use clip::{ClipBindGroup, ClipTable};
pub(crate) use composite::Compositor;
pub use device::Gpu;
pub use layer_words::{layers_from_words, words_from_layers};
pub use open::GpuOptions;
pub use pick::Pick;
pub use programs::preparation::Preparation;
#[doc(hidden)]
pub use programs::program::Program;
pub(crate) use report::Report;
pub(crate) use target::Destination;
pub use target::{Attachment, GBuffer, Target, TargetDepth};
pub use timing::{ClockSet, PassTime, RunTimes};
#[doc(hidden)]
pub use words::{POISON, run_words, run_words_with};
