// Each pixel's nearest kept sample, found by one sweep with 64-bit atomics, which core WebGPU lacks. Bound as @group(1) @binding(5).

#define_import_path cutaway::nearest_wide

#import cutaway::claims::code_of
#import cutaway::frame::pixel_index
#import cutaway::sweep::Sample

// Depth-buffer value as bits in the high half, code of the triangle in the low half: two words in `nearest`.
@group(1) @binding(5) var<storage, read_write> nearest: array<atomic<u64>>;

fn keep(sample: Sample) {
    let code = code_of(sample.triangle, sample.front);
    let value = (u64(bitcast<u32>(sample.z)) << 32u) | u64(code);
    let pixel = pixel_index(sample.at);
    if value > atomicLoad(&nearest[pixel]) {
        atomicMax(&nearest[pixel], value);
    }
}
