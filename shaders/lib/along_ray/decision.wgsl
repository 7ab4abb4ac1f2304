// Decides what a pixel shows: the nearest crossing at which some part goes from removed to kept and the inside test is true for it, or the
// surviving surface, whichever comes first in the list's own order. Cap normals are left to the shader, since only reliefs need heights for
// them.
//
// Bound as @group(1) @binding(3). The code that drew the surfaces supplies them as `Drawn`; the open module `inside` does the inside test.

#define_import_path cutaway::decision

#import cutaway::crossings::{cappable, crossings_before, depth_at, head_of, is_cut_short, surface_at, word_at}
#import cutaway::cuts::{cut_table, is_removed, parts}
#import cutaway::frame::{frame, depth_from_buffer, pixel_index}
#import cutaway::inside::{in_doubt, is_blank, next_inside, next_starting}
#import cutaway::lanes::{Lanes, MOST_CROSSINGS, MOST_LANES}
#import cutaway::layers::{BACKGROUND, CAP, NEAR_PLANE, OVERLAP, UNCOUNTED, UNRELIABLE, WORDS_PER_PIXEL, clip_surface_of, kind_of, layer_word, pack_normal}
#import cutaway::passed::Head

@group(1) @binding(3) var<storage, read_write> layers: array<u32>;

// The nearest surviving surface: the first two words of its layer, and its depth-buffer value.
struct Drawn {
    word: u32,
    normal: u32,
    z: f32,
}

struct Decision {
    word: u32,
    normal: u32,
    depth: f32,
    // Word of the crossing whose normal is still needed, or NONE, which no word equals.
    crossing: u32,
}

const NONE: u32 = 0xffffffffu;

struct Cap {
    found: bool,
    place: u32,
    crossing: u32,
    // Other parts begin to be kept inside there too.
    overlap: bool,
}

// The first cap among the crossings from `among.x` to before `among.y`. Parts are tested in order, and the first match wins; a second part
// that shares the cap is searched for only if shared caps are displayed.
fn first_cap(lanes: Lanes, at: vec2<u32>, among: vec2<u32>, head: Head) -> Cap {
    var sides = head.sides;
    var cap = Cap(false, 0u, 0u, false);
    for (var i = 0u; i < min(among.y, MOST_CROSSINGS); i++) {
        let after = sides ^ (1u << surface_at(head, i, at));
        var place = 0u;
        let most = select(0u, min(lanes.count, MOST_LANES), i >= among.x);
        for (var n = 0u; n < most; n++) {
            place = next_inside(lanes, place, at, i);
            if place >= lanes.count {
                break;
            }
            let enters = is_removed(sides, parts[place].cuts) && !is_removed(after, parts[place].cuts);
            if enters {
                if cap.found {
                    cap.overlap = true;
                    return cap;
                }
                cap = Cap(true, place, i, false);
                if !lanes.overlaps {
                    return cap;
                }
            }
            place++;
        }
        if cap.found {
            return cap;
        }
        sides = after;
    }
    return cap;
}

// Decides a pixel.
fn decide(at: vec2<u32>, lanes: Lanes, drawn: Drawn) -> Decision {
    var word = drawn.word;
    var normal = drawn.normal;
    var depth = depth_from_buffer(drawn.z);
    if kind_of(word) == BACKGROUND && is_blank(lanes, at) && !is_cut_short(at) {
        // The common case in most pictures.
        return Decision(word, normal, depth, NONE);
    }
    let head = head_of(at);
    var among = cappable(at);
    if kind_of(word) != BACKGROUND {
        // The word holds the surface's position in the list in its clip-surface bits, unless its part was drawn plainly.
        var before = clip_surface_of(word);
        if before == UNCOUNTED {
            before = crossings_before(drawn.z, at).behind;
        }
        among.y = min(among.y, before);
        word &= 0xffff00ffu;
    }

    var wanted = NONE;
    let cap = first_cap(lanes, at, among, head);
    if cap.found {
        let surface = surface_at(head, cap.crossing, at);
        depth = depth_at(head, cap.crossing, at);
        word = layer_word(CAP, cut_table.surfaces[surface].surface, parts[cap.place].part) | select(0u, OVERLAP, cap.overlap);
        wanted = word_at(head, cap.crossing, at);
    }

    var odd = false;
    var near_caps = 0u;
    var place = 0u;
    for (var n = 0u; n < min(lanes.count, MOST_LANES); n++) {
        place = next_starting(lanes, place, at);
        if place >= lanes.count {
            break;
        }
        odd = true;
        if lanes.near_inside && frame.near_cap != 0u && !is_removed(head.sides, parts[place].cuts) {
            // The first part owns the cap.
            if near_caps == 0u {
                depth = frame.near;
                word = layer_word(CAP, NEAR_PLANE, parts[place].part);
                normal = pack_normal(-frame.forward.xyz);
                wanted = NONE;
            }
            near_caps++;
        }
        place++;
    }
    word |= select(0u, OVERLAP, lanes.overlaps && near_caps > 1u);
    if is_cut_short(at) || in_doubt(lanes, at) || (odd && !lanes.near_inside) {
        word |= UNRELIABLE;
    }
    return Decision(word, normal, depth, wanted);
}

// Writes a decision, with the cap normal if one was needed.
fn write(at: vec2<u32>, decision: Decision, normal: u32) {
    let first = pixel_index(at) * WORDS_PER_PIXEL;
    layers[first] = decision.word;
    layers[first + 1u] = select(normal, decision.normal, decision.crossing == NONE);
    layers[first + 2u] = bitcast<u32>(decision.depth);
}
