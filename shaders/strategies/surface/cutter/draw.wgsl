// Draws cutters for the sake of their fragments alone: each leaves its depth, its clip-surface and the normal of its triangle in its
// pixel's list, or is counted there (the open module `sheet_store`).
//
// The first vertex of a triangle is its own and has its normal. A fragment's normal is that of the side it shows: where a ray leaves
// the removed side it comes from there, so a cap has the normal that faces the eye.

#import cutaway::crossing_words::normal_bits
#import cutaway::frame::pixel_index
#import cutaway::layers::unpack_normal
#import cutaway::mesh::drawn_position
#import cutaway::sheet_store::leave
#import cutaway::sheet_words::sheet_word

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    // Clip-surface, and normals of front and back as bits of a word.
    @location(0) @interpolate(flat, first) triangle: vec3<u32>,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: u32, @builtin(instance_index) surface: u32) -> Corner {
    let n = unpack_normal(normal);
    return Corner(drawn_position(position), vec3<u32>(surface, normal_bits(n), normal_bits(-n)));
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) {
    let normal = select(corner.triangle.z, corner.triangle.y, front);
    leave(pixel_index(vec2<u32>(corner.position.xy)), corner.position.z, sheet_word(corner.triangle.x, front) | normal);
}
