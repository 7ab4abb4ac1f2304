// Makes the triangles of a clip-surface for one view. A workgroup owns a patch, an invocation one of the 64 triangles that it would
// be halved into five times over, with all that comes of it; a triangle that is not halved so often belongs to the first of those
// within it. Nothing is stored on the way: a triangle is its vertices and the turns that led to it, and so are its neighbours.
//
// Everything is walked through twice: to count, and to write once the workgroup has taken its place in the index buffer.

#import cutaway::bisection::{Triangle, half_of, root_of, whole_of}
#import cutaway::domain::domains
#import cutaway::refinement::{ALL_BORDERS, OUTSIDE, borders_across, is_halved, refinements}

@group(1) @binding(11) var<storage, read_write> triangles: array<u32>;
@group(1) @binding(12) var<storage, read_write> arguments: array<atomic<u32>>;

// Index of the clip-surface in the table, and number among those that are tessellated.
override surface: u32 = 0u;
override slot: u32 = 0u;
// Triangles that one invocation may look at.
override most_visits: u32 = 1u;

// Halvings until every invocation has a triangle of its own.
const SHARED: u32 = 5u;

var<workgroup> counts: array<u32, 64>;
var<workgroup> place: u32;

fn packed(at: vec2<i32>) -> u32 {
    return u32(at.x) | (u32(at.y) << 16u);
}

fn write(at: u32, triangle: Triangle) {
    let capacity = refinements.surfaces[surface].capacity;
    if at >= capacity {
        return;
    }
    let first = 3u * (capacity * slot + at);
    let is_mirrored = domains.surfaces[surface].mirrored != 0u;
    triangles[first] = packed(triangle.apex);
    triangles[first + 1u] = packed(select(triangle.a, triangle.b, is_mirrored));
    triangles[first + 2u] = packed(select(triangle.b, triangle.a, is_mirrored));
}

// Goes through the triangles of an invocation; how many there are. They are written from a place on, unless they are only counted.
fn walk(patch_at: vec2<i32>, invocation: u32, at: u32, writes: bool) -> u32 {
    let size = 1i << (domains.surfaces[surface].patch_bits + domains.surfaces[surface].step_bits);
    var triangle = root_of(patch_at, (invocation >> SHARED) == 1u, size);
    var depth = 0u;
    // Those of the view and of the box that lie across.
    var borders = ALL_BORDERS;
    // Turns since the triangle of this invocation, the last in the lowest bit.
    var turns = 0u;
    var found = 0u;
    var open = true;
    for (var visit = 0u; visit < most_visits && open; visit++) {
        if depth <= SHARED {
            borders = borders_across(surface, triangle, borders);
            if borders == OUTSIDE {
                break;
            }
        }
        if is_halved(surface, triangle, depth) {
            var second = false;
            if depth < SHARED {
                second = ((invocation >> (SHARED - 1u - depth)) & 1u) == 1u;
            } else {
                turns = turns << 1u;
            }
            triangle = half_of(triangle, second);
            depth++;
            continue;
        }
        let others = (1u << (SHARED - min(depth, SHARED))) - 1u;
        if (invocation & others) == 0u {
            if writes {
                write(at + found, triangle);
            }
            found++;
        }
        // On to the next: up past second halves, and from the first half to the second.
        for (var up = 0u; up < 32u && depth > SHARED && (turns & 1u) == 1u; up++) {
            triangle = whole_of(triangle, true);
            turns = turns >> 1u;
            depth--;
        }
        if depth <= SHARED {
            open = false;
        } else {
            triangle = half_of(whole_of(triangle, false), true);
            turns |= 1u;
        }
    }
    return found;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) invocation: u32) {
    let patch_at = vec2<i32>(group.xy);
    let own = walk(patch_at, invocation, 0u, false);
    counts[invocation] = own;
    workgroupBarrier();
    // Sums of doubling reach (Hillis & Steele 1986).
    for (var round = 0u; round < 6u; round++) {
        let reach = 1u << round;
        var sum = counts[invocation];
        if invocation >= reach {
            sum += counts[invocation - reach];
        }
        workgroupBarrier();
        counts[invocation] = sum;
        workgroupBarrier();
    }
    if invocation == 63u && counts[63] > 0u {
        place = atomicAdd(&arguments[5u * slot], counts[63]);
    }
    workgroupBarrier();
    if own > 0u {
        walk(patch_at, invocation, place + counts[invocation] - own, true);
    }
}
