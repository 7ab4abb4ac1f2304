// The crossing of a pixel's ray with a plane that is the only clip-surface of the frame. It is recomputed on each use, always in the same
// way, so that the side of a fragment and the depth of the cap agree.

#define_import_path cutaway::lone_plane

#import cutaway::frame::{box_interval, buffer_from_depth, depth_from_buffer, frame, is_behind, ray_through}
#import cutaway::rays::{along_ray, ray_table}

struct LonePlane {
    // Depth-buffer value of the crossing; 0 if the ray does not cross the plane, because nothing lies behind 0.
    z: f32,
    // True if the ray starts on the removed side.
    begins_removed: bool,
}

fn lone_plane_at(at_px: vec2<f32>) -> LonePlane {
    let height = along_ray(ray_table.surfaces[0].height, at_px);
    if !(abs(height.y) > 0.0) {
        return LonePlane(0.0, height.x < 0.0);
    }
    let rises = height.y > 0.0;
    let depth = -height.x / height.y;
    if depth <= frame.near {
        return LonePlane(0.0, !rises);
    }
    return LonePlane(buffer_from_depth(depth), rises);
}

// Returns true if a cap is possible at the crossing, because it lies in the box of the cut solids; lists of crossings use the same box.
fn is_in_box(plane: LonePlane, at_px: vec2<f32>) -> bool {
    let interval = box_interval(ray_through(at_px));
    let depth = depth_from_buffer(plane.z);
    return plane.z > 0.0 && depth > interval.x && depth < interval.y;
}

// Returns true if a fragment of the pixel is kept.
fn is_kept(plane: LonePlane, z: f32) -> bool {
    return plane.begins_removed == is_behind(z, plane.z);
}
