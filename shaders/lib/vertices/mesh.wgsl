// The mesh as vertices: a position in scene space and an octahedral normal. Both sides of every triangle are drawn.

#define_import_path cutaway::mesh

#import cutaway::frame::frame
#import cutaway::viewport::on_viewport

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: u32,
    // The part's index in the table if parts are drawn, the group number if preclassified triangles are.
    @builtin(instance_index) instance: u32,
}

// One transform for every pass: the same input gives the same bits, and neighbours share their edges.
fn clip_position(position: vec3<f32>) -> vec4<f32> {
    return frame.clip_from_scene * vec4<f32>(position, 1.0);
}

// The same in the viewport of a draw.
fn drawn_position(position: vec3<f32>) -> vec4<f32> {
    return on_viewport(clip_position(position), frame.size_px);
}

// Normal of the visible side: flipped if the triangle shows its back.
fn facing(normal: vec3<f32>, front: bool) -> vec3<f32> {
    return select(-normal, normal, front);
}
