// Reading the one list of crossings per pixel. Bound as @group(0) @binding(5), (6) and (7).
//
// Crossing i of a pixel is at depth-buffer value crossing_z[i * pixels + pixel], nearest first, so a fragment's `behind`
// is how many crossings it has in front of it. The list is written once per frame and decides everything: which fragment
// is kept, where a cap may be, and whether it is inside.

#define_import_path cutaway::crossings

#import cutaway::cuts::cut_table
#import cutaway::frame::{depth_from_buffer, frame, is_behind, pixel_count}

// Bits 0-7 how many crossings, bit 31 set when the list could not hold them all or is not vouched for; and the sides where the ray starts.
@group(0) @binding(5) var<storage, read> crossing_heads: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read> crossing_z: array<f32>;
// Clip-surface of each crossing; not stored where there is only one.
@group(0) @binding(7) var<storage, read> crossing_surface: array<u32>;

fn surface_at(index: u32, pixel: u32) -> u32 {
    if cut_table.surface_count == 1u {
        return 0u;
    }
    return crossing_surface[index * pixel_count() + pixel];
}

fn z_at(index: u32, pixel: u32) -> f32 {
    return crossing_z[index * pixel_count() + pixel];
}

// Depth of the clip-surface at a crossing at which some part enters what is kept: the crossing was moved by the tie towards the
// eye, and is moved back.
fn depth_at(index: u32, pixel: u32) -> f32 {
    return depth_from_buffer((z_at(index, pixel) - frame.tie.y) / (1.0 + frame.tie.x));
}

struct Rank {
    // How many crossings are in front.
    behind: u32,
    // Sides after these crossings.
    sides: u32,
}

fn rank_of(z: f32, pixel: u32) -> Rank {
    let head = crossing_heads[pixel];
    let count = head.x & 0xffu;
    var rank = Rank(0u, head.y);
    for (var i = 0u; i < count; i++) {
        if !is_behind(z, z_at(i, pixel)) {
            break;
        }
        rank.behind++;
        rank.sides ^= 1u << surface_at(i, pixel);
    }
    return rank;
}
