// Distance of the map from a plane through three of its texels: at texels, and on the diagonal of a cell between two of them.
//
// On a cell the map is bilinear, and so is its difference from the plane, which is extreme at corners. Where the diagonal of a cell
// halves it between two triangles the difference is quadratic along it: linear between its ends d and e, plus
// ± twist s (1 - s). Its only extreme between the ends is (d + e) / 2 + q / 4 + (e - d)² / (4 q), and is there where |e - d| < |q|.

#define_import_path cutaway::deviation

#import cutaway::domain::{domain_cell, texel_height}

// A plane over the map.
struct Chord {
    // A texel relative to the corner of the domain, and the height there.
    at: vec2<i32>,
    height: f32,
    slope: vec2<f32>,
}

fn deviation(surface: u32, chord: Chord, texel: vec2<i32>) -> f32 {
    return texel_height(surface, texel) - (chord.height + dot(chord.slope, vec2<f32>(texel - chord.at)));
}

// The greatest deviation between two texels at opposite corners of a cell.
fn bulge(surface: u32, chord: Chord, from_texel: vec2<i32>, to_texel: vec2<i32>) -> f32 {
    let d = deviation(surface, chord, from_texel);
    let e = deviation(surface, chord, to_texel);
    let ends = max(abs(d), abs(e));
    let twist = domain_cell(surface, min(from_texel, to_texel)).twist;
    let step = to_texel - from_texel;
    let q = select(twist, -twist, step.x == step.y);
    if abs(e - d) < abs(q) {
        return max(ends, abs(0.5 * (d + e) + 0.25 * q + (e - d) * (e - d) / (4.0 * q)));
    }
    return ends;
}
