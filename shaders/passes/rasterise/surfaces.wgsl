// Says of each pixel what its nearest triangle is: part, side and normal, as layers of which the depth is still a value of the
// depth buffer. One invocation owns one pixel.
//
// Weights of the corners are found in scene space, where the ray through the pixel centre meets the triangle's plane: right in
// perspective, and for clipped triangles as well. They shade; they decide nothing.

#import cutaway::frame::{Ray, frame, centre_of, pixel_count, pixel_index, ray_through}
#import cutaway::layers::{BACK_FACE, BACKGROUND, SURFACE, UNRANKED, UNRELIABLE, WORDS_PER_PIXEL, layer_word, pack_normal, unpack_normal}
#import cutaway::mesh::facing
#import cutaway::screen::point_of
#import cutaway::sweep::{corners_of, drawn_parts, row_of_triangle, sweep}
#import cutaway::wide::{wide_cross, wide_is_negative}

@group(1) @binding(2) var<storage, read> nearest: array<u32>;
@group(1) @binding(3) var<storage, read_write> layers: array<u32>;
@group(2) @binding(3) var<storage, read> screen: array<vec4<i32>>;
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

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let first = pixel * WORDS_PER_PIXEL;
    let z = nearest[pixel];
    let claim = nearest[pixel_count() + pixel];
    layers[first] = BACKGROUND;
    layers[first + 1u] = 0u;
    layers[first + 2u] = 0u;
    if z == 0u {
        return;
    }
    if claim == 0u {
        // A depth that no triangle claims is a fault of the rasteriser.
        layers[first] = UNRELIABLE;
        return;
    }
    let triangle = 0xffffffffu - claim;
    let part = row_of_triangle(triangle);
    let corners = corners_of(triangle, part);
    let numbers = corners + sweep.first_vertex;
    let a = position_of(numbers.x);
    let ab = position_of(numbers.y) - a;
    let ac = position_of(numbers.z) - a;
    let ray = ray_through(centre_of(id.xy));
    let points = array<vec4<i32>, 3>(screen[corners.x], screen[corners.y], screen[corners.z]);
    var front = dot(ray.direction, cross(ab, ac)) < 0.0;
    if (points[0].w | points[1].w | points[2].w) == 0 {
        let a_steps = point_of(points[0]).steps;
        front = wide_is_negative(wide_cross(point_of(points[1]).steps - a_steps, point_of(points[2]).steps - a_steps));
    }
    let weights = weights_of(ray, a, ab, ac);
    let normal = (1.0 - weights.x - weights.y) * unpack_normal(vertices[numbers.x].w)
        + weights.x * unpack_normal(vertices[numbers.y].w)
        + weights.y * unpack_normal(vertices[numbers.z].w);
    let index = drawn_parts.parts[part].part;
    layers[first] = layer_word(SURFACE, UNRANKED, index) | select(BACK_FACE, 0u, front);
    layers[first + 1u] = pack_normal(facing(normalize(normal), front));
    layers[first + 2u] = z;
}
