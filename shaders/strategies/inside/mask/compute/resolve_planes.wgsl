// One invocation decides one pixel, where all clip-surfaces are planes: the normal of a cap is the plane's.
// The compute rasteriser drew.

#import cutaway::cuts::cut_table
#import cutaway::decision::{Lanes, NONE, decide, drawn_in_layers, write}
#import cutaway::frame::frame
#import cutaway::layers::pack_normal

override lane_bits: u32 = 32u;
override lane_count: u32 = 1u;
override near_inside: bool = false;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let decision = decide(id.xy, Lanes(lane_bits, lane_count, near_inside), drawn_in_layers(id.xy));
    var normal = 0u;
    if decision.surface != NONE {
        normal = pack_normal(-cut_table.surfaces[decision.surface].normal.xyz);
    }
    write(id.xy, decision, normal);
}
