// Draws a part's cap at the near plane: where the ray of a pixel begins, the part's volume image (the open module `volume`) is sampled as
// at a clip-surface. It is in front of everything; among several parts the first drawn stays.

#import cutaway::cuts::{is_removed, parts}
#import cutaway::frame::{frame, ray_through}
#import cutaway::full_screen::corner_of_screen
#import cutaway::layers::{CAP, NEAR_PLANE, UNRELIABLE, layer_word, pack_normal}
#import cutaway::sides::sides_of
#import cutaway::volume::probe

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) place: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) place: u32) -> Corner {
    // In a reversed depth buffer 1 is the near plane.
    return Corner(vec4<f32>(corner_of_screen(index).xy, 1.0, 1.0), place);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec2<u32> {
    let part = parts[corner.place];
    let ray = ray_through(corner.position.xy);
    let point = ray.origin + frame.near * ray.direction;
    let answer = probe(corner.place, point);
    let is_shown = answer.is_inside || answer.in_doubt;
    if !is_shown || is_removed(sides_of(point), part.cuts) {
        discard;
    }
    let word = layer_word(CAP, NEAR_PLANE, part.part) | select(0u, UNRELIABLE, answer.in_doubt);
    return vec2<u32>(word, pack_normal(-frame.forward.xyz));
}
