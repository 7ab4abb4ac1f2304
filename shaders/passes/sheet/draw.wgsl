// Draws clip-surfaces as triangles only for their fragments: each stores its depth, clip-surface and facing in its pixel's list.

#import cutaway::frame::pixel_index
#import cutaway::mesh::drawn_position
#import cutaway::sheet_lists::leave
#import cutaway::sheet_words::sheet_word
#import cutaway::tessellation::cap_vertex

// Added to every instance: a draw with arguments written by a pass begins with 0.
override first_instance: u32 = 0u;

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) @interpolate(flat) surface: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Corner {
    let cap = cap_vertex(index, first_instance + instance);
    return Corner(drawn_position(cap.point), cap.surface);
}

@fragment
fn fragment(corner: Corner, @builtin(front_facing) front: bool) {
    leave(pixel_index(vec2<u32>(corner.position.xy)), corner.position.z, sheet_word(corner.surface, front));
}
