//! The tiles of the picture that a frame touches. Per-pixel passes run only on these tiles; the rest is background.
//!
//! The list is made by a pass over the triangles before all others, or by the first sweep if no pass reads pixels before it
//! (`shaders/lib/touching.wgsl`). It outlives its frame: the next frame resets what this one has drawn, so that untouched pixels are
//! written once. To this end it stores the picture that it belongs to; a new list belongs to none.
//!
//! Cost: 16 bytes per tile of 16 x 16 pixels. Whole tiles are processed: for small or thin objects many of their pixels are background.

use crate::plan::{Access, Binding, BufferRole, Clock, Contents, Plan, Resource, ResourceId, Work};

/// Pixels along a side of a tile: `shaders/lib/touched.wgsl`.
pub(crate) const TILE_PX: u32 = 16;
/// Bytes before the tiles, and bytes per tile: `shaders/lib/touched_list.wgsl`.
const HEAD_BYTES: u64 = 40;
const TILE_BYTES: u64 = 16;

/// Minimum number of tiles per workgroup if all are touched: a workgroup's last turn may find none left.
const TILES_OF_GROUP: u32 = 8;
/// Maximum number of workgroups that share the list.
const MOST_GROUPS: u32 = 65_535;

/// The touched tiles of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touched {
    list: ResourceId,
    tile_count: u32,
}

impl Touched {
    /// The tiles of a picture, none touched yet.
    pub(crate) fn of_picture(plan: &mut Plan, size_px: [u32; 2]) -> Self {
        let tile_count = tiles_in(size_px);
        let bytes = HEAD_BYTES + u64::from(tile_count) * TILE_BYTES;
        let room = Contents::in_pieces(bytes, Vec::new(), true);
        let list = Resource::upload("touched", BufferRole::Storage, room, Clock::Frame);
        Self {
            list: plan.add_resource(list),
            tile_count,
        }
    }

    /// Number of tiles in the picture.
    pub(crate) fn tile_count(self) -> u32 {
        self.tile_count
    }

    /// Binding for passes that process tiles, or add some.
    pub(crate) fn binding(self, access: Access) -> Binding {
        Binding {
            access,
            ..Binding::read("touched", self.list)
        }
    }

    /// A dispatch whose workgroups share the tiles.
    pub(crate) fn shared(self) -> Work {
        share_tiles(self.tile_count)
    }
}

/// Number of tiles in a picture.
pub(crate) fn tiles_in(size_px: [u32; 2]) -> u32 {
    size_px.map(|px| px.div_ceil(TILE_PX)).iter().product()
}

/// A dispatch whose workgroups share a list of at most `tile_count` tiles.
pub(crate) fn share_tiles(tile_count: u32) -> Work {
    Work::Compute {
        groups: [groups_of_tiles(tile_count), 1, 1],
    }
}

/// Number of workgroups that share a list of at most `tile_count` tiles.
pub(crate) fn groups_of_tiles(tile_count: u32) -> u32 {
    (tile_count / TILES_OF_GROUP).clamp(1, MOST_GROUPS)
}
