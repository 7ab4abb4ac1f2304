// One invocation decides one pixel: the nearest crossing at which some part goes from removed to kept while the mask says that
// the crossing is inside it, or the surface that survived, whichever comes first in the list's own order.

#import cutaway::crossings::{crossing_heads, rank_of, surface_at, z_at}
#import cutaway::cuts::{cut_table, is_removed, parts}
#import cutaway::frame::{frame, centre_of, depth_from_buffer, pixel_count, pixel_index, ray_through}
#import cutaway::layers::{BACKGROUND, CAP, NEAR_PLANE, UNRANKED, UNRELIABLE, WORDS_PER_PIXEL, clip_surface_of, kind_of, layer_word, pack_normal}
#import cutaway::relief::cap_normal

@group(1) @binding(0) var surface_words: texture_2d<u32>;
@group(1) @binding(1) var surface_depth: texture_depth_2d;
@group(1) @binding(2) var<storage, read> mask: array<u32>;
@group(1) @binding(3) var<storage, read_write> layers: array<u32>;

override lane_bits: u32 = 32u;
override lane_count: u32 = 1u;
// Whether some clip-surface is a relief: otherwise its normal is the plane's.
override reliefs: bool = true;
// Whether the near plane meets a solid: then an odd total says that the ray starts inside, not that the mesh is open.
override near_inside: bool = false;

// The lane of a part, aligned to bit 0.
fn lane_of(rank: u32, pixel: u32) -> u32 {
    let word = mask[parts[rank].lane_word * pixel_count() + pixel];
    return (word >> parts[rank].lane_shift) & (0xffffffffu >> (32u - lane_bits));
}

fn total_is_odd(lane: u32) -> bool {
    return (lane >> (lane_bits - 1u)) != 0u;
}

struct Cap {
    found: bool,
    rank: u32,
    crossing: u32,
}

// The first cap among the crossings before `limit`.
fn first_cap(pixel: u32, limit: u32, start: u32) -> Cap {
    var sides = start;
    for (var i = 0u; i < limit; i++) {
        let after = sides ^ (1u << surface_at(i, pixel));
        for (var rank = 0u; rank < lane_count; rank++) {
            let inside = ((lane_of(rank, pixel) >> i) & 1u) != 0u;
            if inside && is_removed(sides, parts[rank].cuts) && !is_removed(after, parts[rank].cuts) {
                return Cap(true, rank, i);
            }
        }
        sides = after;
    }
    return Cap(false, 0u, 0u);
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let head = crossing_heads[pixel];
    let drawn = textureLoad(surface_words, id.xy, 0).xy;
    var word = drawn.x;
    var normal = drawn.y;
    var depth = depth_from_buffer(textureLoad(surface_depth, id.xy, 0));
    var limit = head.x & 0xffu;
    if kind_of(word) != BACKGROUND {
        // The surface's place in the list stands where its clip-surface would, unless its part was drawn plainly.
        limit = clip_surface_of(word);
        if limit == UNRANKED {
            limit = rank_of(textureLoad(surface_depth, id.xy, 0), pixel).behind;
        }
        word &= 0xffff00ffu;
    }

    let ray = ray_through(centre_of(id.xy));
    let cap = first_cap(pixel, limit, head.y);
    if cap.found {
        // The crossing was moved by the tie towards the eye: move it back to where the clip-surface is.
        let z = (z_at(cap.crossing, pixel) - frame.tie.y) / (1.0 + frame.tie.x);
        let surface = surface_at(cap.crossing, pixel);
        depth = depth_from_buffer(z);
        word = layer_word(CAP, cut_table.surfaces[surface].surface, parts[cap.rank].part);
        var outside = -cut_table.surfaces[surface].normal.xyz;
        if reliefs {
            outside = cap_normal(surface, ray.origin + depth * ray.direction);
        }
        normal = pack_normal(outside);
    }

    var odd = false;
    for (var rank = lane_count; rank > 0u; rank--) {
        if total_is_odd(lane_of(rank - 1u, pixel)) {
            odd = true;
            if near_inside && frame.near_cap != 0u && !is_removed(head.y, parts[rank - 1u].cuts) {
                depth = frame.near;
                word = layer_word(CAP, NEAR_PLANE, parts[rank - 1u].part);
                normal = pack_normal(-frame.forward.xyz);
            }
        }
    }
    let overflowed = (head.x & 0x80000000u) != 0u;
    if overflowed || (odd && !near_inside) {
        word |= UNRELIABLE;
    }
    let at = pixel * WORDS_PER_PIXEL;
    layers[at] = word;
    layers[at + 1u] = normal;
    layers[at + 2u] = bitcast<u32>(depth);
}
