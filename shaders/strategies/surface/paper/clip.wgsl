// Draws a solid with the clip test at every fragment (Trapp & Döllner 2013, section 4): chi decides, on the interpolated point.

#import cutaway::cuts::{is_removed, parts}
#import cutaway::exits::is_passed
#import cutaway::layers::{BACK_FACE, SURFACE, layer_word, pack_normal, unpack_normal}
#import cutaway::mesh::{Vertex, drawn_position, facing}
#import cutaway::sides::sides_of

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    @location(1) point: vec3<f32>,
    @location(2) @interpolate(flat) instance: u32,
}

@vertex
fn vertex(v: Vertex) -> Corner {
    return Corner(drawn_position(v.position), unpack_normal(v.normal), v.position, v.instance);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> @location(0) vec2<u32> {
    let part = parts[corner.instance];
    if is_removed(sides_of(corner.point), part.cuts) || is_passed(front) {
        discard;
    }
    let word = layer_word(SURFACE, 0u, part.part) | select(BACK_FACE, 0u, front);
    return vec2<u32>(word, pack_normal(facing(normalize(corner.normal), front)));
}
