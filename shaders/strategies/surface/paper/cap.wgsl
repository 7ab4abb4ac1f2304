// Draws caps as triangles of the clip-surfaces, displaced by the offset map in the vertex stage (the open module `tessellation`) and
// trimmed to the solid by the parity test at every fragment (Trapp & Döllner 2013, section 5), in the open module `volume`.

#import cutaway::cuts::{cut_table, is_removed, parts}
#import cutaway::facets::place_of
#import cutaway::layers::{CAP, UNRELIABLE, layer_word, pack_normal}
#import cutaway::mesh::drawn_position
#import cutaway::relief::cap_normal
#import cutaway::sides::sides_of
#import cutaway::tessellation::cap_vertex
#import cutaway::volume::probe

// Added to every instance: a draw with arguments written by a pass begins with 0.
override first_instance: u32 = 0u;

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) point: vec3<f32>,
    // Part-table index and number of the clip-surface.
    @location(1) @interpolate(flat) what: vec2<u32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Corner {
    let cap = cap_vertex(index, first_instance + instance);
    return Corner(drawn_position(cap.point), cap.point, vec2<u32>(place_of(first_instance + instance), cap.surface));
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec2<u32> {
    let part = parts[corner.what.x];
    let own = 1u << corner.what.y;
    let sides = sides_of(corner.point);
    let is_boundary = is_removed(sides | own, part.cuts) && !is_removed(sides & ~own, part.cuts);
    if !is_boundary {
        discard;
    }
    let answer = probe(corner.what.x, corner.point);
    if !answer.is_inside && !answer.in_doubt {
        discard;
    }
    // Uncertain fragments are drawn, because only drawn fragments can be marked.
    let mark = select(0u, UNRELIABLE, answer.in_doubt);
    let word = layer_word(CAP, cut_table.surfaces[corner.what.y].surface, part.part) | mark;
    return vec2<u32>(word, pack_normal(cap_normal(corner.what.y, corner.point)));
}
