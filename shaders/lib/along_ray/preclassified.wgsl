// Triangles of which it is known on which side of clip-surfaces they lie, or that lie on each other, in groups that lie alike. Bound as @group(0) @binding(12).

#define_import_path cutaway::preclassified

struct PreclassifiedGroup {
    // Place of the part in the part table.
    place: u32,
    // Bits of the clip-surfaces that the triangles are preclassified by.
    surfaces: u32,
    // Of those, the ones of which they lie on the removed side.
    removed: u32,
    // Of those, the ones that the triangles lie in.
    flush: u32,
    // 1 where each triangle lies on another one.
    doubled: u32,
    // Bits of the cutters in faces of which they lie.
    cutters: u32,
    padding: vec2<u32>,
    // Normal of these faces, either way round.
    normal: vec4<f32>,
    // Depth-buffer value of the plane that they share with other parts: its change per pixel to the right and down, and that in the
    // middle of the first pixel; then the place of the part in it, from 1 for the last; 0 where there is no such plane.
    plane: vec4<f32>,
}

struct PreclassifiedGroups {
    groups: array<PreclassifiedGroup, 1024>,
}

@group(0) @binding(12) var<uniform> preclassified: PreclassifiedGroups;

// Of triangles in a plane that parts share all have the depth of the plane, and the first part in rank is nearer than the next by the
// least there is.
fn of_shared(found: f32, at: vec2<u32>, plane: vec4<f32>) -> f32 {
    if plane.w < 0.5 {
        return found;
    }
    let z = clamp(plane.x * f32(at.x) + plane.y * f32(at.y) + plane.z, 0.0, 1.0);
    return bitcast<f32>(bitcast<u32>(z) + u32(plane.w));
}

// Of triangles that lie on each other the one that faces the eye is seen: it is nearer by the least there is.
fn of_doubled(found: f32, at: vec2<u32>, group: u32, front: bool) -> f32 {
    let z = of_shared(found, at, preclassified.groups[group].plane);
    return select(z, bitcast<f32>(bitcast<u32>(z) + 1u), preclassified.groups[group].doubled != 0u && front);
}

// Depth-buffer value of a fragment at `z` that is known to lie before a crossing, or behind it: that of the crossing, or the value next to
// it, where it is found on the other side.
fn beside(z: f32, crossing: f32, is_before: bool) -> f32 {
    let behind = bitcast<f32>(max(bitcast<u32>(crossing), 1u) - 1u);
    return select(min(z, behind), max(z, crossing), is_before);
}

// The same where the triangle may lie in the surface that the crossing is with: then it is as far as the crossing, to the bit, and a needle
// as right as any.
fn preclassified_at(z: f32, crossing: f32, is_before: bool, is_flush: bool) -> f32 {
    return beside(select(z, crossing, is_flush), crossing, is_before);
}
