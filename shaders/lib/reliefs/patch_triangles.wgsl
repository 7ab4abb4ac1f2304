// The triangles of a patch, for one view, shared among invocations: after a fixed number of halvings of its two root triangles, each
// invocation gets one triangle with all its descendants; a triangle that is halved less often belongs to the first invocation within it.
// Nothing is stored on the way: a triangle is its vertices and the turns that led to it, and so are its neighbours. Bound as @group(1)
// @binding(11), (12).
//
// Every walk runs twice: to count, and to write once the workgroup has reserved its range in the index buffer. A walk ends after
// MOST_VISITS triangles, and then the workgroup writes nothing: drivers kill long-running invocations, and others wait for them.

#define_import_path cutaway::patch_triangles

#import cutaway::bisection::{Triangle, half_of, root_of, whole_of}
#import cutaway::domain::domains
#import cutaway::refinement::{ALL_BORDERS, OUTSIDE, borders_across, greatest_depth, is_halved, refinements}
#import cutaway::sums::sums_before

@group(1) @binding(11) var<storage, read_write> triangles: array<u32>;
@group(1) @binding(12) var<storage, read_write> arguments: array<atomic<u32>>;

// An invocation's share of a patch.
struct Share {
    // Index of the clip-surface in the table, and its number among the tessellated ones.
    surface: u32,
    slot: u32,
    patch_at: vec2<i32>,
    // Halvings until each invocation has its own triangle, and its number among all that share the patch.
    shared_halvings: u32,
    number: u32,
}

// Halvings until each of the 64 invocations of one workgroup has its own triangle. Visibility is tested up to this depth.
const SHARED: u32 = 5u;
// Most halvings of a triangle within one invocation.
const MOST_OWN_HALVINGS: u32 = 10u;
// Most triangles in a walk: all from `MOST_OWN_HALVINGS` halvings, and at most 32 on the way there.
const MOST_VISITS: u32 = (2u << MOST_OWN_HALVINGS) + 32u;
// Result of a walk that was cut short; greater than the sum of 64 complete walks.
const TOO_MANY: u32 = 1u << 20u;

var<workgroup> place: u32;

// Halvings by which a deep patch is shared, so that none of its walks is cut short.
fn deep_halvings(surface: u32) -> u32 {
    return max(greatest_depth(surface), SHARED + MOST_OWN_HALVINGS) - MOST_OWN_HALVINGS;
}

fn packed(at: vec2<i32>) -> u32 {
    return u32(at.x) | (u32(at.y) << 16u);
}

fn write(share: Share, at: u32, triangle: Triangle) {
    let capacity = refinements.surfaces[share.surface].capacity;
    if at >= capacity {
        return;
    }
    let first = 3u * (capacity * share.slot + at);
    let is_mirrored = domains.surfaces[share.surface].mirrored != 0u;
    triangles[first] = packed(triangle.apex);
    triangles[first + 1u] = packed(select(triangle.a, triangle.b, is_mirrored));
    triangles[first + 2u] = packed(select(triangle.b, triangle.a, is_mirrored));
}

// Walks the triangles of a share; returns their number, or TOO_MANY. They are written from index `at` on, unless they are only counted.
fn walk(share: Share, at: u32, writes: bool) -> u32 {
    let surface = share.surface;
    let shared_halvings = share.shared_halvings;
    let size = 1i << (domains.surfaces[surface].patch_bits + domains.surfaces[surface].step_bits);
    var triangle = root_of(share.patch_at, (share.number >> shared_halvings) == 1u, size);
    var depth = 0u;
    // The borders of the view and of the box that the triangle may cross.
    var borders = ALL_BORDERS;
    // Turns taken since this invocation's triangle, the last in the lowest bit.
    var turns = 0u;
    var found = 0u;
    for (var visit = 0u; visit < MOST_VISITS; visit++) {
        if depth <= SHARED {
            borders = borders_across(surface, triangle, borders);
            if borders == OUTSIDE {
                return found;
            }
        }
        if is_halved(surface, triangle, depth) {
            var second = false;
            if depth < shared_halvings {
                second = ((share.number >> (shared_halvings - 1u - depth)) & 1u) == 1u;
            } else {
                turns = turns << 1u;
            }
            triangle = half_of(triangle, second);
            depth++;
            continue;
        }
        let others = (1u << (shared_halvings - min(depth, shared_halvings))) - 1u;
        if (share.number & others) == 0u {
            if writes {
                write(share, at + found, triangle);
            }
            found++;
        }
        // Proceeds to the next triangle: up past second halves, and from the first half to the second.
        for (var up = 0u; up < 32u && depth > shared_halvings && (turns & 1u) == 1u; up++) {
            triangle = whole_of(triangle, true);
            turns = turns >> 1u;
            depth--;
        }
        if depth <= shared_halvings {
            return found;
        }
        triangle = half_of(whole_of(triangle, false), true);
        turns |= 1u;
    }
    return TOO_MANY;
}

// Writes the triangles of a workgroup. If a walk was cut short, returns false in all invocations of the workgroup.
fn write_shares(share: Share, local: u32) -> bool {
    let own = walk(share, 0u, false);
    let found = sums_before(own, local, SHARED + 1u);
    let can = found.y < TOO_MANY;
    if local == 0u && can && found.y > 0u {
        place = atomicAdd(&arguments[5u * share.slot], found.y);
    }
    workgroupBarrier();
    if can && own > 0u {
        walk(share, place + found.x, true);
    }
    return can;
}
