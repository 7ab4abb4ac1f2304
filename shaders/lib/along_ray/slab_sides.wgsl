// Whether a fragment is in front of a relief, behind it, or neither for certain, by its slab alone: the space between the least and the
// greatest height of the relief. Used if the relief is the only clip-surface.
//
// A fragment that is not within the slab compares with every crossing as its class implies, because the slab is widened by the errors of
// both depths and of the coefficients along the ray: see `docs/algorithm.md`.

#define_import_path cutaway::slab_sides

#import cutaway::frame::{centre_of, depth_from_buffer, frame}
#import cutaway::rays::{along_ray, along_ray_terms, ray_table}
#import cutaway::slab::slab_beside
#import cutaway::surfaces::surface_of

struct SlabSide {
    // The slab holds the fragment, or is too close for a decision.
    is_within: bool,
    // If not: the fragment is on the removed side; the slab is in front of it.
    is_removed: bool,
    is_behind: bool,
}

// Error of a height over the plane, as a fraction of the sum of its terms: 16 roundings of f32, where 8 suffice.
const HEIGHT_ROUNDING: f32 = 1e-6;

// The class of a fragment at depth-buffer value `z` of the pixel `at`.
fn slab_side(z: f32, at: vec2<u32>) -> SlabSide {
    let depth = depth_from_buffer(z);
    // In orthographic views the error of a depth is a fraction of the farthest one.
    let reach = select(abs(depth), abs(frame.near) + abs(frame.far), frame.orthographic != 0u);
    let surface = surface_of(0u);
    let row = ray_table.surfaces[surface].height;
    let height = along_ray(row, centre_of(at));
    let slab = slab_beside(surface, height.x);
    let here = height.x + depth * height.y;
    let error = HEIGHT_ROUNDING * dot(along_ray_terms(row, centre_of(at)), vec2<f32>(1.0, reach));
    let is_kept = here > slab.y + error;
    let is_removed = here < slab.x - error;
    // The height changes in one direction along the ray.
    return SlabSide(!(is_kept || is_removed), is_removed, (is_kept || is_removed) && is_kept == (height.y > 0.0));
}
