// Draws solids as they are: what `draw_only` measures and what remains when nothing is cut.

#import cutaway::cuts::parts
#import cutaway::layers::{BACK_FACE, SURFACE, layer_word, pack_normal, unpack_normal}
#import cutaway::mesh::{Vertex, clip_position, facing}

// What to write in the place of the clip-surface: 0, or UNRANKED where a later pass must find the surface's place among crossings.
override place: u32 = 0u;

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) @interpolate(flat) rank: u32,
}

@vertex
fn vertex(v: Vertex) -> Corner {
    return Corner(clip_position(v.position), unpack_normal(v.normal), v.rank);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> @location(0) vec2<u32> {
    let word = layer_word(SURFACE, place, parts[corner.rank].part) | select(BACK_FACE, 0u, front);
    return vec2<u32>(word, pack_normal(facing(normalize(corner.normal), front)));
}
