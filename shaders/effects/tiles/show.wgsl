// Finds the tiles of the picture that are not background. A workgroup owns a tile, an invocation one of the tile's pixels.

#import cutaway::backdrop::backdrop
#import cutaway::effect_tile_marks::effect_tiles
#import cutaway::effect_tiles::Backdrop
#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::{BACKGROUND, WORDS_PER_PIXEL, kind_of}
#import cutaway::touched::tile_at

@group(1) @binding(0) var<storage, read> layers: array<u32>;

var<workgroup> found: atomic<u32>;

@compute @workgroup_size(16, 16)
fn main(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(workgroup_id) tile: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    if all(id.xy < frame.size_px) && kind_of(layers[pixel_index(id.xy) * WORDS_PER_PIXEL]) != BACKGROUND {
        atomicStore(&found, 1u);
    }
    workgroupBarrier();
    if local != 0u {
        return;
    }
    effect_tiles.tiles[tile_at(tile.xy)].is_shown = atomicLoad(&found);
    if all(tile.xy == vec2<u32>(0u)) {
        atomicStore(&effect_tiles.count, 0u);
        effect_tiles.before = effect_tiles.now;
        effect_tiles.now = Backdrop(frame.size_px, frame.band, bitcast<vec4<u32>>(backdrop(0u)), bitcast<vec4<u32>>(backdrop(frame.size_px.y - 1u)));
    }
}
