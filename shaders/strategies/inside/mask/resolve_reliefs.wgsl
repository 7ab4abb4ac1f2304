// One invocation decides one pixel, where some clip-surface is a relief: the normal of a cap is that of the bilinear height field.

#import cutaway::decision::{Lanes, NONE, decide, write}
#import cutaway::drawn::drawn_in_targets
#import cutaway::frame::{frame, centre_of, ray_through}
#import cutaway::layers::pack_normal
#import cutaway::relief::cap_normal

override lane_bits: u32 = 32u;
override lane_count: u32 = 1u;
override near_inside: bool = false;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let decision = decide(id.xy, Lanes(lane_bits, lane_count, near_inside), drawn_in_targets(id.xy));
    var normal = 0u;
    if decision.surface != NONE {
        let ray = ray_through(centre_of(id.xy));
        normal = pack_normal(cap_normal(decision.surface, ray.origin + decision.depth * ray.direction));
    }
    write(id.xy, decision, normal);
}
