//! The tiles of the picture that effects process, as a list on the device, built by [`super::effect_tile_search`].

use crate::passes::share_tiles;
use crate::plan::{Binding, ResourceId, Work};

/// The tiles that the effects of a frame process.
#[derive(Clone, Copy, Debug)]
pub(super) struct EffectTiles {
    pub(super) list: ResourceId,
    pub(super) tile_count: u32,
}

impl EffectTiles {
    /// The tile list, for passes that process it.
    pub(super) fn listed(self) -> Binding {
        Binding::read("effect_tiles", self.list)
    }

    /// A dispatch whose workgroups share the tiles.
    pub(super) fn shared(self) -> Work {
        share_tiles(self.tile_count)
    }
}
