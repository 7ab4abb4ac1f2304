// Like `mark`, for groups of preclassified triangles: the depth that is tested is the corrected one.

#import cutaway::mesh::{Vertex, drawn_position}
#import cutaway::preclassified_depth::preclassified_z

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    // Number of the group.
    @location(0) @interpolate(flat) group: u32,
}

@vertex
fn vertex(v: Vertex) -> Corner {
    return Corner(drawn_position(v.position), v.instance);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) -> @builtin(frag_depth) f32 {
    let at = vec2<u32>(corner.position.xy);
    return preclassified_z(corner.position.z, at, corner.group, front);
}
