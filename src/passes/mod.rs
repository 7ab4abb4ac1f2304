//! Building blocks that strategies share: what of the cuts matters, the scene as resources, the list of crossings, the pass over the
//! mesh by either rasteriser, what it leaves for an inside test, resolving, gathering, shading.

mod crossings;
mod lanes;
mod model;
mod picture;
mod rasterise;
mod rasteriser;
mod recorder;
mod relevance;
mod resolve;
mod solid;

pub use crossings::Crossings;
pub use lanes::LaneTable;
pub use model::{MeshRange, Model};
pub use rasterise::INVOCATIONS_PER_ROW;
pub use rasteriser::Rasteriser;
pub use recorder::{DrawPass, Recorder, Targets, counted, pixels};
pub use relevance::{Relevance, Treatment};
pub use resolve::Inside;
pub use solid::Store;
