// The list of tiles that effects draw, while it is built. Bound as @group(2) @binding(6).

#define_import_path cutaway::effect_tile_marks

#import cutaway::effect_tiles::{Backdrop, EffectTile}

// As in `effect_tile_list`.
struct EffectTiles {
    count: atomic<u32>,
    before: Backdrop,
    now: Backdrop,
    tiles: array<EffectTile>,
}

@group(2) @binding(6) var<storage, read_write> effect_tiles: EffectTiles;
