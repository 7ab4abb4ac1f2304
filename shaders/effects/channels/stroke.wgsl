// Writes the fraction of each pixel that strokes cover.

#import cutaway::frame::{frame, pixel_index}
#import cutaway::stroke_cover::stroke_cover

@group(1) @binding(0) var<storage, read_write> stroke: array<f32>;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if all(id.xy < frame.size_px) {
        stroke[pixel_index(id.xy)] = stroke_cover(id.xy);
    }
}
