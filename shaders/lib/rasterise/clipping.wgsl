// A triangle clipped by the near plane and the guard band: a polygon of at most eight corners.
//
// The intersection of an edge with a border is computed from its inner end towards its outer one. Both triangles of an edge use
// that order, whatever their winding and their vertex indices at a crease, so both get the same new corner. It was decided once, when a
// vertex was transformed, whether it is beyond a border; the distance computed here only locates the intersection.

#define_import_path cutaway::clipping

#import cutaway::screen::{BORDERS, distance_from}

struct Polygon {
    count: u32,
    // Corners in clip space.
    at: array<vec4<f32>, 9>,
    // For each corner of the polygon, the corner of the triangle that it is, or 3 for a new one.
    source: array<u32, 9>,
}

fn signed_distance(border: u32, at: vec4<f32>, source: u32, beyond: vec3<u32>) -> f32 {
    let distance = distance_from(border, at);
    if source > 2u {
        return distance;
    }
    if ((beyond[source] >> border) & 1u) != 0u {
        return min(distance, -1e-30);
    }
    return max(distance, 0.0);
}

fn clip_at(border: u32, polygon: ptr<function, Polygon>, beyond: vec3<u32>) {
    var before = *polygon;
    var count = 0u;
    for (var i = 0u; i < min(before.count, 8u); i++) {
        let next = select(i + 1u, 0u, i + 1u == before.count);
        let a = before.at[i];
        let b = before.at[next];
        let to_a = signed_distance(border, a, before.source[i], beyond);
        let to_b = signed_distance(border, b, before.source[next], beyond);
        if to_a >= 0.0 {
            (*polygon).at[count] = a;
            (*polygon).source[count] = before.source[i];
            count += 1u;
        }
        if (to_a >= 0.0) != (to_b >= 0.0) && count < 9u {
            if to_a >= 0.0 {
                (*polygon).at[count] = a + to_a / (to_a - to_b) * (b - a);
            } else {
                (*polygon).at[count] = b + to_b / (to_b - to_a) * (a - b);
            }
            (*polygon).source[count] = 3u;
            count += 1u;
        }
    }
    (*polygon).count = min(count, 8u);
}

// Clips a triangle. `beyond` has, for each corner, bits of the borders beyond which it lies.
fn clipped(a: vec4<f32>, b: vec4<f32>, c: vec4<f32>, beyond: vec3<u32>) -> Polygon {
    var polygon: Polygon;
    polygon.count = 3u;
    polygon.at[0] = a;
    polygon.at[1] = b;
    polygon.at[2] = c;
    polygon.source[0] = 0u;
    polygon.source[1] = 1u;
    polygon.source[2] = 2u;
    let any_beyond = beyond.x | beyond.y | beyond.z;
    for (var border = 0u; border < BORDERS; border++) {
        if ((any_beyond >> border) & 1u) != 0u {
            clip_at(border, &polygon, beyond);
        }
    }
    return polygon;
}
