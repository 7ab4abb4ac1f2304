// The mean of a picture's samples in linear light, weighted by alpha, as in `render --supersample`.

@group(0) @binding(0) var samples: texture_2d_array<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let uv = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4f(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0, 0.0, 1.0);
}

fn linear_from_srgb(v: vec3f) -> vec3f {
    return select(pow((v + 0.055) / 1.055, vec3f(2.4)), v / 12.92, v <= vec3f(0.04045));
}

fn srgb_from_linear(v: vec3f) -> vec3f {
    return select(1.055 * pow(v, vec3f(1.0 / 2.4)) - 0.055, v * 12.92, v <= vec3f(0.0031308));
}

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let count = textureNumLayers(samples);
    var sum = vec3f(0.0);
    var cover = 0.0;
    for (var i = 0u; i < count; i += 1u) {
        let sample = textureLoad(samples, vec2i(position.xy), i, 0);
        sum += linear_from_srgb(sample.rgb) * sample.a;
        cover += sample.a;
    }
    let color = srgb_from_linear(sum / max(cover, 1e-6));
    return vec4f(color, cover / f32(count));
}
