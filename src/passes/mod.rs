//! Building blocks that strategies share: what of the cuts matters, the scene as resources, drawing, gathering, shading, rasterising
//! without the GPU's own rasteriser.

mod model;
mod picture;
mod rasterise;
mod recorder;
mod relevance;

pub use model::{MeshRange, Model};
pub use rasterise::{INVOCATIONS_PER_ROW, MaskTarget, NEAREST_PLANES};
pub use recorder::{DrawPass, Recorder, Targets, counted, pixels};
pub use relevance::{Relevance, Treatment};
