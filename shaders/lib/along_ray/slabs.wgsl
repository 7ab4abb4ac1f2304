// The slabs of up to eight clip-surfaces: a slab is the space between the least and the greatest height of the surface. On which side of
// each slab a fragment is, and between which depths a ray is in a slab.
//
// A fragment that is not within a slab compares with every crossing of its surface as its side implies, because slabs are widened by the
// errors of both depths and of the coefficients along the ray: see `docs/algorithm.md`.

#define_import_path cutaway::slabs

#import cutaway::fours::has_second_four
#import cutaway::frame::{centre_of, depth_from_buffer, frame}
#import cutaway::planes::bits_of
#import cutaway::rays::{RaysOfFour, four_along_ray, ray_table}

// One bit for each clip-surface.
struct SlabSides {
    // The slab holds the fragment, or is too close for a decision.
    within: u32,
    // Of the others: the fragment is on the removed side; the slab is in front of it.
    removed: u32,
    behind: u32,
}

struct FourSides {
    within: vec4<bool>,
    removed: vec4<bool>,
    behind: vec4<bool>,
}

fn four_sides(rays: RaysOfFour, at_px: vec2<f32>, depth: f32, reach: f32) -> FourSides {
    let heights = four_along_ray(rays, at_px);
    let height = heights.origin + depth * heights.direction;
    let error = reach * rays.rounding;
    let kept = height > rays.kept_above + error;
    let removed = height < rays.removed_below - error;
    // A height changes in one direction along the ray.
    return FourSides(!(kept | removed), removed, (kept | removed) & (kept == (heights.direction > vec4<f32>(0.0))));
}

// The sides of a fragment at depth-buffer value `z` of the pixel `at`.
fn slab_sides(z: f32, at: vec2<u32>) -> SlabSides {
    let depth = depth_from_buffer(z);
    // In orthographic views the error of a depth is a fraction of the farthest one.
    let reach = select(abs(depth), abs(frame.near) + abs(frame.far), frame.orthographic != 0u);
    let first = four_sides(ray_table.planes[0], centre_of(at), depth, reach);
    var last = FourSides(vec4<bool>(false), vec4<bool>(false), vec4<bool>(false));
    if has_second_four() {
        last = four_sides(ray_table.planes[1], centre_of(at), depth, reach);
    }
    return SlabSides(
        bits_of(first.within, last.within),
        bits_of(first.removed, last.removed),
        bits_of(first.behind, last.behind),
    );
}

// The depths between which a ray may be in four slabs; first > last where it is in none.
struct FourIntervals {
    first: vec4<f32>,
    last: vec4<f32>,
    rises: vec4<bool>,
}

struct SlabIntervals {
    first: FourIntervals,
    last: FourIntervals,
}

// Farther than any fragment, and farther than that.
const FAR: f32 = 3.0e38;
const UNREACHED: f32 = 3.4e38;

fn four_intervals(rays: RaysOfFour, at_px: vec2<f32>) -> FourIntervals {
    let heights = four_along_ray(rays, at_px);
    let up = (rays.kept_above - heights.origin) / heights.direction;
    let down = (rays.removed_below - heights.origin) / heights.direction;
    // A ray that keeps its height up to rounding may be in the slab anywhere. Others are in the slab a little before and behind it.
    let is_level = abs(heights.direction) <= 4.0 * rays.rounding;
    let orthographic_reach = select(0.0, abs(frame.near) + abs(frame.far), frame.orthographic != 0u);
    let reach = max(max(abs(up), abs(down)), vec4<f32>(orthographic_reach));
    let slack = 2.0 * reach * rays.rounding / abs(heights.direction);
    let is_used = rays.kept_above >= rays.removed_below;
    let first = select(min(up, down) - slack, vec4<f32>(-FAR), is_level);
    let last = select(max(up, down) + slack, vec4<f32>(FAR), is_level);
    return FourIntervals(
        select(vec4<f32>(UNREACHED), first, is_used),
        select(vec4<f32>(-UNREACHED), last, is_used),
        heights.direction > vec4<f32>(0.0),
    );
}

fn slab_intervals(at: vec2<u32>) -> SlabIntervals {
    let none = FourIntervals(vec4<f32>(UNREACHED), vec4<f32>(-UNREACHED), vec4<bool>(false));
    let first = four_intervals(ray_table.planes[0], centre_of(at));
    if !has_second_four() {
        return SlabIntervals(first, none);
    }
    return SlabIntervals(first, four_intervals(ray_table.planes[1], centre_of(at)));
}

// The depths between which a ray may be in the slab of one clip-surface.
fn interval_of(slabs: SlabIntervals, surface: u32) -> vec2<f32> {
    let place = surface % 4u;
    let first = vec2<f32>(slabs.first.first[place], slabs.first.last[place]);
    let last = vec2<f32>(slabs.last.first[place], slabs.last.last[place]);
    return select(last, first, surface < 4u);
}

// Bits of the clip-surfaces in whose slabs the ray may be between two depths.
fn slabs_between(slabs: SlabIntervals, depths: vec2<f32>) -> u32 {
    return bits_of(
        (slabs.first.first <= vec4<f32>(depths.y)) & (slabs.first.last >= vec4<f32>(depths.x)),
        (slabs.last.first <= vec4<f32>(depths.y)) & (slabs.last.last >= vec4<f32>(depths.x)),
    );
}

// Bits of the clip-surfaces whose slabs the ray has left before a depth.
fn slabs_before(slabs: SlabIntervals, depth: f32) -> u32 {
    return bits_of(slabs.first.last < vec4<f32>(depth), slabs.last.last < vec4<f32>(depth));
}

// Bits of the clip-surfaces over whose planes the ray rises.
fn rising(slabs: SlabIntervals) -> u32 {
    return bits_of(slabs.first.rises, slabs.last.rises);
}
