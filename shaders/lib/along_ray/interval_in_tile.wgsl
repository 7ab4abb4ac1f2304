// The depths between which crossings of a ray matter, given the depth range of the cut triangles in its picture tile.

#define_import_path cutaway::interval_in_tile

#import cutaway::asked::Interval
#import cutaway::frame::{box_interval, centre_of, depth_from_buffer, ray_through}

// Distance by which rounding may move a crossing in front of the nearest triangle of its part, or behind the farthest: a fraction of the
// depth or of the scene size. This bound is generous, yet far less than the depth range of a tile.
const BEYOND: f32 = 0.0009765625;

// `reach` has the bits of the greatest depth-buffer value and of the complement of the least one; `from_near` has the interval begin at the
// near plane, because the ray may begin inside a solid.
fn interval_in_tile(pixel: vec2<u32>, reach: vec2<u32>, from_near: bool) -> Interval {
    if reach.x == 0u && reach.y == 0u {
        return Interval(vec2<f32>(0.0), vec2<f32>(0.0));
    }
    let all = box_interval(ray_through(centre_of(pixel)));
    let near = depth_from_buffer(bitcast<f32>(reach.x));
    let far = depth_from_buffer(bitcast<f32>(~reach.y));
    let first = select(near - BEYOND * max(abs(near), 1.0), all.x, from_near);
    let last = far + BEYOND * max(abs(far), 1.0);
    return Interval(all, vec2<f32>(max(all.x, first), min(all.y, last)));
}
