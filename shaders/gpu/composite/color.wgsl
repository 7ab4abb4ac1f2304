// Draws a frame over a host's picture, without a depth test.

#import cutaway::composite::{color_of, is_left_out, pixel_at}
#import cutaway::full_screen::corner_of_screen

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return corner_of_screen(index);
}

@fragment
fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = pixel_at(position);
    if is_left_out(pixel) {
        discard;
    }
    return color_of(pixel);
}
