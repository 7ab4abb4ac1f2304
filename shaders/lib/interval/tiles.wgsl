// The depths between which crossings of a ray matter: in the box of the cut solids, and between the depths of their triangles in the
// picture tile that the ray goes through.

#define_import_path cutaway::interval

#import cutaway::asked::Interval
#import cutaway::interval_in_tile::interval_in_tile
#import cutaway::touched::{TILE_PX, tile_at}
#import cutaway::touched_list::touched

fn interval_at(pixel: vec2<u32>, from_near: bool) -> Interval {
    let reach = max(touched.reach, touched.tiles[tile_at(pixel / TILE_PX)].reach);
    return interval_in_tile(pixel, reach, from_near);
}
