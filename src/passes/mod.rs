//! Building blocks that strategies share. A pass is a function from handles to handles: what it reads it is given, what it makes it
//! returns, so that the frame of a strategy reads from top to bottom.
//!
//! - `Input` is what a frame is recorded from, `SceneBuffers` the scene on the device, with `Lanes` for the words of parts.
//! - `Crossings` are the one list of depths per pixel; `Sheets` add those of surfaces made of triangles.
//! - `over_mesh` goes over the mesh by either rasteriser and returns the nearest kept surfaces; a `Store` says what each fragment
//!   leaves for the inside test, `FragmentLists` among others. A `Volume` answers for points.
//! - `resolve` or `gather` makes the layers, of which `effects` make a picture.

mod at_rest;
mod buffers;
mod coat;
mod crossings;
mod cutters;
mod dress;
mod fragments;
mod ground;
mod height_filter;
mod heights;
mod input;
mod kept;
mod lanes;
mod layers;
mod model;
mod need;
mod packed;
mod pieces;
mod pose;
mod probe;
mod pyramid;
mod rasterise;
mod rasteriser;
mod refusal;
mod relevance;
mod relief_sky;
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
mod touched;

pub(crate) use at_rest::Moved;
pub(crate) use buffers::{SceneBuffers, or_one};
pub(crate) use coat::Coats;
pub(crate) use crossings::{ANY_SURFACES, AskedCrossings, Crossings, LISTED, ONE_SURFACE};
pub(crate) use fragments::{FragmentLists, leave_fragments};
pub use ground::GroundShadow;
pub(crate) use input::{Input, counted, pixels};
pub(crate) use kept::KeptContents;
pub(crate) use lanes::Lanes;
pub(crate) use layers::{Layered, gather, gather_into, overlap, picture};
pub use model::{MeshRange, Model};
pub(crate) use need::{NEED_OF_CELLS, NEED_OF_SPRITES, need};
pub use need::{NEED_OF_CROSSINGS, NEED_OF_FRAGMENTS, NEED_OF_SHEETS, NEED_OF_TRIANGLES};
pub(crate) use pieces::Share;
pub(crate) use probe::Volume;
pub use pyramid::ReliefWalk;
pub(crate) use pyramid::pyramids;
pub(crate) use rasterise::OnScreen;
pub use rasteriser::Rasteriser;
pub use refusal::{Obstacle, Refusal};
pub use relevance::{Relevance, Treatment};
pub(crate) use resolve::{Inside, resolve};
pub use scan::{BLOCK_WORDS, Run, Scan, Total};
pub use screen::NO_LANE;
pub(crate) use screen::{Fresh, Screen, ScreenOf};
pub(crate) use sections::Sections;
pub(crate) use sheet::{SheetDraw, Sheets};
pub(crate) use solid::{NearestKept, Store, over_mesh};
pub(crate) use surface::{DrawPass, Surfaces};
pub use sweep::INVOCATIONS_PER_ROW;
pub(crate) use sweep::{Sweep, groups_along};
pub(crate) use touched::{TILE_PX, Touched, share_tiles, tiles_in};
