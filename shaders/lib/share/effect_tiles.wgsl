// A workgroup's share of the picture: of N workgroups each takes every N-th tile that effects draw.

#define_import_path cutaway::share

#import cutaway::effect_tile_list::effect_tiles
#import cutaway::touched::{pixel_in, turns_among}

// Number of tiles of a workgroup, in a dispatch of `groups` workgroups.
fn turns(group: vec3<u32>, groups: vec3<u32>) -> u32 {
    return turns_among(effect_tiles.count, group.x, groups.x);
}

// The pixel of an invocation in one of these tiles, possibly outside the picture.
fn pixel_at(turn: u32, group: vec3<u32>, groups: vec3<u32>, local: vec3<u32>) -> vec2<u32> {
    return pixel_in(effect_tiles.tiles[group.x + turn * groups.x].listed, local.xy);
}
