// The mesh as vertices: a position in scene space and an octahedral normal. Both sides of every triangle are drawn.

#define_import_path cutaway::mesh

#import cutaway::frame::frame
#import cutaway::viewport::on_viewport

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: u32,
    // Of a draw of parts the place in their table, of one of preclassified triangles the number of the group.
    @builtin(instance_index) instance: u32,
}

// One transform for every pass: the same input gives the same bits, and neighbours share their edges.
fn clip_position(position: vec3<f32>) -> vec4<f32> {
    return frame.clip_from_scene * vec4<f32>(position, 1.0);
}

// The same on the viewport of a draw.
fn drawn_position(position: vec3<f32>) -> vec4<f32> {
    return on_viewport(clip_position(position), frame.size_px);
}

// Normal of what is seen: turned over where the triangle shows its back.
fn facing(normal: vec3<f32>, front: bool) -> vec3<f32> {
    return select(-normal, normal, front);
}
