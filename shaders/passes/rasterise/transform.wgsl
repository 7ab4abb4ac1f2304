// Takes every vertex to the picture, once, and clears what samples will raise. One invocation owns one vertex and one pixel.

#import cutaway::frame::pixel_count
#import cutaway::mesh::clip_position
#import cutaway::screen::kept
#import cutaway::sweep::{number_of, sweep}

// Position as bits, and normal.
@group(2) @binding(5) var<storage, read> vertices: array<vec4<u32>>;
// Vertices as `screen.wgsl` keeps them.
@group(2) @binding(3) var<storage, read_write> screen: array<vec4<i32>>;
// Two planes, one word per pixel each.
@group(1) @binding(5) var<storage, read_write> nearest: array<u32>;
// How many are large, how many are to be clipped, then their numbers.
@group(2) @binding(4) var<storage, read_write> queue: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let vertex = number_of(id);
    if vertex < pixel_count() {
        nearest[vertex] = 0u;
        nearest[pixel_count() + vertex] = 0u;
    }
    if vertex == 0u {
        queue[0] = 0u;
        queue[1] = 0u;
    }
    if vertex >= sweep.vertex_count {
        return;
    }
    let clip = clip_position(bitcast<vec3<f32>>(vertices[vertex].xyz));
    screen[vertex] = kept(clip);
}
