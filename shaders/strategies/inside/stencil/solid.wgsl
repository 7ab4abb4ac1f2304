// Draws a solid less what the only plane removes. Every fragment that is kept counts in the stencil, hidden or not: where the
// ray starts on the removed side these are the fragments behind the plane.

#import cutaway::cuts::parts
#import cutaway::layers::{BACK_FACE, SURFACE, layer_word, pack_normal, unpack_normal}
#import cutaway::mesh::{Vertex, clip_position, facing}
#import cutaway::sheet::{is_kept, sheet_at}

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
    if !is_kept(sheet_at(corner.position.xy), corner.position.z) {
        discard;
    }
    let word = layer_word(SURFACE, 0u, parts[corner.rank].part) | select(BACK_FACE, 0u, front);
    return vec2<u32>(word, pack_normal(facing(normalize(corner.normal), front)));
}
