// Adds the triangles that claimed settled pixels, in core WebGPU. Workgroups share the touched tiles, an invocation owns a pixel of each.

#import cutaway::frame::{frame, pixel_index}
#import cutaway::layers::{SURFACE, UNRELIABLE, WORDS_PER_PIXEL, kind_of}
#import cutaway::share::{pixel_at, turns}

@group(1) @binding(3) var<storage, read_write> layers: array<u32>;
@group(1) @binding(5) var<storage, read> nearest: array<vec2<u32>>;

fn add_triangle(pixel: u32) {
    let first = pixel * WORDS_PER_PIXEL;
    if kind_of(layers[first]) != SURFACE {
        return;
    }
    let code = nearest[pixel].x;
    layers[first + 1u] = code;
    // A depth without a claiming triangle is a fault of the rasteriser.
    layers[first] = select(layers[first], UNRELIABLE, code == 0u);
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let end = turns(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let xy = pixel_at(turn, group, groups, local);
        if all(xy < frame.size_px) {
            add_triangle(pixel_index(xy));
        }
    }
}
