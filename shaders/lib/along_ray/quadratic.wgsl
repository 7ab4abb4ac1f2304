// Roots of a s^2 + b s + c in 0..length: signs determine their number, the citardauq form their positions.
//
// The textbook form divides by 2a and fails on every flat cell (a = 0); this form divides by a value without cancellation.

#define_import_path cutaway::quadratic

struct Roots {
    count: u32,
    // The roots in ascending order; y is valid only if count is 2.
    at: vec2<f32>,
}

// `kept` and `kept_at_exit` are the signs at 0 and at `length`. Different signs give one root; equal signs give two if the vertex of the
// parabola lies inside the range and has the opposite sign, else none.
fn roots_in(a: f32, b: f32, c: f32, length: f32, kept: bool, kept_at_exit: bool) -> Roots {
    let q = -0.5 * (b + select(-1.0, 1.0, b >= 0.0) * sqrt(max(b * b - 4.0 * a * c, 0.0)));
    let first = clamp(select(c / q, 0.0, q == 0.0), 0.0, length);
    let second = clamp(select(q / a, length, a == 0.0), 0.0, length);
    if kept != kept_at_exit {
        // The derivative is sign(b) sqrt(D) at c / q and the opposite at q / a: the sign change selects its root.
        let root = select(second, first, (b >= 0.0) == kept_at_exit);
        return Roots(1u, vec2<f32>(root, root));
    }
    if a != 0.0 {
        let vertex = -b / (2.0 * a);
        let kept_at_vertex = c + vertex * (b + a * vertex) >= 0.0;
        if vertex > 0.0 && vertex < length && kept_at_vertex != kept {
            return Roots(2u, vec2<f32>(min(first, second), max(first, second)));
        }
    }
    return Roots(0u, vec2<f32>(0.0));
}
