//! Building blocks that strategies share. A pass is a function from handles to handles: it takes what it reads and returns what it
//! makes, so that a strategy's frame reads from top to bottom.
//!
//! - `Input` is the data from which a frame is recorded, `SceneBuffers` the scene on the device, with `Lanes` for the words of parts.
//! - `Crossings` are the per-pixel list of depths; `Sheets` add the crossings with triangulated surfaces.
//! - `over_mesh` draws the mesh with either rasteriser and returns the nearest kept surfaces; a `Store` defines what each fragment
//!   stores for the inside test, for example in `FragmentLists`. A `Volume` answers inside tests at points.
//! - `resolve` or `gather` makes the layers, from which `effects` make a picture.
//!
//! Folders: `pack` packs the scene for upload, `frame` holds the data for recording a frame, `draw` goes from triangles to layers. Within
//! them, files import from files, not from here: the re-exports below are for strategies and effects.

mod draw;
mod frame;
mod pack;

pub(crate) use draw::layers::{Layered, gather, gather_into, overlap, picture};
pub(crate) use draw::probe::Volume;
pub(crate) use draw::resolve::{Inside, resolve};
pub use draw::scan::{BLOCK_WORDS, Scan, ScanRange, Total};
pub use draw::screen::NO_LANE;
pub(crate) use draw::screen::{Fresh, ScreenOf};
pub(crate) use draw::share::Share;
pub(crate) use draw::sheet::{SheetDraw, Sheets};
pub(crate) use draw::slabs::{PixelList, capacity_for_slabs, mark_by_slabs};
pub(crate) use draw::solid::{NearestKept, over_mesh};
pub(crate) use draw::store::Store;
pub(crate) use draw::surface::{DrawPass, Surfaces};
pub(crate) use draw::sweep::SweepPasses;
pub use frame::active_cuts::{ActiveCuts, PartDrawMode};
pub(crate) use frame::buffers::{SceneBuffers, or_one};
pub(crate) use frame::crossings::{CrossingSource, Crossings, LISTED, fours_file, surfaces_file};
pub use frame::dispatch::INVOCATIONS_PER_ROW;
pub(crate) use frame::dispatch::groups_along;
pub(crate) use frame::fragments::{FragmentLists, leave_fragments};
pub(crate) use frame::input::{Input, counted, pixels};
pub(crate) use frame::lanes::Lanes;
pub(crate) use frame::need::{NEED_OF_CELLS, NEED_OF_SPRITES, need};
pub use frame::need::{NEED_OF_CROSSINGS, NEED_OF_FRAGMENTS, NEED_OF_SHEETS, NEED_OF_TRIANGLES};
pub(crate) use frame::on_screen::ScreenMesh;
pub(crate) use frame::pyramid::pyramids;
pub use frame::rasteriser::Rasteriser;
pub use frame::refusal::{Refusal, Unsupported};
pub use frame::relief_walk::ReliefWalk;
pub(crate) use frame::sections::Sections;
pub(crate) use frame::touched::{TILE_PX, groups_of_tiles, share_tiles, tiles_in};
pub use pack::ground::GroundShadow;
pub use pack::model::Model;
pub(crate) use pack::rest_pose::Moved;
pub use pack::vertex::MeshRange;
pub(crate) use pack::vertex_paint::VertexPaints;
