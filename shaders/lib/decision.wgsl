// What a pixel shows, decided: the nearest crossing at which some part goes from removed to kept while the mask says that the
// crossing is inside it, or the surface that survived, whichever comes first in the list's own order. Normals of caps are left to
// the shader, since only reliefs need heights for them.
//
// Bound as @group(1) @binding(2) and (3). Who drew the surfaces gives them as `Drawn`.

#define_import_path cutaway::decision

#import cutaway::crossings::{crossing_heads, rank_of, surface_at, z_at}
#import cutaway::cuts::{cut_table, is_removed, parts}
#import cutaway::frame::{frame, depth_from_buffer, pixel_count, pixel_index}
#import cutaway::layers::{BACKGROUND, CAP, NEAR_PLANE, UNRANKED, UNRELIABLE, WORDS_PER_PIXEL, clip_surface_of, kind_of, layer_word, pack_normal}

@group(1) @binding(2) var<storage, read> mask: array<u32>;
@group(1) @binding(3) var<storage, read_write> layers: array<u32>;

// How the mask is laid out, and whether the near plane meets a solid: then an odd total says that the ray starts inside, not that
// the mesh is open.
struct Lanes {
    bits: u32,
    count: u32,
    near_inside: bool,
}

// The nearest surface that survived: the first two words of its layer, and its depth-buffer value.
struct Drawn {
    word: u32,
    normal: u32,
    z: f32,
}

struct Decision {
    word: u32,
    normal: u32,
    depth: f32,
    // Clip-surface whose normal is still wanted, or NONE.
    surface: u32,
}

const NONE: u32 = 0xffffffffu;

// The lane of a part, aligned to bit 0.
fn lane_of(lanes: Lanes, rank: u32, pixel: u32) -> u32 {
    let word = mask[parts[rank].lane_word * pixel_count() + pixel];
    return (word >> parts[rank].lane_shift) & (0xffffffffu >> (32u - lanes.bits));
}

fn total_is_odd(lanes: Lanes, lane: u32) -> bool {
    return (lane >> (lanes.bits - 1u)) != 0u;
}

struct Cap {
    found: bool,
    rank: u32,
    crossing: u32,
}

// The first cap among the crossings before `limit`.
fn first_cap(lanes: Lanes, pixel: u32, limit: u32, start: u32) -> Cap {
    var sides = start;
    for (var i = 0u; i < limit; i++) {
        let after = sides ^ (1u << surface_at(i, pixel));
        for (var rank = 0u; rank < lanes.count; rank++) {
            let inside = ((lane_of(lanes, rank, pixel) >> i) & 1u) != 0u;
            if inside && is_removed(sides, parts[rank].cuts) && !is_removed(after, parts[rank].cuts) {
                return Cap(true, rank, i);
            }
        }
        sides = after;
    }
    return Cap(false, 0u, 0u);
}

// Decides a pixel.
fn decide(at: vec2<u32>, lanes: Lanes, drawn: Drawn) -> Decision {
    let pixel = pixel_index(at);
    let head = crossing_heads[pixel];
    var word = drawn.word;
    var normal = drawn.normal;
    var depth = depth_from_buffer(drawn.z);
    var limit = head.x & 0xffu;
    if kind_of(word) != BACKGROUND {
        // The surface's place in the list stands where its clip-surface would, unless its part was drawn plainly.
        limit = clip_surface_of(word);
        if limit == UNRANKED {
            limit = rank_of(drawn.z, pixel).behind;
        }
        word &= 0xffff00ffu;
    }

    var wanted = NONE;
    let cap = first_cap(lanes, pixel, limit, head.y);
    if cap.found {
        // The crossing was moved by the tie towards the eye: move it back to where the clip-surface is.
        let z = (z_at(cap.crossing, pixel) - frame.tie.y) / (1.0 + frame.tie.x);
        let surface = surface_at(cap.crossing, pixel);
        depth = depth_from_buffer(z);
        word = layer_word(CAP, cut_table.surfaces[surface].surface, parts[cap.rank].part);
        wanted = surface;
    }

    var odd = false;
    for (var rank = lanes.count; rank > 0u; rank--) {
        if total_is_odd(lanes, lane_of(lanes, rank - 1u, pixel)) {
            odd = true;
            if lanes.near_inside && frame.near_cap != 0u && !is_removed(head.y, parts[rank - 1u].cuts) {
                depth = frame.near;
                word = layer_word(CAP, NEAR_PLANE, parts[rank - 1u].part);
                normal = pack_normal(-frame.forward.xyz);
                wanted = NONE;
            }
        }
    }
    let overflowed = (head.x & 0x80000000u) != 0u;
    if overflowed || (odd && !lanes.near_inside) {
        word |= UNRELIABLE;
    }
    return Decision(word, normal, depth, wanted);
}

// The surface that the compute rasteriser left in the layers.
fn drawn_in_layers(at: vec2<u32>) -> Drawn {
    let first = pixel_index(at) * WORDS_PER_PIXEL;
    return Drawn(layers[first], layers[first + 1u], bitcast<f32>(layers[first + 2u]));
}

// Writes a decision, with the normal of its cap where one was wanted.
fn write(at: vec2<u32>, decision: Decision, normal: u32) {
    let first = pixel_index(at) * WORDS_PER_PIXEL;
    layers[first] = decision.word;
    layers[first + 1u] = select(normal, decision.normal, decision.surface == NONE);
    layers[first + 2u] = bitcast<u32>(decision.depth);
}
