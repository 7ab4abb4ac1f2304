// Draws a solid for the sake of the stencil alone: what is behind the depth that was laid down changes it.

#import cutaway::mesh::{Vertex, drawn_position}

@vertex
fn vertex(v: Vertex) -> @builtin(position) @invariant vec4<f32> {
    return drawn_position(v.position);
}

@fragment
fn fragment() {
}
