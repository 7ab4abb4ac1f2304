// Completes the layers of pixels that are not background: part, side and normal of the triangle that claimed a surface, or the normal of a
// cap. The open module `coloring` colours them, or leaves that to later passes. Workgroups share the touched tiles, an invocation owns a
// pixel of each.
//
// Corner weights are found in scene space, where the ray through the pixel centre meets the triangle's plane: correct in perspective, and
// for clipped triangles as well. They affect only shading, no decision.

#import cutaway::cap_normal::packed_cap_normal
#import cutaway::claims::{is_front, triangle_of}
#import cutaway::coloring::color_pixel
#import cutaway::frame::{Ray, frame, centre_of, pixel_index, ray_through}
#import cutaway::layers::{BACKGROUND, BACK_FACE, NEAR_PLANE, SURFACE, WORDS_PER_PIXEL, clip_surface_of, kind_of, layer_word, pack_normal, unpack_normal}
#import cutaway::mesh::facing
#import cutaway::rows::row_of_triangle
#import cutaway::share::{pixel_at, turns}
#import cutaway::sweep::{corners_of, drawn_parts, sweep}

@group(1) @binding(0) var<storage, read_write> layers: array<u32>;
@group(2) @binding(5) var<storage, read> vertices: array<vec4<u32>>;

fn position_of(vertex: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(vertices[vertex].xyz);
}

// Weights of the second and the third corner (Möller & Trumbore 1997), kept inside the triangle.
fn weights_of(ray: Ray, a: vec3<f32>, ab: vec3<f32>, ac: vec3<f32>) -> vec2<f32> {
    let across = cross(ray.direction, ac);
    let volume = dot(ab, across);
    if !(abs(volume) > 0.0) {
        return vec2<f32>(1.0 / 3.0);
    }
    let from_a = ray.origin - a;
    let second = clamp(dot(from_a, across) / volume, 0.0, 1.0);
    let third = clamp(dot(ray.direction, cross(from_a, ab)) / volume, 0.0, 1.0 - second);
    return vec2<f32>(second, third);
}

// The first two words of a surface's layer; `word` has its flags.
fn surface_words(at: vec2<u32>, word: u32, code: u32) -> vec2<u32> {
    let triangle = triangle_of(code);
    let row = row_of_triangle(triangle);
    let corners = corners_of(triangle, row) + sweep.first_vertex;
    let a = position_of(corners.x);
    let weights = weights_of(ray_through(centre_of(at)), a, position_of(corners.y) - a, position_of(corners.z) - a);
    let normal = (1.0 - weights.x - weights.y) * unpack_normal(vertices[corners.x].w)
        + weights.x * unpack_normal(vertices[corners.y].w)
        + weights.y * unpack_normal(vertices[corners.z].w);
    let front = is_front(code);
    let side = select(BACK_FACE, 0u, front);
    return vec2<u32>(
        word | layer_word(SURFACE, 0u, drawn_parts.parts[row].part) | side,
        pack_normal(facing(normalize(normal), front)),
    );
}

fn paint(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    let first = pixel * WORDS_PER_PIXEL;
    var word = layers[first];
    var normal = layers[first + 1u];
    if kind_of(word) == BACKGROUND {
        return;
    }
    if kind_of(word) == SURFACE {
        let words = surface_words(xy, word, normal);
        word = words.x;
        normal = words.y;
    } else if clip_surface_of(word) != NEAR_PLANE {
        normal = packed_cap_normal(xy, normal, bitcast<f32>(layers[first + 2u]));
    }
    layers[first] = word;
    layers[first + 1u] = normal;
    color_pixel(pixel, xy, word, normal);
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    let end = turns(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let xy = pixel_at(turn, group, groups, local);
        if all(xy < frame.size_px) {
            paint(xy);
        }
    }
}
