// A solid drawn by the hardware rasteriser: the data passed from vertices to fragments, and the output of a kept fragment.

#define_import_path cutaway::surface

#import cutaway::layers::{BACK_FACE, SURFACE, layer_word, pack_normal, unpack_normal}
#import cutaway::mesh::{Vertex, drawn_position, facing}

struct Corner {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    // The same instance index as in the vertices.
    @location(1) @interpolate(flat) instance: u32,
}

// The words of a surface, with a depth that differs from the rasterised one.
struct SurfaceAt {
    @location(0) words: vec2<u32>,
    @builtin(frag_depth) z: f32,
}

fn corner_of(v: Vertex) -> Corner {
    return Corner(drawn_position(v.position), unpack_normal(v.normal), v.instance);
}

// The words of a part's surface. The number of crossings in front of the surface is stored in the bits for a cap's clip-surface.
fn surface_words(corner: Corner, behind: u32, part: u32, front: bool) -> vec2<u32> {
    let word = layer_word(SURFACE, behind, part) | select(BACK_FACE, 0u, front);
    return vec2<u32>(word, pack_normal(facing(normalize(corner.normal), front)));
}
