// Draws a solid only for the stencil: fragments behind the stored crossing depth change it.

#import cutaway::mesh::{Vertex, drawn_position}

@vertex
fn vertex(v: Vertex) -> @builtin(position) @invariant vec4<f32> {
    return drawn_position(v.position);
}

@fragment
fn fragment() {
}
