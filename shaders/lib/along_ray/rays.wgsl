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

// The heights over four planes, each of which has a component of every vector: value at pixel (0, 0), change per pixel right and down.
struct RaysOfFour {
    origin: array<vec4<f32>, 3>,
    direction: array<vec4<f32>, 3>,
}

struct RayTable {
    surfaces: array<RaySurface, 32>,
    // The heights over the first eight clip-surfaces once more.
    planes: array<RaysOfFour, 2>,
}

@group(0) @binding(4) var<uniform> ray_table: RayTable;

// The sums of the magnitudes of what `along_ray` adds up: rounding is a fraction of these.
fn along_ray_terms(row: RayRow, at_px: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(
        abs(row.origin.x) + abs(at_px.x * row.origin.y) + abs(at_px.y * row.origin.z),
        abs(row.direction.x) + abs(at_px.x * row.direction.y) + abs(at_px.y * row.direction.z),
    );
}

// A value along one ray: x + depth * y.
fn along_ray(row: RayRow, at_px: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(
        row.origin.x + at_px.x * row.origin.y + at_px.y * row.origin.z,
        row.direction.x + at_px.x * row.direction.y + at_px.y * row.direction.z,
    );
}
