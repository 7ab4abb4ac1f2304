// Decides what each pixel shows: surface or cap. One invocation owns one pixel.
//
// Open modules: `inside` answers the inside test, `drawn` gives the nearest kept surface, `cap_normal` the normals of caps.

#import cutaway::cap_normal::packed_cap_normal
#import cutaway::decision::{NONE, decide, write}
#import cutaway::drawn::drawn
#import cutaway::frame::frame
#import cutaway::lanes::Lanes

override lane_bits: u32 = 32u;
override lane_count: u32 = 1u;
override near_inside: bool = false;
override overlaps: bool = false;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let decision = decide(id.xy, Lanes(lane_bits, lane_count, near_inside, overlaps), drawn(id.xy));
    var normal = 0u;
    if decision.crossing != NONE {
        normal = packed_cap_normal(id.xy, decision.crossing, decision.depth);
    }
    write(id.xy, decision, normal);
}
