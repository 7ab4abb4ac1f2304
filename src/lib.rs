//! `cutaway` cuts solid triangle meshes with planes and 2.5D relief clip-surfaces, draws the caps that make the cut look
//! solid, and measures every way to do so against one exact reference.
//!
//! # Map
//!
//! ```text
//! data     file -> document -> scene -> plan -> passes -> layers -> image / comparison -> record -> report
//! imports  scene <- generate <- load <- document <- hard_cases <- experiment <- report <- cmd
//!          scene <- exact
//!          scene <- slice <- shader <- plan <- passes <- strategies <- gpu <- session <- compare <- hard_cases <- experiment <- report <- cmd
//! ```
//!
//! A module imports only from modules to its left; only [`gpu`] names `wgpu`; [`exact`] shares nothing with the strategies
//! but [`scene`] and the [`layers`]. A test holds this map against the source.

#![cfg_attr(
    not(feature = "cli"),
    allow(
        dead_code,
        unused_imports,
        reason = "what only files, judges or the command use of a module is not taken out of it feature by feature"
    )
)]

#[cfg(feature = "cli")]
pub mod cmd;
#[cfg(feature = "lab")]
pub mod compare;
#[cfg(feature = "io")]
pub mod document;
pub mod error;
#[cfg(feature = "lab")]
pub mod exact;
#[cfg(feature = "lab")]
pub mod experiment;
pub mod generate;
pub mod gpu;
#[cfg(feature = "lab")]
pub mod hard_cases;
pub mod layers;
#[cfg(feature = "io")]
pub mod load;
#[doc(hidden)]
pub mod passes;
pub mod plan;
#[cfg(feature = "lab")]
pub mod report;
pub mod scene;
pub mod session;
#[doc(hidden)]
pub mod shader;
pub mod slice;
pub mod strategies;

#[cfg(feature = "lab")]
pub use compare::{Comparison, compare};
#[cfg(feature = "io")]
pub use document::Document;
pub use error::{Error, Result};
#[cfg(feature = "lab")]
pub use exact::Exact;
pub use gpu::{Gpu, GpuOptions};
pub use layers::Layers;
pub use passes::Model;
pub use scene::{ClipSurface, Cut, Part, Scene};
pub use session::{Outcome, Session};
pub use strategies::Strategy;
