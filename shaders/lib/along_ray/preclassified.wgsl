// Groups of triangles whose side of some clip-surfaces is known, or that coincide with other triangles. Bound as @group(0) @binding(12).

#define_import_path cutaway::preclassified

struct PreclassifiedGroup {
    // Index of the part in the part table.
    place: u32,
    // Bits of the clip-surfaces for which the side of the triangles is known.
    surfaces: u32,
    // The subset of `surfaces` for which the triangles lie on the removed side.
    removed: u32,
    // The subset of `surfaces` that are coplanar with the triangles.
    flush: u32,
    // 1 if each triangle coincides with another one.
    doubled: u32,
    // Bits of the cutters that have a face coplanar with the triangles.
    cutters: u32,
    padding: vec2<u32>,
    // Normal of these faces, in either orientation.
    normal: vec4<f32>,
    // Plane that the triangles share with other parts: change of its depth-buffer value per pixel to the right and down; its value at the
    // centre of the first pixel; and the part's rank in the plane, from 1 for the last part, 0 if there is no such plane.
    plane: vec4<f32>,
}

struct PreclassifiedGroups {
    groups: array<PreclassifiedGroup, 1024>,
}

@group(0) @binding(12) var<uniform> preclassified: PreclassifiedGroups;

// Triangles in a plane shared by parts all get the plane's depth, and each part is nearer than the one after it in rank by the smallest
// possible step.
fn of_shared(found: f32, at: vec2<u32>, plane: vec4<f32>) -> f32 {
    if plane.w < 0.5 {
        return found;
    }
    let z = clamp(plane.x * f32(at.x) + plane.y * f32(at.y) + plane.z, 0.0, 1.0);
    return bitcast<f32>(bitcast<u32>(z) + u32(plane.w));
}

// Among coincident triangles the one that faces the eye must be visible, so it is moved nearer by the smallest possible step.
fn of_doubled(found: f32, at: vec2<u32>, group: u32, front: bool) -> f32 {
    let z = of_shared(found, at, preclassified.groups[group].plane);
    return select(z, bitcast<f32>(bitcast<u32>(z) + 1u), preclassified.groups[group].doubled != 0u && front);
}

// Depth-buffer value of a fragment at `z` that is known to lie in front of a crossing, or behind it. If `z` is on the wrong side, it is
// moved to the crossing's value or the one next to it.
fn beside(z: f32, crossing: f32, is_before: bool) -> f32 {
    let behind = bitcast<f32>(max(bitcast<u32>(crossing), 1u) - 1u);
    return select(min(z, behind), max(z, crossing), is_before);
}

// The same for a triangle that may be coplanar with the crossing's surface: if it is, its depth equals the crossing's bit for bit, even for
// a needle triangle.
fn preclassified_at(z: f32, crossing: f32, is_before: bool, is_flush: bool) -> f32 {
    return beside(select(z, crossing, is_flush), crossing, is_before);
}
