// Measures the error at the middles of the edges of squares of one size: that of the triangles on either side with such an edge as
// hypotenuse, and at least that of the squares half as large around it. One invocation owns one edge.

#import cutaway::deviation::{Chord, bulge, deviation}
#import cutaway::domain::{MOST_HALF_BITS, domain_texels, domains, is_in_domain, texel_height}

@group(1) @binding(10) var<storage, read_write> sheet_errors: array<f32>;

// Index of the clip-surface in the table.
override surface: u32 = 0u;
// Number of texels in half an edge, as an exponent of two.
override half_bits: u32 = 0u;

// The greatest deviation in the triangle between the edge and an apex; both are given in texels from the edge's middle.
fn error_towards(middle: vec2<i32>, along: vec2<i32>, across: vec2<i32>) -> f32 {
    let reach = 1i << min(half_bits, MOST_HALF_BITS);
    let apex = middle + reach * across;
    if !is_in_domain(surface, apex) {
        return 0.0;
    }
    let first = texel_height(surface, middle - reach * along);
    let last = texel_height(surface, middle + reach * along);
    let height = 0.5 * (first + last);
    let rise = (texel_height(surface, apex) - height) / f32(reach);
    let slope = (last - first) / f32(2 * reach);
    let chord = Chord(middle, height, slope * vec2<f32>(along) + rise * vec2<f32>(across));
    var greatest = 0.0;
    for (var w = 0; w < reach; w++) {
        let most = reach - w;
        for (var u = 1 - most; u < most; u++) {
            greatest = max(greatest, abs(deviation(surface, chord, middle + u * along + w * across)));
        }
        let left = middle - most * along + w * across;
        let right = middle + most * along + w * across;
        greatest = max(greatest, bulge(surface, chord, left, left + along + across));
        greatest = max(greatest, bulge(surface, chord, right, right - along + across));
    }
    return greatest;
}

// The error at the middle of a half-size square, offset from the edge's middle by `towards` quarters of the edge's length.
fn error_of_square(middle: vec2<i32>, towards: vec2<i32>) -> f32 {
    let size = vec2<i32>(domain_texels(surface));
    if half_bits == 0u {
        let cell = middle + (towards - 1) / 2;
        if any(cell < vec2<i32>(0)) || any(cell >= size) {
            return 0.0;
        }
        return 0.25 * sheet_errors[domains.surfaces[surface].first_cell + u32(cell.y * size.x + cell.x)];
    }
    let at = middle + towards * ((1i << half_bits) / 2);
    if !is_in_domain(surface, at) {
        return 0.0;
    }
    return sheet_errors[domains.surfaces[surface].first_vertex + u32(at.y * (size.x + 1) + at.x)];
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = domain_texels(surface);
    let middle = id.xy << vec2<u32>(half_bits);
    if any(middle > size) || ((id.x + id.y) & 1u) == 0u {
        return;
    }
    let at = vec2<i32>(middle);
    let along = select(vec2<i32>(0, 1), vec2<i32>(1, 0), (id.x & 1u) == 1u);
    var greatest = max(error_towards(at, along, along.yx), error_towards(at, along, -along.yx));
    greatest = max(greatest, error_of_square(at, vec2<i32>(-1, -1)));
    greatest = max(greatest, error_of_square(at, vec2<i32>(1, -1)));
    greatest = max(greatest, error_of_square(at, vec2<i32>(-1, 1)));
    greatest = max(greatest, error_of_square(at, vec2<i32>(1, 1)));
    sheet_errors[domains.surfaces[surface].first_vertex + middle.y * (size.x + 1u) + middle.x] = greatest;
}
