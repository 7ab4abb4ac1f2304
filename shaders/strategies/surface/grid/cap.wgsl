// Draws caps as refined quads, displaced by the offset map in the vertex shader and cut to the solid by the parity test at every
// fragment (Trapp & Döllner 2013, section 5), which the open module `volume` answers. The surface lies at -f Sz along N, so that
// is the displacement; the paper's text leaves the sign open.

#import cutaway::cuts::{NO_RELIEF, cut_table, is_removed, parts}
#import cutaway::layers::{CAP, UNRELIABLE, layer_word, pack_normal}
#import cutaway::mesh::clip_position
#import cutaway::relief::{cap_normal, height_at, sides_of}
#import cutaway::volume::probe

struct Quad {
    // Corner of the quad and its steps per cell, in scene space.
    corner: vec4<f32>,
    step_u: vec4<f32>,
    step_v: vec4<f32>,
}

@group(1) @binding(1) var<storage, read> quads: array<Quad>;

// Cells along one side of the quad.
override cells: u32 = 256u;

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) point: vec3<f32>,
    // Rank of the part and number of the clip-surface.
    @location(1) @interpolate(flat) what: vec2<u32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Corner {
    let what = vec2<u32>(instance / 32u, instance % 32u);
    let quad = quads[what.y];
    let at = vec2<f32>(f32(index % (cells + 1u)), f32(index / (cells + 1u)));
    var point = quad.corner.xyz + at.x * quad.step_u.xyz + at.y * quad.step_v.xyz;
    if cut_table.surfaces[what.y].first_texel != NO_RELIEF {
        let p = vec4<f32>(point, 1.0);
        let texel = vec2<f32>(
            dot(cut_table.surfaces[what.y].texel_x_row, p),
            dot(cut_table.surfaces[what.y].texel_y_row, p),
        );
        let height = height_at(what.y, texel) * cut_table.surfaces[what.y].scale.z;
        point -= height * cut_table.surfaces[what.y].normal.xyz;
    }
    return Corner(clip_position(point), point, what);
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
    // What may be inside is shown, for only what is shown can be marked.
    let mark = select(0u, UNRELIABLE, answer.in_doubt);
    let word = layer_word(CAP, cut_table.surfaces[corner.what.y].surface, part.part) | mark;
    return vec2<u32>(word, pack_normal(cap_normal(corner.what.y, corner.point)));
}
