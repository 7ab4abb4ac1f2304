// The pose of a part, shared by all its vertices. Bound as @group(0) @binding(0).
//
// Rest space is part space moved to the middle of the part and scaled by a power of two, for f32 precision. A vertex is transformed in the
// order morph targets, skin, deformers, placement.

#define_import_path cutaway::pose

struct Pose {
    // Rows of the placement. Without deformers the skin goes straight to scene space, and these change nothing.
    scene_from_rest: array<vec4<f32>, 3>,
    first_vertex: u32,
    vertex_count: u32,
    position_count: u32,
    // Number of morph targets with a weight.
    weight_count: u32,
    deformer_count: u32,
    // Number of matrices that joint influences refer to.
    joint_count: u32,
    // -1 where the part's placement mirrors, else 1.
    hand: f32,
    padding: u32,
}

// A vertex between transforms. The lengths of its normals have no meaning.
struct Standing {
    point: vec3<f32>,
    // For shading.
    normal: vec3<f32>,
    // Direction out of the mesh, the same for all vertices at one position, so that inflating opens no cracks.
    outward: vec3<f32>,
}

@group(0) @binding(0) var<uniform> pose: Pose;

fn point_by(rows: array<vec4<f32>, 3>, point: vec3<f32>) -> vec3<f32> {
    let at = vec4<f32>(point, 1.0);
    return vec3<f32>(dot(rows[0], at), dot(rows[1], at), dot(rows[2], at));
}

// Normals are transformed by the cofactors, which exist even where an inverse does not.
fn normal_by(rows: array<vec4<f32>, 3>, normal: vec3<f32>) -> vec3<f32> {
    let x = cross(rows[1].xyz, rows[2].xyz);
    let y = cross(rows[2].xyz, rows[0].xyz);
    let z = cross(rows[0].xyz, rows[1].xyz);
    return vec3<f32>(dot(x, normal), dot(y, normal), dot(z, normal));
}

fn standing_by(rows: array<vec4<f32>, 3>, s: Standing) -> Standing {
    return Standing(point_by(rows, s.point), normal_by(rows, s.normal), normal_by(rows, s.outward));
}
