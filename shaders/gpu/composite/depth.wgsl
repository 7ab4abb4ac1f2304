// Draws a frame into a host's picture, with the host's depth test.

#import cutaway::composite::{color_of, depth_of, is_left_out, pixel_at}
#import cutaway::full_screen::corner_of_screen

struct Composed {
    @location(0) color: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return corner_of_screen(index);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> Composed {
    let pixel = pixel_at(position);
    if is_left_out(pixel) {
        discard;
    }
    return Composed(color_of(pixel), depth_of(pixel));
}
