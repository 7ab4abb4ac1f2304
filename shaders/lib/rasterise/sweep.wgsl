// One sweep of the compute rasteriser over the triangles of all parts. Bound as @group(2) @binding(0), (1) and (2).
//
// Sweeps over a screen that process samples in the same way share a pipeline; only a value in `sweep` differs. So they compute the same
// depth for the same sample, bit for bit, which two pipelines would not guarantee.

#define_import_path cutaway::sweep

struct Sweep {
    triangle_count: u32,
    vertex_count: u32,
    // Steps of the search for a triangle's part.
    search_steps: u32,
    // 0 in the first sweep over a screen, 1 in a later one.
    again: u32,
    // Offset of the screen's first vertex among all vertices.
    first_vertex: u32,
    // Rows from this one on are groups of preclassified triangles.
    first_group: u32,
}

struct DrawnPart {
    // Number of the part's first triangle among all drawn triangles.
    first_triangle: u32,
    first_index: u32,
    base_vertex: u32,
    // Bits of the cuts that apply.
    cuts: u32,
    // Location of the part's bits in the inside mask, unless `place` is NO_LANE.
    lane_word: u32,
    lane_shift: u32,
    // Index of the part in the part table, or NO_LANE if it needs no inside test.
    place: u32,
    // Index of the part in the scene.
    part: u32,
}

struct DrawnParts {
    // In order of their first triangles; groups of preclassified triangles follow the parts; unused rows begin beyond every triangle.
    parts: array<DrawnPart, 1024>,
}

@group(2) @binding(0) var<uniform> sweep: Sweep;
@group(2) @binding(1) var<uniform> drawn_parts: DrawnParts;
@group(2) @binding(2) var<storage, read> indices: array<u32>;

// A sample of the picture that a triangle covers.
struct Sample {
    at: vec2<u32>,
    z: f32,
    triangle: u32,
    // Row index of the part in the table of drawn parts, and the row itself: looked up once for all samples of a triangle.
    row: u32,
    part: DrawnPart,
    front: bool,
    lane_bits: u32,
}

const NO_LANE: u32 = 0xffffffffu;

// Invocations along x in a dispatch that is folded into two dimensions.
const INVOCATIONS_PER_ROW: u32 = 2097152u;

fn number_of(id: vec3<u32>) -> u32 {
    return id.y * INVOCATIONS_PER_ROW + id.x;
}

// Vertices of a triangle, relative to the screen's first vertex.
fn corners_of(triangle: u32, row: u32) -> vec3<u32> {
    let first = drawn_parts.parts[row].first_index + 3u * (triangle - drawn_parts.parts[row].first_triangle);
    return vec3<u32>(indices[first], indices[first + 1u], indices[first + 2u]) + drawn_parts.parts[row].base_vertex;
}
