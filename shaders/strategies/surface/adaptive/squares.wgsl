// Measures the error at the middles of squares of one size: that of the two triangles on either side of a square's diagonal, and at least
// that of its edges. One invocation owns one square.

#import cutaway::deviation::{Chord, bulge, deviation}
#import cutaway::domain::{MOST_HALF_BITS, domain_texels, domains, texel_height}

@group(1) @binding(10) var<storage, read_write> sheet_errors: array<f32>;

// Index of the clip-surface in the table.
override surface: u32 = 0u;
// Number of texels in half a side, as an exponent of two.
override half_bits: u32 = 0u;

// The greatest deviation in the triangle at a corner of the square, whose other corners lie towards x and y.
fn error_from(apex: vec2<i32>, towards: vec2<i32>) -> f32 {
    let side = 2i << min(half_bits, MOST_HALF_BITS);
    let height = texel_height(surface, apex);
    let x = texel_height(surface, apex + vec2<i32>(side * towards.x, 0));
    let y = texel_height(surface, apex + vec2<i32>(0, side * towards.y));
    let slope = (vec2<f32>(x, y) - height) / f32(side) * vec2<f32>(towards);
    let chord = Chord(apex, height, slope);
    var greatest = 0.0;
    for (var v = 0; v < side; v++) {
        let most = side - v;
        for (var u = 0; u < most; u++) {
            greatest = max(greatest, abs(deviation(surface, chord, apex + towards * vec2<i32>(u, v))));
        }
        let end = apex + towards * vec2<i32>(most, v);
        greatest = max(greatest, bulge(surface, chord, end, end + towards * vec2<i32>(-1, 1)));
    }
    return greatest;
}

fn error_of_edge(at: vec2<i32>) -> f32 {
    let row = i32(domain_texels(surface).x) + 1;
    return sheet_errors[domains.surfaces[surface].first_vertex + u32(at.y * row + at.x)];
}

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = domain_texels(surface);
    let middle = (2u * id.xy + 1u) << vec2<u32>(half_bits);
    if any(middle >= size) {
        return;
    }
    let at = vec2<i32>(middle);
    let reach = 1i << half_bits;
    // The diagonal runs as in `root_of`.
    let apex_x = select(1, -1, ((id.x + id.y) & 1u) == 1u);
    let apex = vec2<i32>(apex_x, -1);
    var greatest = max(error_from(at + reach * apex, -apex), error_from(at - reach * apex, apex));
    greatest = max(greatest, error_of_edge(at + vec2<i32>(reach, 0)));
    greatest = max(greatest, error_of_edge(at - vec2<i32>(reach, 0)));
    greatest = max(greatest, error_of_edge(at + vec2<i32>(0, reach)));
    greatest = max(greatest, error_of_edge(at - vec2<i32>(0, reach)));
    sheet_errors[domains.surfaces[surface].first_vertex + middle.y * (size.x + 1u) + middle.x] = greatest;
}
