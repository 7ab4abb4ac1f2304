// Draws a frame into the G-buffer of a host with its own lighting.

#import cutaway::composite::{as_target_takes, depth_of, is_left_out, layers, pixel_at}
#import cutaway::cuts::Part
#import cutaway::full_screen::corner_of_screen
#import cutaway::layers::{CAP, WORDS_PER_PIXEL, kind_of, part_of, unpack_normal}

@group(0) @binding(3) var<storage, read> parts: array<Part>;

struct Unlit {
    @location(0) base_color: vec4<f32>,
    @location(1) normal: vec4<f32>,
    @location(2) what: u32,
    @builtin(frag_depth) depth: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return corner_of_screen(index);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> Unlit {
    let pixel = pixel_at(position);
    if is_left_out(pixel) {
        discard;
    }
    let at = pixel * WORDS_PER_PIXEL;
    let word = layers[at];
    let place = parts[part_of(word)].place;
    let color = select(parts[place].color, parts[place].cap_color, kind_of(word) == CAP);
    return Unlit(as_target_takes(color), vec4<f32>(unpack_normal(layers[at + 1u]), 0.0), word, depth_of(pixel));
}
