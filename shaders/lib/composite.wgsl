// Shared code for drawing a frame into a host's attachments.

#define_import_path cutaway::composite

#import cutaway::layers::{BACKGROUND, CAP, WORDS_PER_PIXEL, kind_of}

struct Composite {
    // Upper left corner of the frame in the target, in pixels.
    origin_px: vec2<u32>,
    size_px: vec2<u32>,
    // A point at depth d in scene units has the value (x d + y) / (z d + w) in the host's depth buffer.
    depth: vec4<f32>,
    // The host's depth value at infinity.
    far: f32,
    // 1 if the target stores linear light.
    is_linear: u32,
    // 1 if pixels without a model are drawn too.
    has_background: u32,
    // 1 if only caps are drawn.
    caps_only: u32,
}

@group(0) @binding(0) var<uniform> composite: Composite;
@group(0) @binding(1) var<storage, read> picture: array<u32>;
@group(0) @binding(2) var<storage, read> layers: array<u32>;

fn pixel_at(position: vec4<f32>) -> u32 {
    let at = vec2<u32>(position.xy) - composite.origin_px;
    return at.y * composite.size_px.x + at.x;
}

fn is_background(pixel: u32) -> bool {
    return kind_of(layers[pixel * WORDS_PER_PIXEL]) == BACKGROUND;
}

fn is_left_out(pixel: u32) -> bool {
    let kind = kind_of(layers[pixel * WORDS_PER_PIXEL]);
    return (kind == BACKGROUND && composite.has_background == 0u) || (kind != CAP && composite.caps_only != 0u);
}

fn color_of(pixel: u32) -> vec4<f32> {
    return as_target_takes(unpack4x8unorm(picture[pixel]));
}

// Converts an sRGB colour to the encoding of the target.
fn as_target_takes(c: vec4<f32>) -> vec4<f32> {
    if composite.is_linear == 0u {
        return c;
    }
    let curved = pow((c.rgb + 0.055) / 1.055, vec3<f32>(2.4));
    return vec4<f32>(select(curved, c.rgb / 12.92, c.rgb <= vec3<f32>(0.04045)), c.a);
}

fn depth_of(pixel: u32) -> f32 {
    if is_background(pixel) {
        return composite.far;
    }
    let d = bitcast<f32>(layers[pixel * WORDS_PER_PIXEL + 2u]);
    return (composite.depth.x * d + composite.depth.y) / (composite.depth.z * d + composite.depth.w);
}
