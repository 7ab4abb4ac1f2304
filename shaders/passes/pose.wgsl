// Poses the vertices of a moving part: rest pose, plus morph targets, then the skin, then deformers, then the placement in the scene. One
// invocation owns one vertex. Vertices that share a position do the same operations on the same numbers, so their results are equal bit for
// bit and the mesh stays closed.

#import cutaway::deform::{deformed, outward_at}
#import cutaway::layers::{pack_normal, unpack_normal}
#import cutaway::morph::morphed
#import cutaway::pose::{Standing, pose, standing_by}
#import cutaway::skin::skinned
#import cutaway::sweep::number_of

// Rest-space position as bits, and normal.
@group(1) @binding(0) var<storage, read> rest: array<vec4<u32>>;
// The vertices of all parts, in scene space.
@group(1) @binding(1) var<storage, read_write> posed: array<vec4<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let vertex = number_of(id);
    if vertex >= pose.vertex_count {
        return;
    }
    let given = rest[vertex];
    let normal = unpack_normal(given.w);
    var at = Standing(morphed(bitcast<vec3<f32>>(given.xyz), vertex), normal, outward_at(vertex));
    at = standing_by(pose.scene_from_rest, deformed(skinned(at, vertex)));
    // A vertex flattened to nothing has no normal: it keeps the previous one.
    let square = dot(at.normal, at.normal);
    let turned = select(normal, at.normal * (pose.hand * inverseSqrt(max(square, 1e-30))), square > 1e-30);
    posed[pose.first_vertex + vertex] = vec4<u32>(bitcast<vec3<u32>>(at.point), pack_normal(turned));
}
