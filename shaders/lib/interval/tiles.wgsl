// The depths between which crossings of a ray matter: in the box of the cut solids, and between the depths of their triangles in the
// picture tile that the ray goes through.

#define_import_path cutaway::interval

#import cutaway::asked::Interval
#import cutaway::frame::{box_interval, centre_of, depth_from_buffer, ray_through}
#import cutaway::touched::{TILE_PX, tile_at}
#import cutaway::touched_list::touched

// Distance by which rounding may move a crossing in front of the nearest triangle of its part, or behind the farthest: a fraction of the
// depth or of the scene size. This bound is generous, yet far less than the depth range of a tile.
const BEYOND: f32 = 0.0009765625;

// `from_near`: the interval begins at the near plane, because the ray may begin inside a solid.
fn interval_at(pixel: vec2<u32>, from_near: bool) -> Interval {
    let found = max(touched.reach, touched.tiles[tile_at(pixel / TILE_PX)].reach);
    if found.x == 0u && found.y == 0u {
        return Interval(vec2<f32>(0.0), vec2<f32>(0.0));
    }
    let all = box_interval(ray_through(centre_of(pixel)));
    let near = depth_from_buffer(bitcast<f32>(found.x));
    let far = depth_from_buffer(bitcast<f32>(~found.y));
    let first = select(near - BEYOND * max(abs(near), 1.0), all.x, from_near);
    let last = far + BEYOND * max(abs(far), 1.0);
    return Interval(all, vec2<f32>(max(all.x, first), min(all.y, last)));
}
