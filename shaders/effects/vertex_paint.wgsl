// Draws the vertex paints of parts where the layers show their surfaces, for layers from any strategy and any cuts. The instance index is
// the row of a part; each triangle has three vertices.
//
// A fragment is kept if the layer is a surface of the same part at the same depth. Surfaces of one part that are closer to each other than
// a thousandth of their distance from the eye may swap colours.

#import cutaway::color::{linear_from_srgb, srgb_from_linear}
#import cutaway::frame::{depth_from_buffer, pixel_index}
#import cutaway::layers::{SURFACE, WORDS_PER_PIXEL, kind_of, part_of}
#import cutaway::mesh::drawn_position
#import cutaway::texture::{NO_TEXTURE, sampled}

struct VertexPaintRow {
    part: u32,
    first_vertex: u32,
    first_word: u32,
    first_image: u32,
}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(1) var<storage, read> vertex_paint_rows: array<VertexPaintRow>;
@group(1) @binding(2) var<storage, read> vertex_paint_words: array<u32>;
@group(1) @binding(3) var<storage, read> vertices: array<vec4<u32>>;

const VERTEX_PAINT_WORDS: u32 = 13u;
// Greatest relative difference between the depth of a surface and that of its vertex paint.
const NEAR: f32 = 1e-3;

struct TexturedVertex {
    @builtin(position) position: vec4<f32>,
    @location(0) color: vec3<f32>,
    @location(1) uv: vec2<f32>,
    @location(2) @interpolate(flat) image: u32,
    @location(3) @interpolate(flat) part: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> TexturedVertex {
    let row = vertex_paint_rows[instance];
    let first = row.first_word + index / 3u * VERTEX_PAINT_WORDS;
    let corner = index % 3u;
    let vertex = vertices[row.first_vertex + vertex_paint_words[first + corner]];
    let color = unpack4x8unorm(vertex_paint_words[first + 3u + corner]);
    let image = vertex_paint_words[first + 12u];
    return TexturedVertex(
        drawn_position(bitcast<vec3<f32>>(vertex.xyz)),
        linear_from_srgb(color.rgb),
        vec2<f32>(bitcast<f32>(vertex_paint_words[first + 6u + 2u * corner]), bitcast<f32>(vertex_paint_words[first + 7u + 2u * corner])),
        select(image + row.first_image, NO_TEXTURE, image == NO_TEXTURE),
        row.part,
    );
}

@fragment
fn fragment(textured: TexturedVertex) -> @location(0) vec2<u32> {
    // Derivatives are taken here, where all fragments are still active.
    let right = dpdx(textured.uv);
    let down = dpdy(textured.uv);
    let first = pixel_index(vec2<u32>(textured.position.xy)) * WORDS_PER_PIXEL;
    let word = layers[first];
    let depth = bitcast<f32>(layers[first + 2u]);
    let is_it = kind_of(word) == SURFACE && part_of(word) == textured.part &&
        abs(depth_from_buffer(textured.position.z) - depth) <= NEAR * abs(depth);
    if !is_it {
        discard;
    }
    var color = textured.color;
    if textured.image != NO_TEXTURE {
        color *= sampled(textured.image, textured.uv, right, down).rgb;
    }
    return vec2<u32>(pack4x8unorm(vec4<f32>(srgb_from_linear(color), 1.0)), textured.part);
}
