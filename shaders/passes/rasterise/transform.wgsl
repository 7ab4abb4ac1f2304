// Transforms every vertex to the screen, once, and resets the results of a frame (the open module `fresh`). One invocation owns one vertex.

#import cutaway::fresh::freshen
#import cutaway::mesh::clip_position
#import cutaway::screen::kept
#import cutaway::sweep::{number_of, sweep}

// Position as bits, and normal.
@group(2) @binding(5) var<storage, read> vertices: array<vec4<u32>>;
// Vertices in the format of `screen.wgsl`.
@group(2) @binding(3) var<storage, read_write> screen: array<vec4<i32>>;
// In the layout of `queue.wgsl`.
@group(2) @binding(4) var<storage, read_write> queue: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let vertex = number_of(id);
    freshen(vertex);
    if vertex == 0u {
        queue[0] = 0u;
        queue[1] = 0u;
    }
    if vertex >= sweep.vertex_count {
        return;
    }
    let clip = clip_position(bitcast<vec3<f32>>(vertices[sweep.first_vertex + vertex].xyz));
    screen[vertex] = kept(clip);
}
