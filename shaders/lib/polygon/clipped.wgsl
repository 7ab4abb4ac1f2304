// For screens with triangles that cross the near plane or the guard band. The first invocation of each workgroup clips its triangle again,
// with the same arithmetic in the same pipeline, so that all pieces of a triangle come from the same polygon.

#define_import_path cutaway::polygon

#import cutaway::cover::{Where, cover}
#import cutaway::outline::outline_of
#import cutaway::screen::{Point, point_of}

var<workgroup> points: array<Point, 8>;
var<workgroup> point_count: u32;

// Covers a piece of the triangle with these corners, in the screen's stored format.
fn cover_polygon(corners: array<vec4<i32>, 3>, at: Where) {
    if at.line == 0 {
        if at.piece.is_clipped {
            var outline = outline_of(corners);
            point_count = outline.count;
            for (var k = 0u; k < 8u; k++) {
                points[k] = outline.points[k];
            }
        } else {
            point_count = 3u;
            points[0] = point_of(corners[0]);
            points[1] = point_of(corners[1]);
            points[2] = point_of(corners[2]);
        }
    }
    workgroupBarrier();
    for (var k = 2u; k < min(point_count, 8u); k++) {
        cover(points[0], points[k - 1u], points[k], at);
    }
}
