// Layers as words. Each pixel has three words: the visible element, its normal, its depth.
//
// First word: bits 0-1 kind, 2 back face, 3 unreliable, 4 overlap, 8-15 clip-surface, 16-31 part.

#define_import_path cutaway::layers

const BACKGROUND: u32 = 0u;
const SURFACE: u32 = 1u;
const CAP: u32 = 2u;
const BACK_FACE: u32 = 4u;
const UNRELIABLE: u32 = 8u;
// A cap that several solids share.
const OVERLAP: u32 = 16u;
const NEAR_PLANE: u32 = 0xffu;
// Instead of a clip-surface number: drawn by a pass without a list of crossings, or behind more crossings than can be numbered.
const UNCOUNTED: u32 = 0xfeu;
const WORDS_PER_PIXEL: u32 = 3u;

fn layer_word(kind: u32, clip_surface: u32, part: u32) -> u32 {
    return kind | (clip_surface << 8u) | (part << 16u);
}

fn kind_of(word: u32) -> u32 {
    return word & 3u;
}

fn clip_surface_of(word: u32) -> u32 {
    return (word >> 8u) & 0xffu;
}

fn part_of(word: u32) -> u32 {
    return word >> 16u;
}

// Octahedral mapping of a unit vector to two 16-bit signed fractions (Cigolle et al. 2014).
fn pack_normal(n: vec3<f32>) -> u32 {
    let p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    let folded = (1.0 - abs(p.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), p >= vec2<f32>(0.0));
    return pack2x16snorm(select(p, folded, n.z < 0.0));
}

// The direction of a normal, of any length.
fn unpack_direction(word: u32) -> vec3<f32> {
    let p = unpack2x16snorm(word);
    let z = 1.0 - abs(p.x) - abs(p.y);
    let folded = (1.0 - abs(p.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), p >= vec2<f32>(0.0));
    return vec3<f32>(select(p, folded, z < 0.0), z);
}

fn unpack_normal(word: u32) -> vec3<f32> {
    return normalize(unpack_direction(word));
}
