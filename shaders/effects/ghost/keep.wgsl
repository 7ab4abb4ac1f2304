// Keeps only those borders of the uncut solids that have removed material on at least one side. One invocation owns a pixel.

#import cutaway::borders::{below_of, right_of}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::ghost::is_gone

@group(1) @binding(2) var<storage, read_write> ghost_borders: array<u32>;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let word = ghost_borders[pixel];
    let at = vec2<i32>(id.xy);
    if word == 0u || is_gone(at) {
        return;
    }
    let right = select(0u, right_of(word), is_gone(at + vec2<i32>(1, 0)));
    let below = select(0u, below_of(word), is_gone(at + vec2<i32>(0, 1)));
    ghost_borders[pixel] = right | (below << 4u);
}
