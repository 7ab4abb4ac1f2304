// Points of the picture in fixed point: 256 steps to a pixel, as in GPUs, so that both rasterisers cover the same samples. x to the right
// and y down; the sample of a pixel is at its centre, 128 steps into it.
//
// A point beyond a border cannot be snapped, and its triangles are clipped there: the near plane, and a guard band around the
// picture that keeps every difference of two coordinates below 2^23 steps. A triangle whose points all lie beyond the same border or
// the same side of the picture contains no sample.

#define_import_path cutaway::screen

#import cutaway::frame::frame

// Half the width of the guard band, in pixels from the upper left corner.
const GUARD_PX: f32 = 16000.0;
const BORDERS: u32 = 5u;
// Mask of the border bits; the bits of the picture sides follow.
const BEYOND_BORDERS: u32 = 31u;

// Greatest distance of a point inside the guard band from the middle of the picture, in half picture sizes.
fn guard_reach() -> vec2<f32> {
    return 2.0 * GUARD_PX / vec2<f32>(frame.size_px) - 1.0;
}

// Distance from a border, positive inside, in units of clip space: 0 is the near plane, 1 to 4 are the guard band.
fn distance_from(border: u32, clip: vec4<f32>) -> f32 {
    let reach = guard_reach() * clip.w;
    switch border {
        case 0u: { return clip.w - clip.z; }
        case 1u: { return reach.x + clip.x; }
        case 2u: { return reach.x - clip.x; }
        case 3u: { return reach.y + clip.y; }
        default: { return reach.y - clip.y; }
    }
}

// Bit b is set if the point is beyond border b.
fn borders_beyond(clip: vec4<f32>) -> u32 {
    var beyond = 0u;
    for (var border = 0u; border < BORDERS; border++) {
        beyond |= select(0u, 1u << border, distance_from(border, clip) < 0.0);
    }
    return beyond;
}

// Bits of the picture sides that a point is beyond, by more than a pixel: a snapped point may move back by a fraction of one. Linear in
// clip space, so it also holds between points beyond the same side, even where w is negative.
fn sides_beyond(clip: vec4<f32>) -> u32 {
    let reach = (1.0 + 2.0 / vec2<f32>(frame.size_px)) * clip.w;
    let beyond = vec4<bool>(reach.x + clip.x < 0.0, reach.x - clip.x < 0.0, reach.y + clip.y < 0.0, reach.y - clip.y < 0.0);
    let bits = select(vec4<u32>(0u), vec4<u32>(32u, 64u, 128u, 256u), beyond);
    return bits.x | bits.y | bits.z | bits.w;
}

// A point of the picture.
struct Point {
    // Position in pixels from the centre of the upper left pixel, so that samples are at integers.
    at: vec2<f32>,
    // Value of the depth buffer.
    z: f32,
    // Snapped position, in steps.
    steps: vec2<i32>,
}

// The picture position of a point in clip space: in pixels from the centre of the upper left pixel, and the depth-buffer value.
fn on_screen(clip: vec4<f32>) -> vec3<f32> {
    let size = vec2<f32>(frame.size_px);
    let at_px = clip.xy / clip.w * vec2<f32>(0.5, -0.5) * size + 0.5 * size;
    return vec3<f32>(at_px - 0.5, clip.z / clip.w);
}

// Snaps a point. The only inexact operation is one rounding, so all passes that snap a vertex get the same result.
fn snapped(at: vec3<f32>) -> Point {
    return Point(at.xy, at.z, vec2<i32>(round(at.xy * 256.0)) + 128);
}

// A vertex in the stored format, as bits: a screen position, or a clip-space position with the borders and sides beyond which it is. In
// clip space three numbers are stored, because w is constant in parallel views and z in others.
fn kept(clip: vec4<f32>) -> vec4<i32> {
    let beyond = borders_beyond(clip);
    let sides = sides_beyond(clip);
    if beyond == 0u {
        return vec4<i32>(bitcast<vec3<i32>>(on_screen(clip)), i32(sides));
    }
    let third = select(clip.w, clip.z, frame.orthographic != 0u);
    return vec4<i32>(bitcast<vec3<i32>>(vec3<f32>(clip.xy, third)), i32(beyond | sides));
}

// Bits of the borders beyond which a stored vertex lies.
fn borders_of(vertex: vec4<i32>) -> u32 {
    return u32(vertex.w) & BEYOND_BORDERS;
}

// True if all vertices of a triangle are beyond the same border or the same side of the picture: then it contains no sample.
fn is_beside(vertices: array<vec4<i32>, 3>) -> bool {
    return (vertices[0].w & vertices[1].w & vertices[2].w) != 0;
}

// True if some border clips a triangle.
fn is_clipped(vertices: array<vec4<i32>, 3>) -> bool {
    return (borders_of(vertices[0]) | borders_of(vertices[1]) | borders_of(vertices[2])) != 0u;
}

// A stored vertex that is beyond no border.
fn point_of(vertex: vec4<i32>) -> Point {
    return snapped(bitcast<vec3<f32>>(vertex.xyz));
}

// Clip-space position of a stored vertex.
fn clip_of_kept(vertex: vec4<i32>) -> vec4<f32> {
    let v = bitcast<vec3<f32>>(vertex.xyz);
    if borders_of(vertex) != 0u {
        return select(vec4<f32>(v.xy, frame.near, v.z), vec4<f32>(v, 1.0), frame.orthographic != 0u);
    }
    let size = vec2<f32>(frame.size_px);
    let at = (v.xy + 0.5 - 0.5 * size) / (vec2<f32>(0.5, -0.5) * size);
    let w = select(frame.near / v.z, 1.0, frame.orthographic != 0u);
    return vec4<f32>(at, v.z, 1.0) * w;
}

fn cross2(a: vec2<f32>, b: vec2<f32>) -> f32 {
    return a.x * b.y - a.y * b.x;
}

// The pixels of the picture whose samples may be inside a box of steps: first and last.
fn first_pixel(low: vec2<i32>) -> vec2<i32> {
    return max((low + 127) >> vec2<u32>(8u), vec2<i32>(0));
}

fn last_pixel(high: vec2<i32>) -> vec2<i32> {
    return min((high - 128) >> vec2<u32>(8u), vec2<i32>(frame.size_px) - 1);
}

// Term to add to an edge function before its sign is tested: 0 for a top or left edge, whose samples belong to the triangle, -1 for other
// edges. Triangles are oriented so that edge functions are positive inside.
fn edge_bias(edge: vec2<i32>) -> i32 {
    return select(-1, 0, edge.y < 0 || (edge.y == 0 && edge.x > 0));
}
