// Exact products of 32-bit integers: 64 bits in two words, low and high, two's complement.
//
// Edge functions of large triangles need up to 48 bits, and core WebGPU has no 64-bit integers.

#define_import_path cutaway::wide

// Result of `wide_floor` beyond its range: more than any walk over a tile of 64 x 64 samples can compensate.
const FARTHEST: i32 = 0x40000000;

fn wide_negative(a: vec2<u32>) -> vec2<u32> {
    let low = ~a.x + 1u;
    return vec2<u32>(low, ~a.y + select(0u, 1u, low == 0u));
}

// Factors are within +-(2^31 - 1).
fn wide_product(a: i32, b: i32) -> vec2<u32> {
    let x = u32(abs(a));
    let y = u32(abs(b));
    let low = (x & 0xffffu) * (y & 0xffffu);
    let middle = (x >> 16u) * (y & 0xffffu) + (low >> 16u);
    let carried = (x & 0xffffu) * (y >> 16u) + (middle & 0xffffu);
    let high = (x >> 16u) * (y >> 16u) + (middle >> 16u) + (carried >> 16u);
    let product = vec2<u32>((carried << 16u) | (low & 0xffffu), high);
    if (a < 0) != (b < 0) {
        return wide_negative(product);
    }
    return product;
}

fn wide_minus(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(a.x - b.x, a.y - b.y - select(0u, 1u, a.x < b.x));
}

// a.x * b.y - a.y * b.x.
fn wide_cross(a: vec2<i32>, b: vec2<i32>) -> vec2<u32> {
    return wide_minus(wide_product(a.x, b.y), wide_product(a.y, b.x));
}

fn wide_is_negative(a: vec2<u32>) -> bool {
    return (a.y >> 31u) != 0u;
}

// The nearest f32, except for one rounding of the low word.
fn wide_float(a: vec2<u32>) -> f32 {
    if wide_is_negative(a) {
        let b = wide_negative(a);
        return -(f32(b.y) * 4294967296.0 + f32(b.x));
    }
    return f32(a.y) * 4294967296.0 + f32(a.x);
}

// a / 256 rounded down, where that is within +-2^30; FARTHEST or -FARTHEST - 1 beyond.
fn wide_floor(a: vec2<u32>) -> i32 {
    let high = bitcast<i32>(a.y);
    if high >= 64 {
        return FARTHEST;
    }
    if high < -64 {
        return -FARTHEST - 1;
    }
    return (high << 24u) | bitcast<i32>(a.x >> 8u);
}
