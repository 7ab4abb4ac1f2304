// The part of a clip-surface that is tessellated adaptively: whole texels of its map around the box of the cut solids, in square patches.
// Bound as @group(1) @binding(8).
//
// A vertex is two integers, counted from the corner in steps of 1 / 2^step_bits of a texel, so that all invocations that share it compute
// the same point from the same numbers; vertices of texels lie where the bilinear map has its texel centres.

#define_import_path cutaway::domain

#import cutaway::cuts::{NO_RELIEF, cut_table}
#import cutaway::relief::{Cell, Map, cell_of, height_in, heights, wrapped}

struct Domain {
    // Position of vertex (0, 0) on the plane, and the steps, in scene space.
    corner: vec4<f32>,
    step_x: vec4<f32>,
    step_y: vec4<f32>,
    // Texel of the map at vertex (0, 0).
    first_texel: vec2<i32>,
    patches: vec2<u32>,
    // Texels along the side of a patch, and steps per texel, both as exponents of two.
    patch_bits: u32,
    step_bits: u32,
    // Offsets of the errors of the domain's vertices, and of its cells.
    first_vertex: u32,
    first_cell: u32,
    // Least twist assumed for every cell.
    least_twist: f32,
    // 1 if the texel axes have the opposite handedness to U and V.
    mirrored: u32,
    // Size of the map. The measuring passes use no other data of the clip-surface, so moving it needs no new measurement.
    map_size: vec2<u32>,
    map_first: u32,
    wrap: u32,
    padding: vec2<u32>,
}

// Greatest number of texels in half the side of a patch, as an exponent of two.
const MOST_HALF_BITS: u32 = 5u;

struct Domains {
    surfaces: array<Domain, 32>,
}

@group(1) @binding(8) var<uniform> domains: Domains;

// Number of texels along each side of the domain.
fn domain_texels(surface: u32) -> vec2<u32> {
    return domains.surfaces[surface].patches << vec2<u32>(domains.surfaces[surface].patch_bits);
}

fn is_in_domain(surface: u32, texel: vec2<i32>) -> bool {
    return all(texel >= vec2<i32>(0)) && all(texel <= vec2<i32>(domain_texels(surface)));
}

fn domain_map(surface: u32) -> Map {
    return Map(domains.surfaces[surface].map_first, domains.surfaces[surface].map_size, domains.surfaces[surface].wrap);
}

// A cell of the map, by its position relative to the corner of the domain.
fn domain_cell(surface: u32, cell: vec2<i32>) -> Cell {
    return cell_of(domain_map(surface), domains.surfaces[surface].first_texel + cell);
}

// Height of the map at a texel, by its position relative to the corner of the domain.
fn texel_height(surface: u32, texel: vec2<i32>) -> f32 {
    let map = domain_map(surface);
    let at = domains.surfaces[surface].first_texel + texel;
    return heights[map.first + wrapped(at.y, map.size.y, map.wrap) * map.size.x + wrapped(at.x, map.size.x, map.wrap)];
}

// Height of the relief at a vertex, in scene units.
fn relief_at(surface: u32, at: vec2<i32>) -> f32 {
    if cut_table.surfaces[surface].first_texel == NO_RELIEF {
        return 0.0;
    }
    let bits = vec2<u32>(domains.surfaces[surface].step_bits);
    let cell = at >> bits;
    let within = vec2<f32>(at - (cell << bits)) / f32(1u << bits.x);
    return height_in(domain_cell(surface, cell), within) * cut_table.surfaces[surface].scale.z;
}

// A vertex on the clip-surface, in scene space.
fn point_at(surface: u32, at: vec2<i32>) -> vec3<f32> {
    let on_plane = domains.surfaces[surface].corner.xyz + f32(at.x) * domains.surfaces[surface].step_x.xyz
        + f32(at.y) * domains.surfaces[surface].step_y.xyz;
    return on_plane - relief_at(surface, at) * cut_table.surfaces[surface].normal.xyz;
}
