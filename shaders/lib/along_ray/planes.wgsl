// The crossings of a pixel's ray with the planes of up to eight clip-surfaces, all there are in the frame. They are recomputed on each use,
// four at a time, and nothing is stored. A crossing is numbered by its place along the ray, as in a list (`crossing_list`).

#define_import_path cutaway::planes

#import cutaway::cuts::cut_table
#import cutaway::fours::has_second_four
#import cutaway::frame::{are_behind, buffer_from_depth, frame}
#import cutaway::rays::{RaysOfFour, four_along_ray, ray_table}

const MOST_PLANES: u32 = 8u;
const BITS_OF_PLACE: u32 = 4u;

// The crossings with four planes.
struct Four {
    depth: vec4<f32>,
    // Depth-buffer values; 0 where the ray does not cross the plane, because nothing lies behind 0.
    z: vec4<f32>,
    // True where the ray goes to the kept side.
    rises: vec4<bool>,
    // True where the ray starts on the removed side.
    begins_removed: vec4<bool>,
}

struct Eight {
    first: Four,
    last: Four,
}

fn four_at(rays: RaysOfFour, at_px: vec2<f32>) -> Four {
    let heights = four_along_ray(rays, at_px);
    let rises = heights.direction > vec4<f32>(0.0);
    let depth = -heights.origin / heights.direction;
    let is_sloped = abs(heights.direction) > vec4<f32>(0.0);
    let is_crossed = is_sloped & (depth > vec4<f32>(frame.near));
    // A plane that is crossed before the ray starts has been left behind.
    let begins_removed = select(heights.origin < vec4<f32>(0.0), rises == is_crossed, is_sloped);
    let z = vec4<f32>(
        buffer_from_depth(depth.x),
        buffer_from_depth(depth.y),
        buffer_from_depth(depth.z),
        buffer_from_depth(depth.w),
    );
    return Four(depth, select(vec4<f32>(0.0), z, is_crossed), rises, begins_removed);
}

fn planes_at(at_px: vec2<f32>) -> Eight {
    let first = four_at(ray_table.planes[0], at_px);
    if !has_second_four() {
        return Eight(first, Four(vec4<f32>(0.0), vec4<f32>(0.0), vec4<bool>(false), vec4<bool>(false)));
    }
    return Eight(first, four_at(ray_table.planes[1], at_px));
}

// Bit i is set where answer i is true.
fn bits_of(first: vec4<bool>, last: vec4<bool>) -> u32 {
    let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), first)
        | select(vec4<u32>(0u), vec4<u32>(16u, 32u, 64u, 128u), last);
    return (bits.x | bits.y) | (bits.z | bits.w);
}

// Bits of the planes on whose removed side the ray starts.
fn starting_sides(planes: Eight) -> u32 {
    return bits_of(planes.first.begins_removed, planes.last.begins_removed);
}

// Bits of the planes that the ray crosses.
fn crossed(planes: Eight) -> u32 {
    return passed_before(planes, 0.0);
}

// Bits of the planes that are crossed in front of `z`.
fn passed_before(planes: Eight, z: f32) -> u32 {
    return bits_of(are_behind(z, planes.first.z), are_behind(z, planes.last.z));
}

// Bits of the planes that are crossed in front of a depth.
fn passed_at_depth(planes: Eight, depth: f32) -> u32 {
    return crossed(planes) & bits_of(planes.first.depth <= vec4<f32>(depth), planes.last.depth <= vec4<f32>(depth));
}

// Depth-buffer value of the crossing with a plane.
fn z_of(planes: Eight, surface: u32) -> f32 {
    return select(planes.last.z[surface % 4u], planes.first.z[surface % 4u], surface < 4u);
}

// The planes that are crossed, in order along the ray, BITS_OF_PLACE bits each. Among crossings at one depth those to the removed side come
// first, in the order of their planes; then those to the kept side, in reverse.
fn order_of(planes: Eight) -> u32 {
    let rising = bits_of(planes.first.rises, planes.last.rises);
    var order = 0u;
    for (var surface = 0u; surface < min(cut_table.surface_count, MOST_PLANES); surface++) {
        let z = z_of(planes, surface);
        let passed = passed_before(planes, z);
        let at_it = bits_of(vec4<f32>(z) <= planes.first.z, vec4<f32>(z) <= planes.last.z) & ~passed;
        let lower = (1u << surface) - 1u;
        let is_rising = ((rising >> surface) & 1u) != 0u;
        let ahead = select(lower & ~rising, ~rising | ~(lower | (1u << surface)), is_rising);
        let place = countOneBits(passed | (at_it & ahead));
        order |= select(0u, surface << (BITS_OF_PLACE * place), z > 0.0);
    }
    return order;
}
