// Points of the picture in fixed point: 256 steps to a pixel, as GPUs have them, so that both rasterisers cover the same
// samples. x to the right and y down; the sample of a pixel is at its centre, 128 steps into it.
//
// A point beyond a border cannot be snapped, and its triangles are clipped there: the near plane, and a guard band around the
// picture that keeps every difference of two coordinates below 2^23 steps.

#define_import_path cutaway::screen

#import cutaway::frame::frame

// Half the width of the guard band, in pixels from the upper left corner.
const GUARD_PX: f32 = 16000.0;
const BORDERS: u32 = 5u;

// How far a point inside the guard band may be from the middle of the picture, in halves of the picture.
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

// Bit b is set where the point is beyond border b.
fn borders_beyond(clip: vec4<f32>) -> u32 {
    var beyond = 0u;
    for (var border = 0u; border < BORDERS; border++) {
        beyond |= select(0u, 1u << border, distance_from(border, clip) < 0.0);
    }
    return beyond;
}

// x and y in steps, and the bits of the depth-buffer value. Rounded around pixel centres, as GPUs do it.
fn snapped(clip: vec4<f32>) -> vec3<i32> {
    let size = vec2<f32>(frame.size_px);
    let at_px = clip.xy / clip.w * vec2<f32>(0.5, -0.5) * size + 0.5 * size;
    let steps = vec2<i32>(round((at_px - 0.5) * 256.0)) + 128;
    return vec3<i32>(steps, bitcast<i32>(clip.z / clip.w));
}

// A vertex as it is kept: snapped, or in clip space with the borders it is beyond. Of clip space three numbers are kept: one of z
// and w is the same everywhere, w in parallel views, z in others.
fn kept(clip: vec4<f32>) -> vec4<i32> {
    let beyond = borders_beyond(clip);
    if beyond == 0u {
        return vec4<i32>(snapped(clip), 0);
    }
    let third = select(clip.w, clip.z, frame.orthographic != 0u);
    return vec4<i32>(bitcast<vec3<i32>>(vec3<f32>(clip.xy, third)), i32(beyond));
}

// Clip space of a vertex that was kept, up to the snapping.
fn clip_of_kept(vertex: vec4<i32>) -> vec4<f32> {
    let third = bitcast<f32>(vertex.z);
    if vertex.w != 0 {
        let at = bitcast<vec2<f32>>(vertex.xy);
        return select(vec4<f32>(at, frame.near, third), vec4<f32>(at, third, 1.0), frame.orthographic != 0u);
    }
    let size = vec2<f32>(frame.size_px);
    let at = (vec2<f32>(vertex.xy) / 256.0 - 0.5 * size) / (vec2<f32>(0.5, -0.5) * size);
    let w = select(frame.near / third, 1.0, frame.orthographic != 0u);
    return vec4<f32>(at, third, 1.0) * w;
}

// The pixels whose samples may be inside a box of steps: first and last, of the picture.
fn first_pixel(low: vec2<i32>) -> vec2<i32> {
    return max((low + 127) >> vec2<u32>(8u), vec2<i32>(0));
}

fn last_pixel(high: vec2<i32>) -> vec2<i32> {
    return min((high - 128) >> vec2<u32>(8u), vec2<i32>(frame.size_px) - 1);
}

// A sample on an edge belongs to the triangle if the edge is a top or a left one: then 0, else -1 to be added to the edge
// function before its sign is asked for. Triangles are oriented so that their inside is where edge functions are positive.
fn edge_bias(edge: vec2<i32>) -> i32 {
    return select(-1, 0, edge.y < 0 || (edge.y == 0 && edge.x > 0));
}
