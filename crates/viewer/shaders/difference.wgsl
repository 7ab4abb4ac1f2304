// The colour difference between two pictures, multiplied by GAIN. Pictures of different sizes are compared at equal relative positions.

@group(0) @binding(0) var picture_a: texture_2d<f32>;
@group(0) @binding(1) var picture_b: texture_2d<f32>;
@group(0) @binding(2) var nearest: sampler;

const GAIN: f32 = 4.0;

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let uv = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return Corner(vec4f(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0, 0.0, 1.0), uv);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4f {
    let a = textureSample(picture_a, nearest, corner.uv);
    let b = textureSample(picture_b, nearest, corner.uv);
    return vec4f(abs(a.rgb - b.rgb) * GAIN, 1.0);
}
