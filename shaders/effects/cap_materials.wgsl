// Applies materials to caps (Trapp and Doellner 2013, sections 4.1 and 4.2) and vertex paints to surfaces, by the open module
// `vertex_paint`. One invocation owns a pixel at a time.
//
// The material colour is stored in the picture until later passes draw it: sRGB, with alpha 1 where it replaces the colour of the part.
// Layers are copied, with normals that the material perturbs; only lighting reads the copy.

#import cutaway::cap_plane::{CapPlane, footing_on, moved_along, nearest_axis, plane_of_view}
#import cutaway::vertex_paint::vertex_paint_at
#import cutaway::color::{linear_from_srgb, srgb_from_linear}
#import cutaway::cuts::{parts, place_of_part}
#import cutaway::frame::{centre_of, frame, pixel_index, ray_through}
#import cutaway::layers::{CAP, NEAR_PLANE, WORDS_PER_PIXEL, clip_surface_of, kind_of, pack_normal, part_of, unpack_normal}
#import cutaway::picture::picture
#import cutaway::share::{pixel_at, turns}
#import cutaway::solids::{granite, marble, wood}
#import cutaway::texture::{NO_TEXTURE, sampled, textures}

struct CapMaterial {
    x_row: vec4<f32>,
    y_row: vec4<f32>,
    z_row: vec4<f32>,
    diffuse: u32,
    normal: u32,
    light: u32,
    solid: u32,
    first_image: u32,
    image_count: u32,
    per_unit: f32,
    is_there: u32,
}

struct CapMaterialPlanes {
    planes: array<CapPlane, 256>,
    per_unit: array<vec4<f32>, 256>,
    count: u32,
    default_per_unit: f32,
    is_z_up: u32,
    padding: u32,
}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
// Indexed by part number in the scene.
@group(1) @binding(1) var<storage, read> cap_materials: array<CapMaterial>;
@group(1) @binding(3) var<storage, read_write> lit_layers: array<u32>;
@group(1) @binding(4) var<uniform> cap_material_planes: CapMaterialPlanes;

const FILLED_STACK: u32 = 5u;

struct DrawnCap {
    color: vec4<f32>,
    normal: u32,
}

// The texture plane of a cap. v points down, in the direction of increasing image rows.
fn plane_of(number: u32, normal: vec3<f32>) -> CapPlane {
    if number == NEAR_PLANE || number >= cap_material_planes.count {
        let view = plane_of_view();
        return CapPlane(view.u_row, -view.v_row, view.normal);
    }
    let plane = cap_material_planes.planes[number];
    if plane.normal.w < 0.5 {
        return plane;
    }
    // For a cutter: perpendicular to the scene axis nearest to the face normal, and upright as seen by the viewer.
    let axis = vec3<f32>(vec3<u32>(0u, 1u, 2u) == vec3<u32>(nearest_axis(normal)));
    let out = axis * sign(dot(axis, normal));
    let up = select(vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(0.0, 0.0, 1.0), cap_material_planes.is_z_up != 0u);
    let across = cross(up, out);
    let u = select(vec3<f32>(1.0, 0.0, 0.0), across, dot(across, across) > 0.5);
    return CapPlane(vec4<f32>(u, 0.0), vec4<f32>(-cross(out, u), 0.0), vec4<f32>(normal, 0.0));
}

fn repeats_of(number: u32, per_unit: f32) -> vec2<f32> {
    if per_unit > 0.0 {
        return vec2<f32>(per_unit);
    }
    if number == NEAR_PLANE || number >= cap_material_planes.count {
        return vec2<f32>(cap_material_planes.default_per_unit);
    }
    return cap_material_planes.per_unit[number].xy;
}

fn stack_color(material: CapMaterial, p: vec3<f32>, right: vec3<f32>, down: vec3<f32>) -> vec4<f32> {
    let count = i32(material.image_count);
    var at = fract(p.z) * f32(count) - 0.5;
    var place = p.xy;
    if material.solid == FILLED_STACK {
        // The texture does not repeat beyond the box.
        at = clamp(p.z * f32(count) - 0.5, 0.0, f32(count - 1));
        let half_texel = 0.5 / vec2<f32>(textures[material.first_image].size);
        place = clamp(place, half_texel, 1.0 - half_texel);
    }
    let below = i32(floor(at));
    let first = material.first_image + u32((below + count) % count);
    let next = material.first_image + u32((below + 1) % count);
    let a = sampled(first, place, right.xy, down.xy);
    return mix(a, sampled(next, place, right.xy, down.xy), at - floor(at));
}

fn in_solid(material: CapMaterial, point: vec4<f32>) -> vec3<f32> {
    return vec3<f32>(dot(material.x_row, point), dot(material.y_row, point), dot(material.z_row, point));
}

// The colour of a cap's solid material.
fn solid_color(material: CapMaterial, at: vec2<u32>, depth: f32, normal: vec3<f32>) -> vec4<f32> {
    let ray = ray_through(centre_of(at));
    let reach = select(depth, 1.0, frame.orthographic != 0u);
    let right = moved_along(normal, ray.direction, reach * frame.ray_step[0].xyz);
    let down = moved_along(normal, ray.direction, reach * frame.ray_step[1].xyz);
    let p = in_solid(material, vec4<f32>(ray.origin + depth * ray.direction, 1.0));
    let p_right = in_solid(material, vec4<f32>(right, 0.0));
    let p_down = in_solid(material, vec4<f32>(down, 0.0));
    let footprint = max(length(p_right), length(p_down));
    switch material.solid {
        case 1u: { return vec4<f32>(wood(p, footprint), 1.0); }
        case 2u: { return vec4<f32>(marble(p, footprint), 1.0); }
        case 3u: { return vec4<f32>(granite(p, footprint), 1.0); }
        case 4u, FILLED_STACK: { return stack_color(material, p, p_right, p_down); }
        default: { return vec4<f32>(0.0); }
    }
}

fn drawn_cap(at: vec2<u32>, word: u32, packed_normal: u32, depth: f32) -> DrawnCap {
    let material = cap_materials[part_of(word)];
    if material.is_there == 0u {
        return DrawnCap(vec4<f32>(0.0), packed_normal);
    }
    var normal = unpack_normal(packed_normal);
    var color = solid_color(material, at, depth, normal);
    let number = clip_surface_of(word);
    let plane = plane_of(number, normal);
    let repeats = repeats_of(number, material.per_unit);
    let footing = footing_on(plane, at, depth);
    let place = footing.uv * repeats;
    let right = footing.right * repeats;
    let down = footing.down * repeats;
    if material.diffuse != NO_TEXTURE {
        let diffuse = sampled(material.diffuse, place, right, down);
        color = vec4<f32>(mix(color.rgb, diffuse.rgb, diffuse.a), max(color.a, diffuse.a));
    }
    let own = linear_from_srgb(parts[place_of_part(part_of(word))].cap_color.rgb);
    color = vec4<f32>(mix(own, color.rgb, color.a), 1.0);
    if material.light != NO_TEXTURE {
        color = vec4<f32>(color.rgb * sampled(material.light, place, right, down).r, 1.0);
    }
    if material.normal != NO_TEXTURE {
        let bent = sampled(material.normal, place, right, down).xyz * 2.0 - 1.0;
        // Image rows go down, but green means up in a normal map.
        let slope = (bent.x * plane.u_row.xyz - bent.y * plane.v_row.xyz) / max(bent.z, 0.05);
        normal = normalize(normal + slope);
    }
    return DrawnCap(color, select(packed_normal, pack_normal(normal), material.normal != NO_TEXTURE));
}

fn draw_pixel(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    let first = pixel * WORDS_PER_PIXEL;
    let word = layers[first];
    var cap = DrawnCap(vec4<f32>(0.0), layers[first + 1u]);
    if kind_of(word) == CAP {
        cap = drawn_cap(xy, word, cap.normal, bitcast<f32>(layers[first + 2u]));
    }
    let of_cap = pack4x8unorm(vec4<f32>(srgb_from_linear(cap.color.rgb), cap.color.a));
    picture[pixel] = select(vertex_paint_at(xy, word), of_cap, kind_of(word) == CAP);
    lit_layers[first] = word;
    lit_layers[first + 1u] = cap.normal;
    lit_layers[first + 2u] = layers[first + 2u];
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
            draw_pixel(xy);
        }
    }
}
