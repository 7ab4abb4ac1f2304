// Decides what each pixel shows, surface or cap, after the compute rasteriser has found the surfaces: `resolve` without the data that only
// painted pixels need. Workgroups share the touched tiles, an invocation owns a pixel of each.
//
// Until it is painted, a surface stores the code of its triangle instead of its normal, and a cap the word of its crossing.

#import cutaway::decision::{Drawn, decide, write}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::lanes::Lanes
#import cutaway::layers::{BACKGROUND, SURFACE, UNCOUNTED, UNRELIABLE, layer_word}
#import cutaway::share::{pixel_at, turns}

// Code of the triangle, and its depth-buffer value as bits.
@group(1) @binding(5) var<storage, read> nearest: array<vec2<u32>>;

override lane_bits: u32 = 32u;
override lane_count: u32 = 1u;
override near_inside: bool = false;
override overlaps: bool = false;

fn decide_pixel(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    let found = nearest[pixel];
    var drawn = Drawn(BACKGROUND, 0u, bitcast<f32>(found.y));
    if found.y != 0u {
        // A depth without a claiming triangle is a fault of the rasteriser.
        drawn.word = select(layer_word(SURFACE, UNCOUNTED, 0u), UNRELIABLE, found.x == 0u);
        drawn.normal = found.x;
    }
    let decision = decide(xy, Lanes(lane_bits, lane_count, near_inside, overlaps), drawn);
    write(xy, decision, decision.crossing);
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
            decide_pixel(xy);
        }
    }
}
