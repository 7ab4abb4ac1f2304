//! The tiles of the picture that effects go over, as a list on the device: [`super::effect_tile_search`] makes it.

use crate::passes::share_tiles;
use crate::plan::{Binding, ResourceId, Work};

/// The tiles that effects of a frame go over.
#[derive(Clone, Copy, Debug)]
pub(super) struct EffectTiles {
    pub(super) list: ResourceId,
    pub(super) tile_count: u32,
}

impl EffectTiles {
    /// The list, for passes that go over it.
    pub(super) fn listed(self) -> Binding {
        Binding::read("effect_tiles", self.list)
    }

    /// A dispatch whose workgroups share them.
    pub(super) fn shared(self) -> Work {
        share_tiles(self.tile_count)
    }
}
