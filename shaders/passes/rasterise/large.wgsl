// Covers the samples of queued triangles, which are too large for one invocation or clipped. A workgroup owns one piece of such a triangle
// (`pieces.wgsl`), an invocation one line of its samples.

#import cutaway::cover::Where
#import cutaway::piece::piece_of
#import cutaway::polygon::cover_polygon
#import cutaway::rows::row_of_triangle
#import cutaway::sweep::corners_of

override lane_bits: u32 = 32u;

@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) line: u32,
) {
    let piece = piece_of(group, groups);
    let part = row_of_triangle(piece.triangle);
    let corners = corners_of(piece.triangle, part);
    let vertices = array<vec4<i32>, 3>(screen[corners.x], screen[corners.y], screen[corners.z]);
    cover_polygon(vertices, Where(piece, part, i32(line), lane_bits));
}
