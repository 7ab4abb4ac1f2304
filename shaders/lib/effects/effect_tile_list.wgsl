// The list of tiles that effects draw, in the form that effects read. Bound as @group(2) @binding(6).

#define_import_path cutaway::effect_tile_list

#import cutaway::effect_tiles::{Backdrop, EffectTile}

struct EffectTiles {
    count: u32,
    before: Backdrop,
    now: Backdrop,
    tiles: array<EffectTile>,
}

@group(2) @binding(6) var<storage, read> effect_tiles: EffectTiles;
