// The viewport of every draw: a power of two larger than the picture, as large as fits into 8192 pixels, about the same middle.
//
// A rasteriser may clip triangles at the borders of the viewport. Clipping a needle there leaves an even thinner needle, whose depth can
// be any value between those of its ends, so nothing is clipped at the borders of a picture or of a band. `src/gpu/viewport.rs` sets the
// same viewport.

#define_import_path cutaway::viewport

const VIEWPORT_PX: u32 = 8192u;

// Transforms a picture's clip space to that of its viewport, without rounding.
fn on_viewport(clip: vec4<f32>, size_px: vec2<u32>) -> vec4<f32> {
    let doublings = firstLeadingBit(max(vec2<u32>(VIEWPORT_PX) / size_px, vec2<u32>(1u)));
    // Floating-point numbers with these exponents are the powers of one half.
    let share = bitcast<vec2<f32>>((127u - doublings) << vec2<u32>(23u));
    return vec4<f32>(clip.xy * share, clip.zw);
}
