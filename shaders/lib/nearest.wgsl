// The nearest kept sample of each pixel while it is found: a plane of depth-buffer values, as bits, which order as the values do;
// and a plane of the triangles they came from, counted from the end so that a maximum finds the first of equals. Bound as
// @group(1) @binding(5).

#define_import_path cutaway::nearest

#import cutaway::frame::pixel_count

@group(1) @binding(5) var<storage, read_write> nearest: array<atomic<u32>>;

fn nearest_bits(pixel: u32) -> u32 {
    return atomicLoad(&nearest[pixel]);
}

fn raise(pixel: u32, z: f32) {
    if bitcast<u32>(z) > atomicLoad(&nearest[pixel]) {
        atomicMax(&nearest[pixel], bitcast<u32>(z));
    }
}

fn claim(pixel: u32, triangle: u32) {
    atomicMax(&nearest[pixel_count() + pixel], 0xffffffffu - triangle);
}
