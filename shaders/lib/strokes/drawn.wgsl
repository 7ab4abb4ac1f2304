// Draws strokes along borders over the colour of a pixel, which may be covered only in part or not at all.

#define_import_path cutaway::strokes

#import cutaway::stroke_cover::stroke_cover
#import cutaway::style::style

fn stroked(color: vec4<f32>, at: vec2<u32>) -> vec4<f32> {
    let cover = stroke_cover(at);
    let alpha = cover + color.a * (1.0 - cover);
    let mixed = style.ink.rgb * cover + color.rgb * color.a * (1.0 - cover);
    return vec4<f32>(mixed / max(alpha, 1e-6), alpha);
}
