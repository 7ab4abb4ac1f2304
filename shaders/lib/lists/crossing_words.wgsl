// The word stored with each crossing's depth. Bits 0-4 are the clip-surface, by its index in the table. For a crossing with a triangle,
// which has no other source for its normal, bit 5 is set, and bits 6-31 hold the normal, octahedral, 13 and 13 bits.
//
// Fractions range from 0 to 8190, so that 0 has its own code and axis-aligned normals are exact; the error elsewhere is less than 0.02
// degrees.

#define_import_path cutaway::crossing_words

const HAS_NORMAL: u32 = 32u;

fn surface_of_word(word: u32) -> u32 {
    return word & 31u;
}

fn has_normal(word: u32) -> bool {
    return (word & HAS_NORMAL) != 0u;
}

// A unit vector as bits 6-31.
fn normal_bits(n: vec3<f32>) -> u32 {
    let p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    let folded = (1.0 - abs(p.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), p >= vec2<f32>(0.0));
    let codes = vec2<u32>(round((clamp(select(p, folded, n.z < 0.0), vec2<f32>(-1.0), vec2<f32>(1.0)) + 1.0) * 4095.0));
    return (codes.x << 6u) | (codes.y << 19u);
}

fn normal_of(word: u32) -> vec3<f32> {
    let codes = vec2<u32>((word >> 6u) & 0x1fffu, word >> 19u);
    let p = vec2<f32>(codes) / 4095.0 - 1.0;
    let z = 1.0 - abs(p.x) - abs(p.y);
    let folded = (1.0 - abs(p.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), p >= vec2<f32>(0.0));
    return normalize(vec3<f32>(select(p, folded, z < 0.0), z));
}
