// Draws a solid for the sake of the stencil alone: what is behind the depth that was laid down changes it.

#import cutaway::mesh::{Vertex, clip_position}

@vertex
fn vertex(v: Vertex) -> @builtin(position) @invariant vec4<f32> {
    return clip_position(v.position);
}

@fragment
fn fragment() {
}
