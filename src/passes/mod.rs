//! Building blocks that strategies share: what of the cuts matters, the scene as resources, drawing, gathering, shading.

mod model;
mod picture;
mod recorder;
mod relevance;

pub use model::{MeshRange, Model};
pub use recorder::{DrawPass, Recorder, Targets, counted, pixels};
pub use relevance::{Relevance, Treatment};
