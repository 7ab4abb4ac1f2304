// For screens without clipped triangles: every triangle is covered as it is.

#define_import_path cutaway::polygon

#import cutaway::cover::{Where, cover}
#import cutaway::screen::point_of

// Covers a piece of the triangle with these corners, in the screen's stored format.
fn cover_polygon(corners: array<vec4<i32>, 3>, at: Where) {
    cover(point_of(corners[0]), point_of(corners[1]), point_of(corners[2]), at);
}
