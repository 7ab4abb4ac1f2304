// The clip-surfaces in coordinates along a ray. Bound as @group(0) @binding(4).
//
// Height over the plane and texel coordinates are linear in the pixel and in the depth: value = origin(x, y) + depth
// direction(x, y). The coefficients come from the CPU in f64, so that the cancellation between eye and plane happens there.

#define_import_path cutaway::rays

struct RayRow {
    origin: vec4<f32>,
    direction: vec4<f32>,
}

struct RaySurface {
    height: RayRow,
    texel_x: RayRow,
    texel_y: RayRow,
}

// The heights over the planes of four clip-surfaces, each of which has a component of every vector.
struct RaysOfFour {
    // Value at pixel (0, 0), change per pixel right and down.
    origin: array<vec4<f32>, 3>,
    direction: array<vec4<f32>, 3>,
    // The heights above which a point is kept, and below which it is removed, whatever the offset map holds and however the height at the
    // eye is rounded; and the error of a height per unit of depth.
    kept_above: vec4<f32>,
    removed_below: vec4<f32>,
    rounding: vec4<f32>,
}

struct RayTable {
    surfaces: array<RaySurface, 32>,
    // The heights over the first eight planes once more.
    planes: array<RaysOfFour, 2>,
}

@group(0) @binding(4) var<uniform> ray_table: RayTable;

// The heights over four planes along one ray: origin + depth * direction.
struct FourAlongRay {
    origin: vec4<f32>,
    direction: vec4<f32>,
}

fn four_along_ray(rays: RaysOfFour, at_px: vec2<f32>) -> FourAlongRay {
    return FourAlongRay(
        rays.origin[0] + at_px.x * rays.origin[1] + at_px.y * rays.origin[2],
        rays.direction[0] + at_px.x * rays.direction[1] + at_px.y * rays.direction[2],
    );
}

// A value along one ray: x + depth * y.
fn along_ray(row: RayRow, at_px: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(
        row.origin.x + at_px.x * row.origin.y + at_px.y * row.origin.z,
        row.direction.x + at_px.x * row.direction.y + at_px.y * row.direction.z,
    );
}
