// A workgroup's share of the picture: one tile, whatever its content.

#define_import_path cutaway::share

#import cutaway::touched::TILE_PX

fn turns(group: vec3<u32>, groups: vec3<u32>) -> u32 {
    return 1u;
}

fn pixel_at(turn: u32, group: vec3<u32>, groups: vec3<u32>, local: vec3<u32>) -> vec2<u32> {
    return group.xy * TILE_PX + local.xy;
}
