// Each pixel's nearest kept sample, found by two sweeps: two words per pixel, the code of its triangle and its depth-buffer value as
// bits, which sort like the values. Bound as @group(1) @binding(5).
//
// If both words are read as one 64-bit word, depth is the high half: `nearest_wide` finds the same sample by one atomic.

#define_import_path cutaway::nearest

#import cutaway::claims::code_of
#import cutaway::frame::pixel_index
#import cutaway::sweep::Sample

@group(1) @binding(5) var<storage, read_write> nearest: array<atomic<u32>>;

fn nearest_bits(pixel: u32) -> u32 {
    return atomicLoad(&nearest[2u * pixel + 1u]);
}

// Returns true if the sample may still be the nearest.
fn raise(sample: Sample) -> bool {
    let bits = bitcast<u32>(sample.z);
    let pixel = pixel_index(sample.at);
    let before = nearest_bits(pixel);
    if bits > before {
        atomicMax(&nearest[2u * pixel + 1u], bits);
    }
    return bits >= before;
}

fn claim(sample: Sample) {
    atomicMax(&nearest[2u * pixel_index(sample.at)], code_of(sample.triangle, sample.front));
}
