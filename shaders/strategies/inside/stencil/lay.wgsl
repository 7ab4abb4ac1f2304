// Writes the depth of one crossing of every pixel to the depth buffer, bit for bit as in the list. If a pixel has no such crossing it
// writes 0, behind which there is nothing.

#import cutaway::crossings::{head_of, z_at}
#import cutaway::full_screen::corner_of_screen

override crossing: u32 = 0u;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return corner_of_screen(index);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @builtin(frag_depth) f32 {
    let xy = vec2<u32>(at.xy);
    let head = head_of(xy);
    if crossing >= head.count {
        return 0.0;
    }
    return z_at(head, crossing, xy);
}
