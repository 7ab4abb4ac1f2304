// The crossing of a ray with a plane.

#define_import_path cutaway::plane_crossing

#import cutaway::crossing_list::{List, add}
#import cutaway::frame::buffer_from_depth
#import cutaway::rays::{ray_table, along_ray}

// Adds the crossing with a plane inside the interval of depths, and the side on which the interval begins. The side follows from the
// crossing and its direction, never from a second evaluation, so the two cannot disagree.
fn cross_plane(list: ptr<function, List>, surface: u32, at_px: vec2<f32>, interval: vec2<f32>) {
    cross_level(list, surface, 0.0, at_px, interval);
}

// The same for the plane at a height over that of a clip-surface.
fn cross_level(list: ptr<function, List>, surface: u32, level: f32, at_px: vec2<f32>, interval: vec2<f32>) {
    let height = along_ray(ray_table.surfaces[surface].height, at_px) - vec2<f32>(level, 0.0);
    let rises = height.y > 0.0;
    var begins_removed = height.x < 0.0;
    if height.y != 0.0 {
        let depth = -height.x / height.y;
        let ahead = depth > interval.x;
        begins_removed = rises == ahead;
        if ahead && depth < interval.y {
            add(list, buffer_from_depth(depth), surface, rises);
        }
    }
    if begins_removed {
        (*list).sides |= 1u << surface;
    }
}
