// Writes the mask by sampling each part's volume image (the open module `volume`) at the relevant points: where the part goes from removed
// to kept, and where the ray begins if the near plane may be inside a solid. One invocation owns a pixel.

#import cutaway::crossings::{depth_at, head_of, surface_at}
#import cutaway::cuts::{is_removed, parts}
#import cutaway::frame::{frame, Ray, centre_of, pixel_index, ray_through}
#import cutaway::lanes::MOST_LANES
#import cutaway::reduced::{doubt, toggle, toggle_bit}
#import cutaway::volume::probe

override lane_bits: u32 = 32u;
override near_inside: bool = false;
// First part-table index of the tested parts.
override first_place: u32 = 0u;
override end_place: u32 = 1u;

fn asked(place: u32, pixel: u32, ray: Ray, depth: f32) -> bool {
    let answer = probe(place, ray.origin + depth * ray.direction);
    if answer.in_doubt {
        doubt(pixel);
    }
    return answer.is_inside;
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let head = head_of(id.xy);
    let ray = ray_through(centre_of(id.xy));
    for (var place = first_place; place < min(end_place, MOST_LANES); place++) {
        let part = parts[place];
        let cuts = part.cuts;
        var bits = 0u;
        var sides = head.sides;
        if near_inside && !is_removed(sides, cuts) && asked(place, pixel, ray, frame.near) {
            toggle_bit(pixel, part.lane_word, part.lane_shift, lane_bits - 1u);
        }
        for (var i = 0u; i < head.count; i++) {
            let after = sides ^ (1u << surface_at(head, i, id.xy));
            if is_removed(sides, cuts) && !is_removed(after, cuts) {
                bits |= select(0u, 1u << (i % 32u), asked(place, pixel, ray, depth_at(head, i, id.xy)));
            }
            sides = after;
            if i % 32u == 31u || i + 1u == head.count {
                toggle(pixel, part.lane_word + i / 32u, bits << part.lane_shift);
                bits = 0u;
            }
        }
    }
}
