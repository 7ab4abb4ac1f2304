// Textures in storage: any number through one binding, with the same results on every device. Bound as @group(2) @binding(0) and (1).
//
// One to four samples lie along the longer side of the pixel footprint, in proportion to the ratio of its sides. Each sample is
// interpolated between the two mip levels between which its share of that side is one texel long.

#define_import_path cutaway::texture

#import cutaway::color::linear_from_srgb

struct Texture {
    first: u32,
    is_color: u32,
    size: vec2<u32>,
}

@group(2) @binding(0) var<storage, read> textures: array<Texture>;
// RGBA8 of all mip levels, each half as large as the one before.
@group(2) @binding(1) var<storage, read> texels: array<u32>;

const NO_TEXTURE: u32 = 0xffffffffu;
const MOST_SAMPLES: i32 = 4;

fn texel_at(first: u32, size: vec2<u32>, at: vec2<i32>, is_color: bool) -> vec4<f32> {
    let n = vec2<i32>(size);
    let inside = vec2<u32>(((at % n) + n) % n);
    let texel = unpack4x8unorm(texels[first + inside.y * size.x + inside.x]);
    return vec4<f32>(select(texel.rgb, linear_from_srgb(texel.rgb), is_color), texel.a);
}

// Bilinear sample of one mip level; `place` is in texture repeats.
fn bilinear(first: u32, size: vec2<u32>, place: vec2<f32>, is_color: bool) -> vec4<f32> {
    let at = fract(place) * vec2<f32>(size) - 0.5;
    let corner = floor(at);
    let cell = vec2<i32>(corner);
    let share = at - corner;
    let above = mix(
        texel_at(first, size, cell, is_color),
        texel_at(first, size, cell + vec2<i32>(1, 0), is_color),
        share.x,
    );
    let below = mix(
        texel_at(first, size, cell + vec2<i32>(0, 1), is_color),
        texel_at(first, size, cell + vec2<i32>(1, 1), is_color),
        share.x,
    );
    return mix(above, below, share.y);
}

// Halvings of the largest texture.
const MOST_LEVELS: f32 = 16.0;

// Interpolates between two mip levels.
fn at_level(texture: Texture, level: f32, place: vec2<f32>) -> vec4<f32> {
    var first = texture.first;
    var size = texture.size;
    let whole = u32(clamp(level, 0.0, MOST_LEVELS));
    for (var i = 0u; i < whole && any(size > vec2<u32>(1u)); i++) {
        first += size.x * size.y;
        size = max(size / 2u, vec2<u32>(1u));
    }
    let fine = bilinear(first, size, place, texture.is_color != 0u);
    let share = select(0.0, fract(level), level > 0.0);
    if share <= 0.0 || all(size == vec2<u32>(1u)) {
        return fine;
    }
    let coarse = bilinear(first + size.x * size.y, max(size / 2u, vec2<u32>(1u)), place, texture.is_color != 0u);
    return mix(fine, coarse, share);
}

// Samples a texture over a pixel footprint with sides `right` and `down`; `place` is in texture repeats. Colours are in linear light.
fn sampled(number: u32, place: vec2<f32>, right: vec2<f32>, down: vec2<f32>) -> vec4<f32> {
    let texture = textures[number];
    let size = vec2<f32>(texture.size);
    let sides = vec2<f32>(length(right * size), length(down * size));
    let is_right = sides.x >= sides.y;
    let longer = max(max(sides.x, sides.y), 1e-6);
    let shorter = min(sides.x, sides.y);
    let count = u32(clamp(ceil(longer / max(shorter, 1.0)), 1.0, f32(MOST_SAMPLES)));
    let level = log2(max(longer / f32(count), 1.0));
    let along = select(down, right, is_right);
    var sum = vec4<f32>(0.0);
    for (var i = 0u; i < u32(MOST_SAMPLES); i++) {
        if i >= count {
            break;
        }
        sum += at_level(texture, level, place + along * ((f32(i) + 0.5) / f32(count) - 0.5));
    }
    return sum / f32(count);
}
