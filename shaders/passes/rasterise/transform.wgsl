// Takes every vertex to the picture, once, and empties the queue of triangles that are not small. One invocation owns one vertex.

#import cutaway::mesh::clip_position
#import cutaway::screen::{borders_beyond, snapped}
#import cutaway::sweep::{number_of, sweep}

// Position as bits, and normal.
@group(2) @binding(5) var<storage, read> vertices: array<vec4<u32>>;
// x, y, depth, borders it is beyond.
@group(2) @binding(3) var<storage, read_write> screen: array<vec4<i32>>;
// How many are large, how many are to be clipped, then their numbers.
@group(2) @binding(4) var<storage, read_write> queue: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let vertex = number_of(id);
    if vertex == 0u {
        queue[0] = 0u;
        queue[1] = 0u;
    }
    if vertex >= sweep.vertex_count {
        return;
    }
    let clip = clip_position(bitcast<vec3<f32>>(vertices[vertex].xyz));
    let beyond = borders_beyond(clip);
    if beyond != 0u {
        screen[vertex] = vec4<i32>(0, 0, 0, i32(beyond));
        return;
    }
    screen[vertex] = vec4<i32>(snapped(clip), 0);
}
