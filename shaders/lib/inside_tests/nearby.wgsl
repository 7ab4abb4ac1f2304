// The solid angle of a triangle within a sphere: its value and gradient at the centre, and how much its gradient varies.
//
// The gradient is the field of a unit current along the triangle's edges (Biot & Savart). Derivatives of the field of an edge at a distance d
// are at most 2.2 / d^2: the radial one reaches 2.18 / d^2, and random segments have shown no more. Small triangles far away are
// bounded by their area instead: the second derivative of the solid angle of an element is at most 6 / d^4. A sphere that a triangle passes
// through has no bound.

#define_import_path cutaway::nearby

#import cutaway::closings::{floats, solid_angle}
#import cutaway::expansion::Sphere

const OF_EDGE: f32 = 2.2;
const OF_AREA: f32 = 6.0;
// In place of a bound, if there is none.
const UNBOUNDED: f32 = 1e30;

struct Nearby {
    angle: f32,
    gradient: vec3<f32>,
    // Bound of the second derivatives in the sphere.
    bend: f32,
}

// Distance of the origin from a segment.
fn segment_distance(a: vec3<f32>, b: vec3<f32>) -> f32 {
    let along = b - a;
    let t = clamp(-dot(a, along) / max(dot(along, along), 1e-30), 0.0, 1.0);
    return length(a + t * along);
}

// Field at the origin of a unit current along a segment, given the cross product of its ends.
fn field_of(a: vec3<f32>, b: vec3<f32>, crossed: vec3<f32>) -> vec3<f32> {
    let la = length(a);
    let lb = length(b);
    let along = dot(a, b);
    // The same sum without cancellation, where the segment passes near the origin.
    let beside = dot(crossed, crossed) / max(la * lb - along, 1e-30);
    return crossed * (la + lb) / max(la * lb * select(la * lb + along, beside, along < 0.0), 1e-30);
}

fn nearby(triangle: u32, sphere: Sphere) -> Nearby {
    let a = floats(triangle).xyz - sphere.centre;
    let b = floats(triangle + 1u).xyz - sphere.centre;
    let c = floats(triangle + 2u).xyz - sphere.centre;
    let ab = cross(a, b);
    let bc = cross(b, c);
    let ca = cross(c, a);
    let area = ab + bc + ca;
    let size = length(area);
    let to_edges = vec3<f32>(segment_distance(a, b), segment_distance(b, c), segment_distance(c, a));
    // The nearest point is within the triangle if the centre is above it.
    let is_above = all(vec3<f32>(dot(area, ab), dot(area, bc), dot(area, ca)) >= vec3<f32>(0.0));
    let to_triangle = select(min(to_edges.x, min(to_edges.y, to_edges.z)), abs(dot(a, area)) / size, is_above && size > 0.0);
    let gap = to_triangle - sphere.radius;
    let gaps = to_edges - sphere.radius;
    let by_edges = dot(1.0 / (gaps * gaps), vec3<f32>(OF_EDGE));
    let by_area = 0.5 * OF_AREA * size / (gap * gap * gap * gap);
    let gradient = field_of(a, b, ab) + field_of(b, c, bc) + field_of(c, a, ca);
    let bend = select(UNBOUNDED, min(by_edges, by_area), gap > 0.0);
    return Nearby(solid_angle(triangle, sphere.centre, 0.0).x, gradient, bend);
}
