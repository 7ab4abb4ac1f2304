//! Building blocks that strategies share: what of the cuts matters, the scene as resources, the list of crossings, the pass over
//! the mesh by either rasteriser, what it leaves for an inside test, prefix sums and lists of fragments, questions to images of
//! volumes, sheets, resolving, gathering, shading.

mod crossings;
mod cutters;
mod fragments;
mod height_filter;
mod heights;
mod lanes;
mod mask;
mod model;
mod packed;
mod picture;

mod pose;
mod probe;
mod pyramid;
mod rasterise;
mod rasteriser;
mod recorder;
mod refusal;
mod relevance;
mod resolve;
mod rest;
mod scan;
mod screen;
mod sections;
mod settled;
mod sheet;
mod sliced;
mod solid;
mod surface;
mod sweep;

pub use crossings::Crossings;
pub use cutters::Cutters;
pub use fragments::{FragmentLists, sweep_of_fragments};
pub use lanes::LaneTable;
pub use model::{MeshRange, Model};
pub use pose::Moving;
pub use probe::Volume;
pub use pyramid::ReliefWalk;
pub use rasteriser::Rasteriser;
pub use recorder::{
    DrawPass, NEED_OF_CELLS, NEED_OF_CROSSINGS, NEED_OF_FRAGMENTS, NEED_OF_SHEETS, NEED_OF_SPRITES,
    NEED_OF_TRIANGLES, Recorder, Targets, counted, pixels,
};
pub use refusal::{Obstacle, Refusal};
pub use relevance::{Relevance, Treatment};
pub use resolve::Inside;
pub use scan::{BLOCK_WORDS, Scan};
pub use screen::{NO_LANE, Screen, ScreenOf};
pub use sections::Sections;
pub use sheet::{SheetDraw, Sheets};
pub use solid::Store;
pub use sweep::{INVOCATIONS_PER_ROW, Sweep, groups_along};
