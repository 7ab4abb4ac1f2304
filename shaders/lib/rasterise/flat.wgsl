// Depth across a triangle: the plane through its unsnapped vertices, evaluated at samples relative to the snapped vertices.
//
// Sample weights are exact integer ratios, from the snapped triangle. Each vertex's depth is therefore moved along the plane by the
// vertex's own displacement, 1/512 px at most; interpolated with those weights it is the plane's depth at the sample. Rounding errors of
// the slope affect only this displacement: a needle 10^6 times as long as wide has correct depths along it, and one that snapping created
// or collapsed has no usable slope and keeps its vertices' depths.

#define_import_path cutaway::flat

#import cutaway::screen::{Point, cross2}

struct Flat {
    // Depth at the first snapped vertex, and its increase with the weights of the other two vertices.
    z: f32,
    rise: vec2<f32>,
    // Least and greatest depth of the vertices.
    least: f32,
    greatest: f32,
}

// Makes the plane. Corners run clockwise on screen; `area` is twice the area of the snapped triangle, in square steps.
fn flat_through(a: Point, b: Point, c: Point, area: f32) -> Flat {
    let ab = b.at - a.at;
    let ac = c.at - a.at;
    let drop = vec2<f32>(b.z - a.z, c.z - a.z);
    let true_area = cross2(ab, ac);
    var z = vec3<f32>(a.z, b.z, c.z);
    if abs(true_area * 65536.0 - area) <= 0.5 * area {
        let slope = vec2<f32>(drop.x * ac.y - drop.y * ab.y, drop.y * ab.x - drop.x * ac.x) / true_area;
        z += vec3<f32>(dot(slope, moved(a)), dot(slope, moved(b)), dot(slope, moved(c)));
    }
    let least = min(a.z, min(b.z, c.z));
    let greatest = max(a.z, max(b.z, c.z));
    return Flat(z.x, (z.yz - z.x) / area, least, greatest);
}

// Exact displacement of a vertex by snapping, in pixels.
fn moved(point: Point) -> vec2<f32> {
    return vec2<f32>(point.steps - 128) / 256.0 - point.at;
}

// Depth-buffer value at these weights of the second and the third vertex, out of `area`.
fn depth_at(plane: Flat, weights: vec2<f32>) -> f32 {
    return clamp(plane.z + dot(weights, plane.rise), plane.least, plane.greatest);
}
