// A workgroup's share of the picture: of N workgroups each takes every N-th tile, whatever its content.

#define_import_path cutaway::share

#import cutaway::touched::{pixel_in, tile_count, turns_among}

// Number of tiles of a workgroup, in a dispatch of `groups` workgroups.
fn turns(group: vec3<u32>, groups: vec3<u32>) -> u32 {
    return turns_among(tile_count(), group.x, groups.x);
}

// The pixel of an invocation in one of these tiles, possibly outside the picture.
fn pixel_at(turn: u32, group: vec3<u32>, groups: vec3<u32>, local: vec3<u32>) -> vec2<u32> {
    return pixel_in(group.x + turn * groups.x, local.xy);
}
