// The pixels whose crossings matter, for passes over them. `passes/rasterise/settle.wgsl` fills it. Bound as @group(2) @binding(8).

#define_import_path cutaway::pixel_list

#import cutaway::touched::{TILE_PX, tile_at, tile_count, turns_among}

struct PixelList {
    count: u32,
    // Two words per tile of the picture, its depth range; then the pixels, x and y in 16 bits each.
    words: array<u32>,
}

@group(2) @binding(8) var<storage, read> pixel_list: PixelList;

// Pixels per turn.
const PIXELS_OF_TURN: u32 = 256u;

// Number of turns of a workgroup, of which each takes every N-th 256 pixels, in a dispatch of `groups` workgroups.
fn turns_of_list(group: vec3<u32>, groups: vec3<u32>) -> u32 {
    return turns_among((pixel_list.count + PIXELS_OF_TURN - 1u) / PIXELS_OF_TURN, group.x, groups.x);
}

// The pixel of an invocation in one of these turns; outside the picture beyond the end of the list.
fn share_of_list(turn: u32, group: vec3<u32>, groups: vec3<u32>, local: vec3<u32>) -> vec2<u32> {
    let place = (group.x + turn * groups.x) * PIXELS_OF_TURN + local.y * 16u + local.x;
    if place >= pixel_list.count {
        return vec2<u32>(0xffffffffu);
    }
    let packed = pixel_list.words[2u * tile_count() + place];
    return vec2<u32>(packed & 0xffffu, packed >> 16u);
}

// The depth range of the cut parts in the tile of a pixel, as in `touched_list`.
fn reach_at(pixel: vec2<u32>) -> vec2<u32> {
    let tile = tile_at(pixel / TILE_PX);
    return vec2<u32>(pixel_list.words[2u * tile], pixel_list.words[2u * tile + 1u]);
}
