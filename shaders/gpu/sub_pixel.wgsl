// Draws rectangles that end slightly to the right of a column of samples, in row k by 0.75 / 2^k pixels. A rasteriser that snaps vertices
// to 2^-b pixels covers the column in the rows up to b, because it rounds the end up there. One instance draws one row.

// Side of the target in pixels.
const SIZE_PX: f32 = 16.0;
// x of the column of samples: the centre of pixel 8.
const COLUMN_PX: f32 = 8.5;

@vertex
fn vertex(@builtin(vertex_index) corner: u32, @builtin(instance_index) row: u32) -> @builtin(position) vec4<f32> {
    let right = COLUMN_PX + 0.75 * exp2(-f32(row) - 1.0);
    // Two triangles; the second is the first one rotated about the middle.
    let at_right = (corner == 1u) || (corner > 2u && corner != 4u);
    let below = (corner == 2u) || (corner > 2u && corner != 5u);
    let at_px = vec2<f32>(select(0.0, right, at_right), f32(row) + select(0.0, 1.0, below));
    return vec4<f32>(at_px / (0.5 * SIZE_PX) * vec2<f32>(1.0, -1.0) + vec2<f32>(-1.0, 1.0), 0.5, 1.0);
}

@fragment
fn fragment() -> @location(0) vec4<f32> {
    return vec4<f32>(1.0);
}
