// Reads the per-pixel list of crossings. Bound as @group(0) @binding(5), (6) and (7).
//
// Crossing i of a pixel is at depth-buffer value crossing_z[i * pixels + pixel], nearest first, so a fragment's `behind` is the number of
// crossings in front of the fragment. The list is written once per frame. All decisions use it: which fragments are kept, which crossings
// may be caps, and which caps are inside a solid.

#define_import_path cutaway::crossings

#import cutaway::cuts::cut_table
#import cutaway::frame::{depth_from_buffer, is_behind, pixel_count, pixel_index}
#import cutaway::lanes::MOST_CROSSINGS
#import cutaway::passed::{Before, Head}
#import cutaway::surfaces::{keeps_words, surface_of}

// Bits 0-9: number of crossings; bit 31: the list overflowed or may be wrong. Second word: the sides where the ray starts.
@group(0) @binding(5) var<storage, read> crossing_heads: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read> crossing_z: array<f32>;
// Word of each crossing (`crossing_words`); not stored if there is only one clip-surface and it carries no normals.
@group(0) @binding(7) var<storage, read> crossing_surface: array<u32>;

fn head_of(at: vec2<u32>) -> Head {
    let head = crossing_heads[pixel_index(at)];
    return Head(head.x & MOST_CROSSINGS, head.y, 0u);
}

// True if a pixel's list overflowed, or may be wrong.
fn is_cut_short(at: vec2<u32>) -> bool {
    return (crossing_heads[pixel_index(at)].x & 0x80000000u) != 0u;
}

// The crossings that may be caps, from the first to before the second: all crossings in the list.
fn cappable(at: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(0u, head_of(at).count);
}

// A crossing's word: its clip-surface and other stored data.
fn word_at(head: Head, index: u32, at: vec2<u32>) -> u32 {
    if !keeps_words() {
        return 0u;
    }
    return crossing_surface[index * pixel_count() + pixel_index(at)];
}

fn surface_at(head: Head, index: u32, at: vec2<u32>) -> u32 {
    return surface_of(word_at(head, index, at));
}

fn z_at(head: Head, index: u32, at: vec2<u32>) -> f32 {
    return crossing_z[index * pixel_count() + pixel_index(at)];
}

// Depth of the clip-surface at a crossing.
fn depth_at(head: Head, index: u32, at: vec2<u32>) -> f32 {
    return depth_from_buffer(z_at(head, index, at));
}

// Lists up to this length are searched linearly.
const SHORT: u32 = 8u;

// Counts the crossings in front of `z`. A long list is searched by bisection, 10 steps for 1023 crossings, unless the clip-surface of each
// crossing in front must be read anyway. Both searches share a loop: every mesh sample runs this, and even an unentered loop has a cost.
fn crossings_before(z: f32, at: vec2<u32>) -> Before {
    let head = head_of(at);
    let count = head.count;
    let halves = count > SHORT && cut_table.surface_count == 1u;
    let looks = select(count, firstLeadingBit(count) + 1u, halves);
    var found = Before(0u, head.sides);
    for (var i = 0u; i < looks; i++) {
        let ahead = found.behind + select(1u, 1u << (looks - 1u - i), halves);
        if ahead <= count && is_behind(z, z_at(head, ahead - 1u, at)) {
            // With bisection there is only one clip-surface, and each skipped crossing flips its side.
            let passed = select(1u << surface_at(head, ahead - 1u, at), (ahead - found.behind) & 1u, halves);
            found.sides ^= passed;
            found.behind = ahead;
        } else if !halves {
            break;
        }
    }
    return found;
}
