// Draws the cap of one part: the plane, where the stencil is inside. The draw also resets the stencil for the next part; so no fragment is
// discarded, and where there is no cap its depth is that of the far plane, which hides it.

#import cutaway::cuts::{cut_table, parts}
#import cutaway::full_screen::corner_of_screen
#import cutaway::layers::{CAP, layer_word, pack_normal}
#import cutaway::lone_plane::{is_in_box, lone_plane_at}

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) instance: u32,
}

struct Cap {
    @location(0) words: vec2<u32>,
    @builtin(frag_depth) z: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Corner {
    return Corner(corner_of_screen(index), instance);
}

@fragment
fn fragment(corner: Corner) -> Cap {
    let plane = lone_plane_at(corner.position.xy);
    let word = layer_word(CAP, cut_table.surfaces[0].surface, parts[corner.instance].part);
    let normal = pack_normal(-cut_table.surfaces[0].normal.xyz);
    return Cap(vec2<u32>(word, normal), select(0.0, plane.z, plane.begins_removed && is_in_box(plane, corner.position.xy)));
}
