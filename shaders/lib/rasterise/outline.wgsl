// A triangle clipped by the near plane and the guard band, on the screen: a convex polygon of at most eight points.

#define_import_path cutaway::outline

#import cutaway::clipping::clipped
#import cutaway::screen::{Point, borders_of, clip_of_kept, on_screen, point_of, snapped}

struct Outline {
    count: u32,
    points: array<Point, 8>,
}

// The outline of a triangle with these corners, in the screen's stored format.
fn outline_of(corners: array<vec4<i32>, 3>) -> Outline {
    var vertices = corners;
    let beyond = vec3<u32>(borders_of(corners[0]), borders_of(corners[1]), borders_of(corners[2]));
    var polygon = clipped(clip_of_kept(corners[0]), clip_of_kept(corners[1]), clip_of_kept(corners[2]), beyond);
    var outline: Outline;
    outline.count = min(polygon.count, 8u);
    for (var k = 0u; k < min(polygon.count, 8u); k++) {
        let source = polygon.source[k];
        if source < 3u {
            outline.points[k] = point_of(vertices[source]);
        } else {
            outline.points[k] = snapped(on_screen(polygon.at[k]));
        }
    }
    return outline;
}
